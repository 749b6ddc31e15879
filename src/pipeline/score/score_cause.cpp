// SPDX-License-Identifier: Apache-2.0
#include "pipeline/score/score_cause.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

namespace sonar {
namespace {

/// Samples [first, end) of one row.
using Stretch = std::pair<std::int64_t, std::int64_t>;

/// How many samples lie in any of some stretches.
std::int64_t covered(std::vector<Stretch> stretches) {
  std::sort(stretches.begin(), stretches.end());
  std::int64_t sum = 0;
  std::int64_t done = std::numeric_limits<std::int64_t>::min();
  for (const auto& [first, end] : stretches) {
    const std::int64_t from = std::max(first, done);
    if (end <= from) continue;
    sum += end - from;
    done = end;
  }
  return sum;
}

struct Held {
  std::int64_t voxels = 0;       ///< of the mask
  double voxels_of_boxes = 0.0;  ///< all that the boxes enclose
};
using HeldByKind = std::map<std::string, Held>;

/// Cells from first to last, both included; in double, as the bounds are a file's.
double width(std::int64_t first, std::int64_t last) {
  return static_cast<double>(last) - static_cast<double>(first) + 1.0;
}

/// mask  runs by channel
void add_ping(const PingMask& mask, const std::vector<CompanyBox>& boxes, const BeamGrid& grid, HeldByKind& held) {
  const std::vector<int> row_of_channel = grid.row_of_channel();
  for (const CompanyBox& box : boxes) {
    held[box.kind].voxels_of_boxes += width(box.first_fan, box.last_fan) * width(box.first_beam, box.last_beam) *
                                      width(box.first_sample, box.last_sample);
  }
  for (const Run& run : mask.runs) {
    const bool known = static_cast<std::size_t>(run.row) < row_of_channel.size();
    const int row = known ? row_of_channel[static_cast<std::size_t>(run.row)] : -1;
    if (row < 0) continue;
    const std::int64_t fan = row / grid.beams();
    const std::int64_t beam = row % grid.beams();
    std::map<std::string, std::vector<Stretch>> inside;
    for (const CompanyBox& box : boxes) {
      if (fan < box.first_fan || fan > box.last_fan || beam < box.first_beam || beam > box.last_beam) continue;
      const Stretch both{std::max<std::int64_t>(run.first_sample, box.first_sample),
                         std::min<std::int64_t>(run.end() - 1, box.last_sample) + 1};
      if (both.first < both.second) inside[box.kind].push_back(both);
    }
    for (auto& [kind, stretches] : inside) held[kind].voxels += covered(std::move(stretches));
  }
}

}  // namespace

std::pair<std::string, double> cause_of(const SchoolKey& track, const ScoredSides& sides) {
  if (!sides.truth_side.company) return {kCauseUnknown, kUnknown};
  const auto& [observation, school_id] = track;
  HeldByKind held;
  double voxels = 0.0;
  const PingKey first{observation, school_id, std::numeric_limits<std::int64_t>::min()};
  for (auto at = sides.found.masks.lower_bound(first); at != sides.found.masks.end(); ++at) {
    const auto& [o, id, ping_index] = at->first;
    if (o != observation || id != school_id) break;
    voxels += static_cast<double>(at->second.voxels());
    const auto& pings = sides.found_side.observations[observation].pings;
    const auto there = ping_at(sides.truth, pings[static_cast<std::size_t>(ping_index)].time);
    if (!there) continue;
    const ObservationProduct& product = sides.truth_side.observations[there->first];
    const auto boxes = sides.truth_side.company->find({product.observation, there->second});
    if (boxes != sides.truth_side.company->end()) add_ping(at->second, boxes->second, product.grid->grid, held);
  }
  const auto most = std::max_element(held.begin(), held.end(), [](const auto& a, const auto& b) {
    return a.second.voxels != b.second.voxels ? a.second.voxels < b.second.voxels
                                              : a.second.voxels_of_boxes > b.second.voxels_of_boxes;
  });
  if (most == held.end() || voxels == 0.0) return {kCauseNone, 0.0};
  const double share = static_cast<double>(most->second.voxels) / voxels;
  return {share >= kCauseShare ? most->first : std::string(kCauseNone), share};
}

}  // namespace sonar
