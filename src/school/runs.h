// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/array.h"
#include "model/grow_params.h"
#include "model/mask.h"

namespace sonar {

/// One voxel of a ping.
struct VoxelIndex {
  std::int32_t row = 0;  ///< fan * beams + beam
  std::int32_t sample = 0;
  friend auto operator<=>(const VoxelIndex&, const VoxelIndex&) = default;
};

/// A box of voxels, bounds included. Default: empty.
struct IndexBox {
  int first_fan = 0;
  int last_fan = -1;
  int first_beam = 0;
  int last_beam = -1;
  int first_sample = 0;
  int last_sample = -1;

  [[nodiscard]] static IndexBox whole(const Shape3& shape) {
    return {0, shape.fans - 1, 0, shape.beams - 1, 0, shape.samples - 1};
  }
  [[nodiscard]] bool empty() const {
    return last_fan < first_fan || last_beam < first_beam || last_sample < first_sample;
  }
  [[nodiscard]] int fans() const { return last_fan - first_fan + 1; }
  [[nodiscard]] int beams() const { return last_beam - first_beam + 1; }
  [[nodiscard]] int samples() const { return last_sample - first_sample + 1; }
  [[nodiscard]] bool contains(int fan, int beam, int sample) const {
    return fan >= first_fan && fan <= last_fan && beam >= first_beam && beam <= last_beam && sample >= first_sample &&
           sample <= last_sample;
  }
  [[nodiscard]] bool contains(const IndexBox& other) const {
    return contains(other.first_fan, other.first_beam, other.first_sample) &&
           contains(other.last_fan, other.last_beam, other.last_sample);
  }
  [[nodiscard]] IndexBox enlarged(int by_fans, int by_beams, int by_samples) const {
    return {first_fan - by_fans,  last_fan + by_fans,        first_beam - by_beams,
            last_beam + by_beams, first_sample - by_samples, last_sample + by_samples};
  }
  [[nodiscard]] IndexBox clipped(const Shape3& shape) const {
    return {std::max(first_fan, 0),    std::min(last_fan, shape.fans - 1),
            std::max(first_beam, 0),   std::min(last_beam, shape.beams - 1),
            std::max(first_sample, 0), std::min(last_sample, shape.samples - 1)};
  }
  friend bool operator==(const IndexBox&, const IndexBox&) = default;
};

/// Smallest box round a mask; empty for an empty mask.
[[nodiscard]] IndexBox box_of(const PingMask& mask, int beams);

/// Neighbouring rows (fan * beams + beam) of a row, itself excluded: 4 for faces, 8 for all; fewer at borders.
struct NeighbourRows {
  int count = 0;
  int row[8] = {};
};
[[nodiscard]] NeighbourRows neighbour_rows(int row, const Shape3& shape, Connectivity connectivity);

/// Labels of runs that hang together: union-find over the runs of neighbouring rows.
/// runs   sorted by (row, first_sample), not overlapping
/// out    [run] component 0.. in order of each component's first run
/// cost   linear in runs
struct Components {
  std::vector<int> label;  ///< [run]
  int count = 0;
};
[[nodiscard]] Components label_runs(std::span<const Run> runs, const Shape3& shape, Connectivity connectivity);

/// Sorted runs that may overlap or touch, as runs that do not.
[[nodiscard]] std::vector<Run> merged_runs(std::span<const Run> runs);

/// Row -> range of its runs in a sorted list: first[row] .. first[row + 1].
[[nodiscard]] std::vector<int> index_rows(std::span<const Run> runs, std::size_t rows);

/// Calls visit(first, end) for each stretch of a run that another row's runs leave uncovered.
/// other  runs of one row, sorted
template <class Visit>
void for_each_uncovered(const Run& run, std::span<const Run> other, Visit visit) {
  int s = run.first_sample;
  for (const Run& cover : other) {
    if (cover.end() <= s) continue;
    if (cover.first_sample >= run.end()) break;
    if (cover.first_sample > s) visit(s, cover.first_sample);
    s = cover.end();
  }
  if (s < run.end()) visit(s, run.end());
}

}  // namespace sonar
