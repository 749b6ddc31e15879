// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace sonar {

// Beams of a flat array in one frame: direction cosines on the array's face, `across` along the ship and `up`. In them a
// beam keeps its shape wherever it is steered.

struct FaceDirection {
  double across = 0.0;
  double up = 0.0;
};

/// The main lobe of a two-way beam, dB under its top:
///   B = -6.02 (X + Y) - k0 (X^2 - X) - k1 (Y^2 - Y) - k2 X Y,   X = (2 (across - centre) / width_across)^2, Y likewise,
/// so that a width is the full one at -6.02 dB two-way: the -3 dB width of the one-way beam whose square this is.
/// k, the departure from a Gaussian beam, is one for all beams, which the same elements make.
inline constexpr double kHalfBothWays_db = 6.020599913279624;  ///< where the one-way beam is at half its power
struct PatternShape {
  std::array<double, 3> k{};
  [[nodiscard]] double db(double x, double y) const;
};

/// A beam's figures.
struct FittedBeam {
  double level_db = 0.0;  ///< of a target of 0 dB on the beam's top
  double width_across = 0.0;
  double width_up = 0.0;
  FaceDirection centre;
};

/// Equivalent two-way beam angle of a fitted beam, sr: the integral of 10^(B / 10) over the solid angle, d across d up /
/// abeam on the face, as far as the main lobe goes: to -25 dB. Side lobes are not in it.
[[nodiscard]] double psi_sr(const FittedBeam& beam, const PatternShape& shape);

}  // namespace sonar
