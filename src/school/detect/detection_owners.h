// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "geo/sector.h"
#include "school/runs.h"
#include "school/track/track.h"

namespace sonar {

/// Which detection of a ping holds a voxel.
class DetectionOwners {
 public:
  DetectionOwners(const DetectedPing& ping, const Sector& sector) : beams_(sector.beams()) {
    for (std::size_t d = 0; d < ping.detections.size(); ++d) {
      for (const Run& run : ping.detections[d].mask.runs) owned_.emplace_back(run, static_cast<int>(d));
    }
    std::sort(owned_.begin(), owned_.end());
    std::vector<Run> runs;
    for (const auto& [run, detection] : owned_) runs.push_back(run);
    rows_ = index_rows(runs, static_cast<std::size_t>(sector.fans()) * static_cast<std::size_t>(beams_));
  }

  /// -1 = none.
  [[nodiscard]] int at(const SectorIndex& index) const {
    const int row = static_cast<int>(std::lround(index.fan)) * beams_ + static_cast<int>(std::lround(index.beam));
    if (row < 0 || row + 1 >= static_cast<int>(rows_.size())) return -1;
    const auto r = static_cast<std::size_t>(row);
    const auto sample = static_cast<std::int32_t>(std::lround(index.sample));
    const auto begin = owned_.begin() + rows_[r];
    const auto end = owned_.begin() + rows_[r + 1];
    auto it =
        std::upper_bound(begin, end, sample, [](std::int32_t s, const auto& o) { return s < o.first.first_sample; });
    if (it == begin) return -1;
    --it;
    return sample < it->first.end() ? it->second : -1;
  }

 private:
  int beams_;
  std::vector<std::pair<Run, int>> owned_;
  std::vector<int> rows_;
};

}  // namespace sonar
