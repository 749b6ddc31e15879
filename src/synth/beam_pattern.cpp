// SPDX-License-Identifier: Apache-2.0
#include "synth/beam_pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sonar::synth {
namespace {

/// (sin x / x)^2 = 1/2 here.
constexpr double kHalfPower = 1.3915573782515105;

/// x at one standard deviation of the Gaussian of the same width, w / (4 sqrt(ln 2)); the half power lies at w / 2.
double line_scale() { return kHalfPower / (2.0 * std::sqrt(std::numbers::ln2)); }

/// Length of the sending line over that of the receiving one.
double sending_share(BeamPattern pattern, PatternPart part) {
  if (pattern == BeamPattern::wide_transmit) return 1.0 / 3.0;
  return pattern == BeamPattern::wide_fan && part == PatternPart::horizontal ? 0.1 : 1.0;
}

/// (sin x / x)^2.
double line_one_way(double x) {
  if (x == 0.0) return 1.0;
  const double s = std::sin(x) / x;
  return s * s;
}

}  // namespace

double pattern_value(BeamPattern pattern, PatternPart part, double off_axis) {
  if (pattern == BeamPattern::gaussian) return std::exp(-off_axis * off_axis / 2.0);
  const double x = off_axis * line_scale();
  return line_one_way(x) * line_one_way(x * sending_share(pattern, part));
}

double pattern_integral(BeamPattern pattern, PatternPart part) {
  if (pattern == BeamPattern::gaussian) return std::sqrt(2.0 * std::numbers::pi);
  // Two triangles convolved (Parseval): pi (1 - q / 3), 2 pi / 3 for q = 1.
  return std::numbers::pi * (1.0 - sending_share(pattern, part) / 3.0) / line_scale();
}

double pattern_reach(BeamPattern pattern, PatternPart part) {
  constexpr double kCutExponent = 10.0;
  if (pattern == BeamPattern::gaussian) return std::sqrt(2.0 * kCutExponent);
  return std::max(2.0, 1.0 / sending_share(pattern, part)) * std::numbers::pi / line_scale();
}

}  // namespace sonar::synth
