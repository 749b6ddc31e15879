// SPDX-License-Identifier: Apache-2.0
#include "school/measure/nuclei.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/units.h"
#include "school/runs.h"

namespace sonar {
namespace {

constexpr int kHalf_counts = 256;  ///< 10 log10(2) dB
constexpr int kNone = -1;

struct Voxel {
  std::int16_t count = 0;
  std::size_t cell = 0;  ///< of the mask's box, which has an empty cell more all round
};

/// The strongest first, else in the order that they come in: sorted by counting, as levels are few.
std::vector<Voxel> by_strength(const std::vector<Voxel>& voxels) {
  if (voxels.empty()) return {};
  const auto [least, most] = std::minmax_element(voxels.begin(), voxels.end(),
                                                 [](const Voxel& a, const Voxel& b) { return a.count < b.count; });
  const int strongest = most->count;
  const auto level = [&](const Voxel& voxel) { return static_cast<std::size_t>(strongest - voxel.count); };
  std::vector<std::size_t> first(level(*least) + 2, 0);
  for (const Voxel& voxel : voxels) ++first[level(voxel) + 1];
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
  std::vector<Voxel> sorted(voxels.size());
  for (const Voxel& voxel : voxels) sorted[first[level(voxel)]++] = voxel;
  return sorted;
}

/// Floods the members from the strongest down and joins what meets.
class Flood {
 public:
  Flood(const PingMask& mask, View3<const std::int16_t> filtered) {
    const int beams = filtered.shape().beams;
    const IndexBox box = box_of(mask, beams);
    const auto by_beam = static_cast<std::size_t>(box.samples() + 2);
    const auto by_fan = by_beam * static_cast<std::size_t>(box.beams() + 2);
    steps_ = {1, by_beam, by_fan};
    member_.assign(by_fan * static_cast<std::size_t>(box.fans() + 2), kNone);
    std::vector<Voxel> voxels;
    voxels.reserve(mask.voxels());
    for (const Run& run : mask.runs) {
      const auto counts = filtered.row(run.row);
      const auto fan = static_cast<std::size_t>(run.row / beams - box.first_fan + 1);
      const auto beam = static_cast<std::size_t>(run.row % beams - box.first_beam + 1);
      for (int s = run.first_sample; s < run.end(); ++s) {
        const std::int16_t count = counts[static_cast<std::size_t>(s)];
        if (count == kNoData) continue;
        voxels.push_back({count, fan * by_fan + beam * by_beam + static_cast<std::size_t>(s - box.first_sample + 1)});
      }
    }
    voxels_ = by_strength(voxels);
  }

  int nuclei() {
    root_.reserve(voxels_.size());
    lowest_.reserve(voxels_.size());
    for (std::size_t i = 0; i < voxels_.size(); ++i) {
      root_.push_back(static_cast<int>(i));
      lowest_.push_back(voxels_[i].count);
      const std::size_t cell = voxels_[i].cell;
      member_[cell] = static_cast<int>(i);
      for (const std::size_t step : steps_) {
        meet(static_cast<int>(i), cell - step);
        meet(static_cast<int>(i), cell + step);
      }
    }
    for (std::size_t i = 0; i < root_.size(); ++i) {
      // pieces that hang together with no other: each against its own margin
      const bool is_piece = root_[i] == static_cast<int>(i);
      if (is_piece && (i == 0 || voxels_[i].count - lowest_[i] >= kHalf_counts)) ++nuclei_;
    }
    return nuclei_;
  }

 private:
  void meet(int i, std::size_t cell) {
    if (member_[cell] == kNone) return;
    int stronger = root_of(i);
    int weaker = root_of(member_[cell]);
    if (stronger == weaker) return;
    if (stronger > weaker) std::swap(stronger, weaker);
    const std::int16_t here = voxels_[static_cast<std::size_t>(i)].count;
    if (voxels_[static_cast<std::size_t>(weaker)].count - here >= kHalf_counts) ++nuclei_;
    root_[static_cast<std::size_t>(weaker)] = stronger;
    lowest_[static_cast<std::size_t>(stronger)] = here;
  }

  int root_of(int i) {
    while (root_[static_cast<std::size_t>(i)] != i) {
      int& up = root_[static_cast<std::size_t>(i)];
      up = root_[static_cast<std::size_t>(up)];
      i = up;
    }
    return i;
  }

  std::array<std::size_t, 3> steps_{};  ///< to the next cell along each axis
  std::vector<int> member_;             ///< [cell] index of its voxel once it is flooded, else kNone
  std::vector<Voxel> voxels_;
  std::vector<int> root_;  ///< [voxel] a stronger one of the same part, itself = the part's maximum
  std::vector<std::int16_t> lowest_;
  int nuclei_ = 0;
};

}  // namespace

int count_nuclei(const PingMask& mask, View3<const std::int16_t> filtered) { return Flood(mask, filtered).nuclei(); }

}  // namespace sonar
