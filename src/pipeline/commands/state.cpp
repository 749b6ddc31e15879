// SPDX-License-Identifier: Apache-2.0
#include "pipeline/commands/state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "school/grow/mask_edit.h"

namespace sonar {

bool keeps_its_voxels(const StateSchool& school) { return school.by_hand || school.masks.decided.status == "accepted"; }

JournalState state_of_detected(std::vector<SchoolMasks> schools) {
  JournalState state;
  for (SchoolMasks& masks : schools) {
    auto school = std::make_shared<StateSchool>();
    school->number = state.next_number++;
    school->masks = std::move(masks);
    state.schools.push_back(std::move(school));
  }
  return state;
}

JournalState state_before_detection(std::vector<SchoolMasks> schools) {
  JournalState state = state_of_detected(std::move(schools));
  state.unnumbered = static_cast<std::int64_t>(state.schools.size());
  state.next_number = 1;
  for (auto& school : state.schools) {
    auto copy = std::make_shared<StateSchool>(*school);
    copy->number -= state.unnumbered + 1;
    school = std::move(copy);
  }
  return state;
}

std::string school_title(const StateSchool& school) {
  const std::string& name = school.masks.decided.name;
  return fmt::format("school {}{}", school.number, name.empty() ? "" : " (" + name + ")");
}

const SchoolMasks::InPing* in_ping(const SchoolMasks& school, std::int64_t ping_index) {
  const auto found =
      std::lower_bound(school.pings.begin(), school.pings.end(), ping_index,
                       [](const SchoolMasks::InPing& a, std::int64_t wanted) { return a.ping_index < wanted; });
  return found != school.pings.end() && found->ping_index == ping_index ? &*found : nullptr;
}

std::optional<std::int64_t> ping_at(const CommandContext& context, TimeNs time) {
  const auto found = std::lower_bound(context.times.begin(), context.times.end(), time);
  if (found == context.times.end() || *found != time) return std::nullopt;
  const std::int64_t index = found - context.times.begin();
  if (index < context.limits.first || index > context.limits.last) return std::nullopt;
  return index;
}

std::optional<std::size_t> school_at(const JournalState& state, const CommandContext& context, const SchoolKey& key) {
  const auto ping = ping_at(context, key.ping_time);
  const std::vector<int> rows = context.grid->row_of_channel();
  if (!ping || key.channel < 0 || static_cast<std::size_t>(key.channel) >= rows.size()) return std::nullopt;
  const int row = rows[static_cast<std::size_t>(key.channel)];
  for (std::size_t i = 0; i < state.schools.size(); ++i) {
    const auto* there = in_ping(state.schools[i]->masks, *ping);
    if (there != nullptr && row >= 0 && contains(there->mask, row, key.sample)) return i;
  }
  return std::nullopt;
}

SchoolKey key_of(const SchoolMasks& school, const CommandContext& context) {
  if (school.pings.empty()) return {};
  const SchoolMasks::InPing& middle = school.pings[school.pings.size() / 2];
  const auto& confidence = middle.mask.confidence;
  auto left = std::max_element(confidence.begin(), confidence.end()) - confidence.begin();
  for (const Run& run : middle.mask.runs) {
    if (left < run.count) {
      return {context.times[static_cast<std::size_t>(middle.ping_index)],
              context.grid->channel[static_cast<std::size_t>(run.row)], run.first_sample + static_cast<int>(left)};
    }
    left -= run.count;
  }
  return {};
}

bool is_bad(const JournalState& state, TimeNs ping_time) {
  return std::any_of(state.bad_pings.begin(), state.bad_pings.end(),
                     [&](const BadPingsCommand& bad) { return bad.first <= ping_time && ping_time <= bad.last; });
}

Recipe measuring_recipe(const Recipe& recipe, const JournalState& state) {
  Recipe measuring = recipe;
  if (state.calibration) measuring.calibration = *state.calibration;
  return measuring;
}

std::vector<SchoolMasks> masks_of(const JournalState& state) {
  std::vector<SchoolMasks> masks;
  for (const auto& school : state.schools) {
    masks.push_back(school->masks);
    masks.back().decided.ended_at_reach = ended_at_reach(school->masks);
  }
  return masks;
}

std::vector<SchoolMasks> measured_masks_of(const JournalState& state, std::span<const TimeNs> times) {
  std::vector<SchoolMasks> masks = masks_of(state);
  if (state.bad_pings.empty()) return masks;
  for (SchoolMasks& school : masks) {
    std::erase_if(school.pings, [&](const SchoolMasks::InPing& there) {
      return is_bad(state, times[static_cast<std::size_t>(there.ping_index)]);
    });
  }
  std::erase_if(masks, [](const SchoolMasks& school) { return school.pings.empty(); });
  return masks;
}

}  // namespace sonar
