// SPDX-License-Identifier: Apache-2.0
#include "pipeline/journal/carried.h"

#include <algorithm>
#include <vector>

#include "pipeline/journal/continued.h"
#include "school/grow/mask_edit.h"

namespace sonar {
namespace {

using InPing = SchoolMasks::InPing;
using Layer = EarlierSchools::Layer;

TimeNs time_of(const SchoolMask& mask, const Layer& layer) {
  return layer.ping_times[static_cast<std::size_t>(mask.ping_index)];
}

/// Number of the school that a product had at a voxel; 0 = none.
std::int64_t school_then(const Layer& layer, const SchoolKey& key) {
  const auto row = std::find(layer.channel_of_row.begin(), layer.channel_of_row.end(), key.channel);
  if (row == layer.channel_of_row.end()) return 0;
  const auto there = std::find_if(layer.masks.begin(), layer.masks.end(), [&](const SchoolMask& mask) {
    return time_of(mask, layer) == key.ping_time &&
           contains(mask.mask, static_cast<int>(row - layer.channel_of_row.begin()), key.sample);
  });
  return there == layer.masks.end() ? 0 : there->school_id;
}

/// Its masks on the pings and rows of this observation.
std::vector<InPing> masks_now(const Layer& layer, std::int64_t school_id, const CommandContext& context) {
  const std::vector<int> rows = context.grid->row_of_channel();
  std::vector<InPing> masks;
  for (const SchoolMask& mask : layer.masks) {
    const auto ping = mask.school_id == school_id ? ping_at(context, time_of(mask, layer)) : std::nullopt;
    if (!ping) continue;
    PingMask moved = on_rows(mask.mask, layer.channel_of_row, rows);
    if (!moved.empty()) masks.push_back({*ping, std::move(moved), kUnknown});
  }
  std::sort(masks.begin(), masks.end(), [](const InPing& a, const InPing& b) { return a.ping_index < b.ping_index; });
  return masks;
}

}  // namespace

std::optional<std::size_t> heir_of(const SchoolKey& key, const JournalState& state, const CommandContext& context,
                                   const EarlierSchools& earlier) {
  for (const Layer& layer : earlier.layers) {
    const std::int64_t school_id = school_then(layer, key);
    if (school_id == 0) continue;
    const std::vector<InPing> then = masks_now(layer, school_id, context);
    std::optional<std::size_t> heir;
    std::size_t most = 0;
    for (std::size_t i = 0; i < state.schools.size(); ++i) {
      const std::vector<InPing>& now = state.schools[i]->masks.pings;
      const std::size_t shared = shared_voxels(then, now);
      if (shared <= most || !same_fish(then, now)) continue;
      heir = i;
      most = shared;
    }
    if (heir) return heir;
  }
  return std::nullopt;
}

}  // namespace sonar
