// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "signal/median.h"

namespace sonar {

/// Two-way loss of a target on a beam's axis in the beam beside it, dB, for a Gaussian main lobe: 24 (spacing / width)^2.
/// width  one-way -3 dB, in the unit of the spacing; 0 where the beams are known badly, 60 at most
[[nodiscard]] double neighbour_loss_db(double spacing, double width);

/// The loss to the nearest fan, [row].
/// elevation_deg       [fan], finite or the loss is 0
/// vertical_width_deg  [fan][beam], one-way -3 dB; may be empty
[[nodiscard]] std::vector<double> fan_losses_db(std::span<const double> elevation_deg,
                                                std::span<const double> vertical_width_deg);

/// The median's box for a beam grid: along range alone where the beams are separate both ways, because there a school of
/// two or three beams and fans is a minority of a box of 3 x 3 and would be filtered away.
/// elevation_deg, azimuth_deg  [fan], [beam]
/// *_width_deg                 [fan][beam], one-way -3 dB; empty or not of that size = left as it is
[[nodiscard]] MedianParams fitted(const MedianParams& params, std::span<const double> elevation_deg,
                                  std::span<const double> azimuth_deg, std::span<const double> vertical_width_deg,
                                  std::span<const double> horizontal_width_deg);

}  // namespace sonar
