// SPDX-License-Identifier: Apache-2.0
#include "synth/beam_pattern.h"

#include <cmath>
#include <numbers>

namespace sonar::synth {
namespace {

/// (sin x / x)^2 = 1/2 here.
constexpr double kHalfPower = 1.3915573782515105;

/// x at one standard deviation of the Gaussian of the same width, w / (4 sqrt(ln 2)); the half power lies at w / 2.
double line_scale() { return kHalfPower / (2.0 * std::sqrt(std::numbers::ln2)); }

}  // namespace

double pattern_value(BeamPattern pattern, double off_axis) {
  if (pattern == BeamPattern::gaussian) return std::exp(-off_axis * off_axis / 2.0);
  const double x = off_axis * line_scale();
  if (x == 0.0) return 1.0;
  const double s = std::sin(x) / x;
  return s * s * s * s;
}

double pattern_integral(BeamPattern pattern) {
  if (pattern == BeamPattern::gaussian) return std::sqrt(2.0 * std::numbers::pi);
  return 2.0 * std::numbers::pi / 3.0 / line_scale();
}

double pattern_reach(BeamPattern pattern) {
  constexpr double kCutExponent = 10.0;
  if (pattern == BeamPattern::gaussian) return std::sqrt(2.0 * kCutExponent);
  return 2.0 * std::numbers::pi / line_scale();
}

}  // namespace sonar::synth
