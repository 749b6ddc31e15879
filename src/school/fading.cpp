// SPDX-License-Identifier: Apache-2.0
#include "school/fading.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "base/units.h"
#include "geo/frames.h"

namespace sonar {
namespace {

const double kSigmasInWidth = 2.0 * std::sqrt(2.0 * std::numbers::ln2);  ///< a Gaussian's full width at half maximum

/// A two-way beam's amplitude is exp(-x^2 / (2 s^2)), where s is the standard deviation of the one-way intensity; the integral
/// of two such d apart is exp(-d^2 / (4 s^2)) of that of one squared.
double beams_correlation(double apart_deg, double width_deg) {
  const double sigmas = kSigmasInWidth * apart_deg / width_deg;
  return std::isfinite(sigmas) ? std::exp(-0.25 * sigmas * sigmas) : 0.0;
}

/// Unless it is told otherwise.
bool alike_frequency(const BeamGrid& grid, int a, int b) {
  const auto last = std::ssize(grid.frequency_hz);
  if (a >= last || b >= last) return true;
  return grid.frequency_hz[static_cast<std::size_t>(a)] == grid.frequency_hz[static_cast<std::size_t>(b)];
}

}  // namespace

double spacing_deg(const std::vector<double>& angles, int at) {
  const auto last = std::ssize(angles) - 1;
  if (last < 1) return 1.0;
  const std::ptrdiff_t i = std::clamp<std::ptrdiff_t>(at, 1, last);
  return std::abs(angles[static_cast<std::size_t>(i)] - angles[static_cast<std::size_t>(i) - 1]);
}

double amplitude_correlation(const BeamGrid& grid, int row, int other) {
  if (row == other) return 1.0;
  const int fans[2] = {row / grid.beams(), other / grid.beams()};
  if (fans[0] != fans[1] && !alike_frequency(grid, fans[0], fans[1])) return 0.0;
  const auto apart = [](const std::vector<double>& angles, int a, int b) {
    return angles[static_cast<std::size_t>(a)] - angles[static_cast<std::size_t>(b)];
  };
  const auto i = static_cast<std::size_t>(row);
  const double level = std::cos(rad_from_deg(grid.elevation_deg[static_cast<std::size_t>(fans[0])]));
  // A ring's first beam lies beside its last.
  const double sideways = level * wrap_180(apart(grid.azimuth_deg, row % grid.beams(), other % grid.beams()));
  const double upright = apart(grid.elevation_deg, fans[0], fans[1]);
  const double by_fans = fans[0] == fans[1] ? 1.0 : beams_correlation(upright, grid.vertical_width_deg[i]);
  const double by_beams = sideways == 0.0 ? 1.0 : beams_correlation(sideways, grid.horizontal_width_deg[i]);
  return by_fans * by_beams;
}

VoxelsAlike voxels_alike_each_way(const BeamGrid& grid, double sample_m, double pulse_m, int row) {
  VoxelsAlike alike{0.0, 0.0, 1.0};
  const int beams = grid.beams();
  for (int f = 0; f < grid.fans(); ++f) {
    alike.fans += std::pow(amplitude_correlation(grid, row, f * beams + row % beams), 2);
  }
  for (int b = 0; b < beams; ++b) {
    alike.beams += std::pow(amplitude_correlation(grid, row, row / beams * beams + b), 2);
  }
  for (int k = 1; k < kLongestPulse && k * sample_m < pulse_m; ++k)
    alike.samples += 2.0 * std::pow(1.0 - k * sample_m / pulse_m, 2);
  return alike;
}

double voxels_alike(const BeamGrid& grid, double sample_m, double pulse_m, int row) {
  const VoxelsAlike each = voxels_alike_each_way(grid, sample_m, pulse_m, row);
  return each.fans * each.beams * each.samples;
}

}  // namespace sonar
