// SPDX-License-Identifier: Apache-2.0
#include "pipeline/carried.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "pipeline/continued.h"
#include "school/mask_edit.h"

namespace sonar {
namespace {

using InPing = SchoolMasks::InPing;

constexpr std::string_view kIsNow = " lies in no school any more; what was there is that of channel ";

std::optional<int> row_of(const std::vector<int>& channel_of_row, int channel) {
  const auto found = std::find(channel_of_row.begin(), channel_of_row.end(), channel);
  if (found == channel_of_row.end()) return std::nullopt;
  return static_cast<int>(found - channel_of_row.begin());
}

/// Number of the school that a product had at a voxel; 0 = none.
std::int64_t school_then(const EarlierSchools::Layer& layer, const SchoolKey& key) {
  const auto row = row_of(layer.channel_of_row, key.channel);
  if (!row) return 0;
  for (const SchoolMask& mask : layer.masks) {
    const bool there = layer.ping_times[static_cast<std::size_t>(mask.ping_index)] == key.ping_time &&
                       contains(mask.mask, *row, key.sample);
    if (there) return mask.school_id;
  }
  return 0;
}

/// Its masks on the pings and rows of this observation.
std::vector<InPing> masks_now(const EarlierSchools::Layer& layer, std::int64_t school_id, const CommandGround& ground) {
  const std::vector<int> rows = ground.grid->row_of_channel();
  std::vector<InPing> masks;
  for (const SchoolMask& mask : layer.masks) {
    if (mask.school_id != school_id) continue;
    const auto ping = ping_at(ground, layer.ping_times[static_cast<std::size_t>(mask.ping_index)]);
    if (!ping) continue;
    PingMask moved = on_rows(mask.mask, layer.channel_of_row, rows);
    std::size_t voxels = 0;
    for (const Run& run : moved.runs) voxels += static_cast<std::size_t>(run.count);
    moved.confidence.assign(voxels, 255);
    if (!moved.runs.empty()) masks.push_back({*ping, std::move(moved), kUnknown});
  }
  std::sort(masks.begin(), masks.end(), [](const InPing& a, const InPing& b) { return a.ping_index < b.ping_index; });
  return masks;
}

std::size_t shared_voxels(const std::vector<InPing>& then, const SchoolMasks& now) {
  std::size_t shared = 0;
  for (const InPing& there : then) {
    if (const auto* other = in_ping(now, there.ping_index)) shared += overlap(there.mask, other->mask);
  }
  return shared;
}

std::optional<std::size_t> likest(const std::vector<InPing>& then, const JournalState& state, double share) {
  std::optional<std::size_t> best;
  std::size_t most = 0;
  for (std::size_t i = 0; i < state.schools.size(); ++i) {
    const SchoolMasks& now = state.schools[i]->masks;
    const std::size_t shared = shared_voxels(then, now);
    if (shared <= most || !same_fish(then, now.pings, share)) continue;
    best = i;
    most = shared;
  }
  return best;
}

/// Takes a whole number off the front.
bool take_number(std::string_view& text, std::int64_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || number < 0 || number > INT32_MAX) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

bool take_word(std::string_view& text, std::string_view word) {
  if (!text.starts_with(word)) return false;
  text.remove_prefix(word.size());
  return true;
}

}  // namespace

std::optional<std::size_t> heir_of(const SchoolKey& key, const JournalState& state, const CommandGround& ground,
                                   const EarlierSchools& earlier) {
  for (const EarlierSchools::Layer& layer : earlier.layers) {
    SchoolKey then = key;
    if (const auto carried =
            std::find_if(layer.carried.begin(), layer.carried.end(), [&](const auto& one) { return one.first == key; });
        carried != layer.carried.end()) {
      then = carried->second;
      if (const auto there = school_at(state, ground, then)) return there;
    }
    const std::int64_t school_id = school_then(layer, then);
    if (school_id == 0) continue;
    if (const auto heir = likest(masks_now(layer, school_id, ground), state, ground.human_share)) return heir;
  }
  return std::nullopt;
}

std::string carried_text(const std::string& said, const SchoolKey& key, const SchoolKey& now, std::int64_t ping_index) {
  return fmt::format("{}channel {}, sample {}{}{}, sample {} of ping {}", said, key.channel, key.sample, kIsNow,
                     now.channel, now.sample, ping_index);
}

std::optional<CarriedNote> carried_note(std::string_view text) {
  const auto begin = text.find("channel ");
  if (begin == std::string_view::npos) return std::nullopt;
  text.remove_prefix(begin);
  std::array<std::int64_t, 5> n{};
  const bool read = take_word(text, "channel ") && take_number(text, n[0]) && take_word(text, ", sample ") &&
                    take_number(text, n[1]) && take_word(text, kIsNow) && take_number(text, n[2]) &&
                    take_word(text, ", sample ") && take_number(text, n[3]) && take_word(text, " of ping ") &&
                    take_number(text, n[4]) && text.empty();
  if (!read) return std::nullopt;
  return CarriedNote{
      static_cast<int>(n[0]), static_cast<int>(n[1]), {n[4], static_cast<int>(n[2]), static_cast<int>(n[3])}};
}

}  // namespace sonar
