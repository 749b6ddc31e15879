// SPDX-License-Identifier: Apache-2.0
#include "school/measure/surface_area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/check.h"
#include "school/runs.h"

namespace sonar {
namespace {

/// The six ways that a face may look, in pairs of opposite ones.
enum Way : std::size_t { kUp, kDown, kRight, kLeft, kFar, kNear };
constexpr std::size_t kWays = 6;
using Faces = std::array<double, kWays>;  ///< m^2 that look each way

/// (r2^2 - r1^2) / 2 of samples first .. end - 1: area between two rays that are one radian apart.
double ring_m2(const RangeAxis& axis, int first, int end) {
  const double near_m = std::max(axis.range_m(first - 0.5), 0.0);
  const double far_m = std::max(axis.range_m(end - 0.5), 0.0);
  return (far_m * far_m - near_m * near_m) / 2.0;
}

/// Faces of a body's cells, summed over blocks of one beam of one fan that are about as long as they are wide.
class FaceBlocks {
 public:
  FaceBlocks(std::span<const Run> runs, const Sector& sector)
      : sector_(sector), runs_(runs), shape_{sector.fans(), sector.beams(), sector.range().count} {
    PingMask whole;
    whole.runs.assign(runs.begin(), runs.end());
    box_ = box_of(whole, shape_.beams);
    const double middle_m = std::max(sector.range().range_m((box_.first_sample + box_.last_sample) / 2.0), 0.0);
    const double solid_angle =
        sector.solid_angle_sr((box_.first_fan + box_.last_fan) / 2, (box_.first_beam + box_.last_beam) / 2);
    const double across_m = middle_m * std::sqrt(solid_angle);
    length_ = std::max(1, static_cast<int>(std::lround(across_m / sector.range().spacing_m)));
    blocks_ = (box_.samples() + length_ - 1) / length_;
    faces_.resize(static_cast<std::size_t>(box_.fans()) * static_cast<std::size_t>(box_.beams()) *
                  static_cast<std::size_t>(blocks_));
    collect();
  }

  [[nodiscard]] double area_m2() const {
    double sum = 0.0;
    for (int fan = 0; fan < box_.fans(); ++fan) {
      for (int beam = 0; beam < box_.beams(); ++beam) {
        for (int block = 0; block < blocks_; ++block) sum += area_of(fan, beam, block);
      }
    }
    return sum;
  }

 private:
  [[nodiscard]] std::size_t index(int fan, int beam, int block) const {
    return (static_cast<std::size_t>(fan) * static_cast<std::size_t>(box_.beams()) + static_cast<std::size_t>(beam)) *
               static_cast<std::size_t>(blocks_) +
           static_cast<std::size_t>(block);
  }
  Faces& at(int row, int sample) {
    return faces_[index(row / shape_.beams - box_.first_fan, row % shape_.beams - box_.first_beam,
                        (sample - box_.first_sample) / length_)];
  }

  void collect() {
    const std::vector<int> rows = index_rows(runs_, shape_.rows());
    const RangeAxis& axis = sector_.range();
    for (const Run& run : runs_) {
      const double solid_angle = sector_.solid_angle_sr(run.row / shape_.beams, run.row % shape_.beams);
      const double near_m = std::max(axis.range_m(run.first_sample - 0.5), 0.0);
      const double far_m = std::max(axis.range_m(run.end() - 0.5), 0.0);
      at(run.row, run.first_sample)[kNear] += solid_angle * near_m * near_m;
      at(run.row, run.end() - 1)[kFar] += solid_angle * far_m * far_m;
      side(run, rows, 1, 0, kUp);
      side(run, rows, -1, 0, kDown);
      side(run, rows, 0, 1, kRight);
      side(run, rows, 0, -1, kLeft);
    }
  }

  void side(const Run& run, const std::vector<int>& rows, int by_fan, int by_beam, Way way) {
    const int fan = run.row / shape_.beams;
    const int beam = run.row % shape_.beams;
    const AngleBounds e = sector_.elevation_bounds(fan);
    const AngleBounds a = sector_.azimuth_bounds(beam);
    const double angle =
        by_beam != 0 ? e.upper - e.lower : std::cos(by_fan > 0 ? e.upper : e.lower) * (a.upper - a.lower);
    std::span<const Run> others;
    if (fan + by_fan >= 0 && fan + by_fan < shape_.fans && beam + by_beam >= 0 && beam + by_beam < shape_.beams) {
      const auto r = static_cast<std::size_t>(run.row + by_fan * shape_.beams + by_beam);
      others = runs_.subspan(static_cast<std::size_t>(rows[r]), static_cast<std::size_t>(rows[r + 1] - rows[r]));
    }
    for_each_uncovered(run, others, [&](int first, int end) {
      while (first < end) {  // block by block
        const int next = std::min(end, first + length_ - (first - box_.first_sample) % length_);
        at(run.row, first)[way] += angle * ring_m2(sector_.range(), first, next);
        first = next;
      }
    });
  }

  /// Faces round a block, the nearer ones with more weight.
  [[nodiscard]] Faces around(int fan, int beam, int block) const {
    Faces sum{};
    for (int f = std::max(fan - 1, 0); f <= std::min(fan + 1, box_.fans() - 1); ++f) {
      for (int b = std::max(beam - 1, 0); b <= std::min(beam + 1, box_.beams() - 1); ++b) {
        for (int k = std::max(block - 1, 0); k <= std::min(block + 1, blocks_ - 1); ++k) {
          const double weight = (f == fan ? 2.0 : 1.0) * (b == beam ? 2.0 : 1.0) * (k == block ? 2.0 : 1.0);
          const Faces& faces = faces_[index(f, b, k)];
          for (std::size_t way = 0; way < kWays; ++way) sum[way] += weight * faces[way];
        }
      }
    }
    return sum;
  }

  [[nodiscard]] double area_of(int fan, int beam, int block) const {
    const Faces& faces = faces_[index(fan, beam, block)];
    if (std::all_of(faces.begin(), faces.end(), [](double face) { return !(face > 0.0); })) return 0.0;
    const Faces sum = around(fan, beam, block);
    const std::array<double, 3> net{sum[kUp] - sum[kDown], sum[kRight] - sum[kLeft], sum[kFar] - sum[kNear]};
    double area = 0.0;
    for (std::size_t way = 0; way < kWays; ++way) {
      if (!(faces[way] > 0.0)) continue;
      // The other side of a thin body is no part of this side's surface.
      std::array<double, 3> normal = net;
      normal[way / 2] = sum[way];
      area += faces[way] * sum[way] / std::hypot(normal[0], normal[1], normal[2]);
    }
    return area;
  }

  const Sector& sector_;
  std::span<const Run> runs_;
  Shape3 shape_;
  IndexBox box_;
  int length_ = 1;  ///< samples
  int blocks_ = 0;  ///< along range
  std::vector<Faces> faces_;
};

}  // namespace

double surface_m2(std::span<const Run> runs, const Sector& sector) {
  SONAR_CHECK(!runs.empty());
  return FaceBlocks(runs, sector).area_m2();
}

double area_from_above_m2(std::span<const Run> runs, const Sector& sector) {
  const RangeAxis& axis = sector.range();
  std::vector<std::vector<std::pair<double, double>>> stretches(static_cast<std::size_t>(sector.beams()));
  for (const Run& run : runs) {
    const AngleBounds e = sector.elevation_bounds(run.row / sector.beams());
    const double lower = std::cos(e.lower);
    const double upper = std::cos(e.upper);
    const double most = e.lower <= 0.0 && e.upper >= 0.0 ? 1.0 : std::max(lower, upper);
    const double near_m = std::max(axis.range_m(run.first_sample - 0.5), 0.0);
    const double far_m = std::max(axis.range_m(run.end() - 0.5), 0.0);
    stretches[static_cast<std::size_t>(run.row % sector.beams())].emplace_back(near_m * std::min(lower, upper),
                                                                               far_m * most);
  }
  double area = 0.0;
  for (std::size_t beam = 0; beam < stretches.size(); ++beam) {
    std::sort(stretches[beam].begin(), stretches[beam].end());
    const AngleBounds a = sector.azimuth_bounds(static_cast<int>(beam));
    double covered_m = 0.0;  // horizontal range up to which all is counted
    for (const auto& [near_m, far_m] : stretches[beam]) {
      const double from_m = std::max(near_m, covered_m);
      if (far_m > from_m) area += (a.upper - a.lower) * (far_m * far_m - from_m * from_m) / 2.0;
      covered_m = std::max(covered_m, far_m);
    }
  }
  return area;
}

}  // namespace sonar
