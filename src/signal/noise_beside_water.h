// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

namespace sonar {

// A receiver's noise has the same power at every range; the echo of uniform water fades as the sonar equation says. So the two are
// told apart by how levels fall with range. Schools, layers and the seabed only add to both: what the water and the noise are is
// told by the weakest quarter of the levels.

/// Sv of the uniform water that, beside noise of one power, explains the levels of a fan best: quantile regression of Sv on
/// gain at the lower quartile, relative to the levels.
/// in      sv > 0 of each block, gain > 0 as block_gain() has it, equal lengths; linear
/// out     linear, >= 0; 0 of fewer than two blocks
/// source  Koenker & Bassett 1978; a best line passes through two of the points or, here, may lie on an axis
/// cost    (blocks)^3
[[nodiscard]] double uniform_water_sv(std::span<const double> sv, std::span<const double> gain);

/// Power of a row's noise: the lower quartile of what its levels leave above the water.
/// in      power > 0 of each block; water = power of uniform water there, usual = power that blocks like these usually
///         have, whose inverses are the weights; equal lengths, at least one
/// spread  relative standard deviation of a level: the lower quartile of levels that hold noise alone lies 0.674 of it low,
///         and no less noise than one of it can be told from none
/// out     > 0
[[nodiscard]] double noise_beside_water(std::span<const double> power, std::span<const double> water,
                                        std::span<const double> usual, double spread);

}  // namespace sonar
