// SPDX-License-Identifier: Apache-2.0
#include "school/measure/nuclei.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/units.h"
#include "school/runs.h"

namespace sonar {
namespace {

constexpr int kHalf_counts = 256;  ///< 10 log10(2) dB
constexpr int kNone = -1;

/// Floods the members from the strongest down and joins what meets.
class Flood {
 public:
  Flood(const PingMask& mask, View3<const std::int16_t> filtered)
      : box_(box_of(mask, filtered.shape().beams)),
        shape_{box_.fans(), box_.beams(), box_.samples()},
        member_(shape_.size(), kNone) {
    for (const Run& run : mask.runs) {
      const auto counts = filtered.row(run.row);
      const int beams = filtered.shape().beams;
      const int row = (run.row / beams - box_.first_fan) * shape_.beams + run.row % beams - box_.first_beam;
      for (int s = run.first_sample; s < run.end(); ++s) {
        const std::int16_t count = counts[static_cast<std::size_t>(s)];
        if (count == kNoData) continue;
        const std::size_t cell = static_cast<std::size_t>(row) * static_cast<std::size_t>(shape_.samples) +
                                 static_cast<std::size_t>(s - box_.first_sample);
        voxels_.push_back({count, cell});
      }
    }
    std::sort(voxels_.begin(), voxels_.end(),
              [](const Voxel& a, const Voxel& b) { return a.count != b.count ? a.count > b.count : a.cell < b.cell; });
  }

  int nuclei() {
    for (std::size_t i = 0; i < voxels_.size(); ++i) {
      root_.push_back(static_cast<int>(i));
      lowest_.push_back(voxels_[i].count);
      member_[voxels_[i].cell] = static_cast<int>(i);
      meet_neighbours(static_cast<int>(i));
    }
    for (std::size_t i = 0; i < root_.size(); ++i) {
      // pieces that hang together with no other: each against its own margin
      const bool is_piece = root_[i] == static_cast<int>(i);
      if (is_piece && (i == 0 || voxels_[i].count - lowest_[i] >= kHalf_counts)) ++nuclei_;
    }
    return nuclei_;
  }

 private:
  struct Voxel {
    std::int16_t count = 0;
    std::size_t cell = 0;
  };

  void meet_neighbours(int i) {
    const std::size_t cell = voxels_[static_cast<std::size_t>(i)].cell;
    const auto samples = static_cast<std::size_t>(shape_.samples);
    const std::size_t s = cell % samples;
    const auto row = static_cast<int>(cell / samples);
    if (s > 0) meet(i, cell - 1);
    if (s + 1 < samples) meet(i, cell + 1);
    const NeighbourRows around = neighbour_rows(row, shape_, Connectivity::faces);
    for (int n = 0; n < around.count; ++n) meet(i, static_cast<std::size_t>(around.row[n]) * samples + s);
  }

  void meet(int i, std::size_t cell) {
    if (member_[cell] == kNone) return;
    int a = root_of(i);
    int b = root_of(member_[cell]);
    if (a == b) return;
    if (a > b) std::swap(a, b);  // a is the stronger maximum
    const auto weaker = static_cast<std::size_t>(b);
    const std::int16_t here = voxels_[static_cast<std::size_t>(i)].count;
    if (voxels_[weaker].count - here >= kHalf_counts) ++nuclei_;
    root_[weaker] = a;
    lowest_[static_cast<std::size_t>(a)] = here;
  }

  int root_of(int i) {
    while (root_[static_cast<std::size_t>(i)] != i) {
      int& up = root_[static_cast<std::size_t>(i)];
      up = root_[static_cast<std::size_t>(up)];
      i = up;
    }
    return i;
  }

  IndexBox box_;
  Shape3 shape_;
  std::vector<int> member_;  ///< [cell of the box] index of its voxel once it is under water, else kNone
  std::vector<Voxel> voxels_;
  std::vector<int> root_;  ///< [voxel] a stronger one of the same part, itself = the part's maximum
  std::vector<std::int16_t> lowest_;
  int nuclei_ = 0;
};

}  // namespace

int count_nuclei(const PingMask& mask, View3<const std::int16_t> filtered) { return Flood(mask, filtered).nuclei(); }

}  // namespace sonar
