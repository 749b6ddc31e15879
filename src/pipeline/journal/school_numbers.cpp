// SPDX-License-Identifier: Apache-2.0
#include "pipeline/journal/school_numbers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace sonar {
namespace {

/// A school and a number that it may have had.
struct Candidate {
  std::size_t shared = 0;
  std::size_t school = 0;
  std::int64_t number = 0;
  [[nodiscard]] auto order() const { return std::tuple(~shared, school, number); }
};

std::map<TimeNs, std::vector<const SchoolMask*>> by_time(const EarlierSchools::Layer& layer) {
  std::map<TimeNs, std::vector<const SchoolMask*>> masks;
  for (const SchoolMask& mask : layer.masks) {
    if (mask.school_id < layer.first_number) continue;
    masks[layer.ping_times[static_cast<std::size_t>(mask.ping_index)]].push_back(&mask);
  }
  return masks;
}

/// Voxels that each school shares with each number.
using Shared = std::map<std::pair<std::size_t, std::int64_t>, std::size_t>;

void add_shared(const std::vector<SchoolMasks>& schools, const BeamGrid& grid, std::span<const TimeNs> ping_times,
                const EarlierSchools::Layer& layer, Shared& shared) {
  const std::vector<int> rows = grid.row_of_channel();
  const bool same_rows = layer.channel_of_row == grid.channel;
  const auto before = by_time(layer);
  for (std::size_t s = 0; s < schools.size(); ++s) {
    for (const SchoolMasks::InPing& in_ping : schools[s].pings) {
      const auto there = before.find(ping_times[static_cast<std::size_t>(in_ping.ping_index)]);
      if (there == before.end()) continue;
      for (const SchoolMask* mask : there->second) {
        const std::size_t voxels = same_rows ? overlap(in_ping.mask, mask->mask)
                                             : overlap(in_ping.mask, on_rows(mask->mask, layer.channel_of_row, rows));
        if (voxels > 0) shared[{s, mask->school_id}] += voxels;
      }
    }
  }
}

std::vector<Candidate> candidates(const std::vector<SchoolMasks>& schools, const BeamGrid& grid,
                                  std::span<const TimeNs> ping_times, const EarlierSchools& earlier) {
  Shared shared;
  for (const EarlierSchools::Layer& layer : earlier.layers) add_shared(schools, grid, ping_times, layer, shared);
  std::vector<Candidate> list;
  for (const auto& [pair, voxels] : shared) list.push_back({voxels, pair.first, pair.second});
  std::sort(list.begin(), list.end(), [](const Candidate& a, const Candidate& b) { return a.order() < b.order(); });
  return list;
}

}  // namespace

PingMask on_rows(const PingMask& mask, const std::vector<int>& channel_of_row, const std::vector<int>& row_of_channel) {
  PingMask moved;
  std::size_t voxels = 0;
  for (Run run : mask.runs) {
    const auto channel = static_cast<std::size_t>(channel_of_row[static_cast<std::size_t>(run.row)]);
    run.row = channel < row_of_channel.size() ? row_of_channel[channel] : -1;
    if (run.row < 0) continue;
    moved.runs.push_back(run);
    voxels += static_cast<std::size_t>(run.count);
  }
  std::sort(moved.runs.begin(), moved.runs.end());
  moved.confidence.assign(voxels, 255);
  return moved;
}

void EarlierSchools::add(ObservationProduct product, double time_offset_s) {
  const std::int64_t next = sonar::next_school_id(product);
  const auto offset = static_cast<std::uint64_t>(std::llround(time_offset_s * 1e9));
  Layer layer;
  for (const PingNavigation& ping : product.pings) {
    layer.ping_times.push_back(static_cast<TimeNs>(static_cast<std::uint64_t>(ping.time) - offset));
  }
  if (product.grid) layer.channel_of_row = std::move(product.grid->grid.channel);
  layer.masks = std::move(product.masks);
  if (!layers.empty()) layer.first_number = next_school_id;
  layers.push_back(std::move(layer));
  next_school_id = std::max(next_school_id, next);
}

std::int64_t keep_numbers(std::vector<SchoolMasks>& schools, const BeamGrid& grid, std::span<const TimeNs> ping_times,
                          const EarlierSchools& earlier) {
  std::vector<bool> numbered(schools.size(), false);
  std::set<std::int64_t> taken;
  for (const Candidate& candidate : candidates(schools, grid, ping_times, earlier)) {
    if (numbered[candidate.school] || !taken.insert(candidate.number).second) continue;
    numbered[candidate.school] = true;
    schools[candidate.school].decided.school_id = candidate.number;
  }
  std::int64_t next = earlier.next_school_id;
  for (std::size_t s = 0; s < schools.size(); ++s) {
    if (!numbered[s]) schools[s].decided.school_id = next++;
  }
  return next;
}

}  // namespace sonar
