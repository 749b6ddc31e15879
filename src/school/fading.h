// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "model/beam_grid.h"

namespace sonar {

/// Samples of a pulse, the most that fading is worked out for: files may state any length.
inline constexpr int kLongestPulse = 10'000;

/// Between an angle of a rising list and its neighbour; 1 where it is alone.
[[nodiscard]] double spacing_deg(const std::vector<double>& angles, int at);

/// Correlation of the complex amplitudes that two beams hear of many targets: the integral of the product of their two-way
/// patterns of amplitude, Gaussians. That of the intensities is its square. Fans of different frequency share nothing.
/// row, other  fan * beams + beam
[[nodiscard]] double amplitude_correlation(const BeamGrid& grid, int row, int other);

/// The variance of a sum over voxels is so many times that of as many independent ones: the sum of the squares of the
/// correlations of amplitude with all voxels round one, a rectangular pulse's along range.
/// sample_m  spacing of the samples
/// pulse_m   extent of the pulse along range, c tau / 2
/// row       fan * beams + beam
/// source    Goodman 2007, Speckle phenomena in optics, section 3.3
[[nodiscard]] double voxels_alike(const BeamGrid& grid, double sample_m, double pulse_m, int row);
/// The same each way; voxels_alike() is their product.
struct VoxelsAlike {
  double fans = 1.0;
  double beams = 1.0;
  double samples = 1.0;
};
[[nodiscard]] VoxelsAlike voxels_alike_each_way(const BeamGrid& grid, double sample_m, double pulse_m, int row);

}  // namespace sonar
