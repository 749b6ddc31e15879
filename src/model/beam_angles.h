// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "model/beam_grid.h"

namespace sonar {

/// Solid angle of a two-way beam that is the square of a one-way beam, over the product of its -3 dB widths: the
/// Gaussian's pi / (8 ln 2). A uniform line's, (2/3 x pi/2 / 1.3916)^2, is the same to 0.01 dB.
inline constexpr double kSquareBeamArea = std::numbers::pi / (8.0 * std::numbers::ln2);

/// So much wider, at most, is a two-way beam whose transmit beam is as wide as can be, both ways, dB: 3/2 of the square's
/// integral for a uniform line, a little less for others.
inline constexpr double kWidestTransmit_db = 3.522;

/// Equivalent two-way beam angle of a beam that sends as narrowly as it receives, dB re 1 sr.
/// in   one-way -3 dB widths, degrees
/// out  NaN where a width is missing (0) or unknown
[[nodiscard]] double psi_from_widths_db(double vertical_deg, double horizontal_deg);

/// The same for each beam of a grid, [fan][beam].
[[nodiscard]] std::vector<double> psi_from_widths_db(const BeamGrid& grid);

/// By how much the stated equivalent beam angle exceeds that of the stated widths, dB, [fan][beam]; NaN = not known.
/// Where widths and gain are right, sums of backscatter under the stated one are too low by so much. Up to
/// kWidestTransmit_db may be a wide transmit beam; what lies beyond, or below 0, no beam of these widths can have.
[[nodiscard]] std::vector<double> psi_excess_db(const BeamGrid& grid);

/// The excess over some beams.
struct PsiExcess {
  double least_db = 0.0;
  double mean_db = 0.0;  ///< of the ratios, not of the dB
  double most_db = 0.0;
  std::size_t beams = 0;       ///< those whose excess is known; with none the figures above mean nothing
  std::size_t impossible = 0;  ///< of them, beyond what any transmit beam makes, by more than rounding
};
[[nodiscard]] PsiExcess excess_over(std::span<const double> excess_db);
/// Of one fan of a grid.
[[nodiscard]] PsiExcess excess_of_fan(std::span<const double> excess_db, const BeamGrid& grid, int fan);

/// "psi is 0.4 to 6.7 dB (mean 2.9) more than the widths give; in 114 of 500 beams no transmit beam explains it". Empty
/// where nothing is known.
[[nodiscard]] std::string text_of(const PsiExcess& excess);

}  // namespace sonar
