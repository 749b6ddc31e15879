// SPDX-License-Identifier: Apache-2.0
#include "school/detect/flood.h"

#include <cstddef>
#include <queue>
#include <tuple>
#include <utility>

#include "base/check.h"
#include "base/units.h"

namespace sonar {
namespace {

constexpr int kLand = -2;  ///< no flood goes there
constexpr int kDry = -1;   ///< no flood was there yet

class Flood {
 public:
  Flood(View3<const std::int16_t> sv, std::span<const Run> water, Connectivity connectivity)
      : sv_(sv), water_(water), connectivity_(connectivity), box_(round(water, sv.shape().beams)) {
    const Shape3 shape{box_.fans(), box_.beams(), box_.samples()};
    school_ = Array3<int>(shape, kLand);
    for (const Run& run : water) {
      for (int s = run.first_sample; s < run.end(); ++s) at({run.row, s}) = kDry;
    }
  }

  void pour(const std::vector<Run>& core, int school) {
    for (const Run& run : core) {
      for (int s = run.first_sample; s < run.end(); ++s) take({run.row, s}, school, kMaxCount);
    }
  }

  void rise() {
    while (!shore_.empty()) {
      const VoxelIndex from = std::get<VoxelIndex>(shore_.top());
      shore_.pop();
      const int school = at(from);
      const NeighbourRows rows = neighbour_rows(from.row, sv_.shape(), connectivity_);
      const int widen = connectivity_ == Connectivity::all ? 1 : 0;
      for (int s = from.sample - 1; s <= from.sample + 1; ++s) reach({from.row, s}, school);
      for (int n = 0; n < rows.count; ++n) {
        for (int s = from.sample - widen; s <= from.sample + widen; ++s) reach({rows.row[n], s}, school);
      }
    }
  }

  [[nodiscard]] std::vector<std::vector<Run>> shares(std::size_t schools) {
    std::vector<std::vector<Run>> shares(schools);
    for (const Run& run : water_) {
      int open = kDry;
      for (int s = run.first_sample; s < run.end(); ++s) {
        const int school = at({run.row, s});
        if (school != kDry) {
          std::vector<Run>& share = shares[static_cast<std::size_t>(school)];
          if (open != school) share.push_back({run.row, s, 0});
          ++share.back().count;
        }
        open = school;
      }
    }
    return shares;
  }

 private:
  static IndexBox round(std::span<const Run> water, int beams) {
    PingMask mask;
    mask.runs.assign(water.begin(), water.end());
    return box_of(mask, beams);
  }

  int& at(VoxelIndex voxel) {
    const int beams = sv_.shape().beams;
    return school_(voxel.row / beams - box_.first_fan, voxel.row % beams - box_.first_beam,
                   voxel.sample - box_.first_sample);
  }

  void take(VoxelIndex voxel, int school, std::int16_t loudness) {
    SONAR_CHECK(at(voxel) == kDry);
    at(voxel) = school;
    // Of equally loud voxels those that were reached first, so that floods meet halfway on a plain.
    shore_.emplace(loudness, --reached_, voxel);
  }

  void reach(VoxelIndex voxel, int school) {
    const int beams = sv_.shape().beams;
    if (!box_.contains(voxel.row / beams, voxel.row % beams, voxel.sample) || at(voxel) != kDry) return;
    take(voxel, school, sv_.row(voxel.row)[static_cast<std::size_t>(voxel.sample)]);
  }

  View3<const std::int16_t> sv_;
  std::span<const Run> water_;
  Connectivity connectivity_;
  IndexBox box_;
  Array3<int> school_;  ///< of the box's voxels: kLand, kDry or which school's flood took it
  std::priority_queue<std::tuple<std::int16_t, std::int64_t, VoxelIndex>> shore_;
  std::int64_t reached_ = 0;
};

}  // namespace

std::vector<std::vector<Run>> flood(View3<const std::int16_t> sv, std::span<const Run> water,
                                    std::span<const std::vector<Run>> cores, Connectivity connectivity) {
  if (water.empty()) return std::vector<std::vector<Run>>(cores.size());
  Flood rising(sv, water, connectivity);
  for (std::size_t i = 0; i < cores.size(); ++i) rising.pour(cores[i], static_cast<int>(i));
  rising.rise();
  return rising.shares(cores.size());
}

}  // namespace sonar
