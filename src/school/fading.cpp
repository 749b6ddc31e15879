// SPDX-License-Identifier: Apache-2.0
#include "school/fading.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sonar {
namespace {

constexpr double kTwoWay = 0.7071;  ///< two-way beams are as much narrower; neighbours fade alike within that width

double alike(double width, double spacing) { return std::isfinite(width) ? std::max(1.0, width / spacing) : 1.0; }

}  // namespace

double spacing_deg(const std::vector<double>& angles, int at) {
  const auto last = std::ssize(angles) - 1;
  if (last < 1) return 1.0;
  const std::ptrdiff_t i = std::clamp<std::ptrdiff_t>(at, 1, last);
  return std::abs(angles[static_cast<std::size_t>(i)] - angles[static_cast<std::size_t>(i) - 1]);
}

VoxelsAlike voxels_alike_each_way(const BeamGrid& grid, double sample_m, double pulse_m, int row) {
  const double vertical = grid.vertical_width_deg[static_cast<std::size_t>(row)];
  const double horizontal = grid.horizontal_width_deg[static_cast<std::size_t>(row)];
  const double fan_deg = spacing_deg(grid.elevation_deg, row / grid.beams());
  const double beam_deg = spacing_deg(grid.azimuth_deg, row % grid.beams());
  return {alike(kTwoWay * vertical, fan_deg), alike(kTwoWay * horizontal, beam_deg), alike(pulse_m, sample_m)};
}

double voxels_alike(const BeamGrid& grid, double sample_m, double pulse_m, int row) {
  const VoxelsAlike each = voxels_alike_each_way(grid, sample_m, pulse_m, row);
  return each.fans * each.beams * each.samples;
}

}  // namespace sonar
