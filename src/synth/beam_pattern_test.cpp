// SPDX-License-Identifier: Apache-2.0
#include "synth/beam_pattern.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sonar::synth {
namespace {

class BeamPatterns : public testing::TestWithParam<BeamPattern> {};
class SquareBeams : public testing::TestWithParam<BeamPattern> {};
constexpr PatternPart kVertical = PatternPart::vertical;
constexpr PatternPart kHorizontal = PatternPart::horizontal;
const double kHalfWidth = 2.0 * std::sqrt(std::numbers::ln2);  ///< in standard deviations of the square Gaussian

// A beam's width is where its one-way power has fallen to a half, so the two-way power there is a quarter; the sigma is
// that of the Gaussian, width / (4 sqrt(ln 2)).
TEST_P(SquareBeams, is_a_quarter_at_half_its_width) {
  for (const PatternPart part : {kVertical, kHorizontal}) {
    EXPECT_DOUBLE_EQ(pattern_value(GetParam(), part, 0.0), 1.0);
    EXPECT_NEAR(pattern_value(GetParam(), part, kHalfWidth), 0.25, 1e-12);
    EXPECT_NEAR(pattern_value(GetParam(), part, -kHalfWidth), 0.25, 1e-12);
  }
}

// Received with a half, sent by a third or a tenth of the line: (sin x / x)^2 at 1.3916 / 3 = 0.46385 is 0.9303, at a
// tenth of 1.3916 it is 0.99357.
TEST(beam_pattern, wide_ones_receive_as_the_line_does) {
  for (const PatternPart part : {kVertical, kHorizontal}) {
    EXPECT_NEAR(pattern_value(BeamPattern::wide_transmit, part, kHalfWidth), 0.5 * 0.9303, 1e-4);
  }
  EXPECT_NEAR(pattern_value(BeamPattern::wide_fan, kVertical, kHalfWidth), 0.25, 1e-12);
  EXPECT_NEAR(pattern_value(BeamPattern::wide_fan, kHorizontal, kHalfWidth), 0.5 * 0.99357, 1e-5);
}

// Against a sum over a fine grid. What lies beyond the reach may be missing from it: (sin x / x)^4 there is below 1/x^4.
TEST_P(BeamPatterns, integral_and_reach_agree) {
  for (const PatternPart part : {kVertical, kHorizontal}) {
    const double reach = pattern_reach(GetParam(), part);
    constexpr int kSteps = 200'000;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) sum += pattern_value(GetParam(), part, (i + 0.5) / kSteps * reach);
    EXPECT_NEAR(2.0 * sum * reach / kSteps / pattern_integral(GetParam(), part), 1.0, 1e-3);
  }
}

// sin x / x has its first side lobe at tan x = x, 13.26 dB down one way.
TEST(beam_pattern, uniform_line_has_a_side_lobe_and_the_gaussian_none) {
  const double at = 4.493409457909064 / (1.3915573782515105 / (2.0 * std::sqrt(std::numbers::ln2)));
  EXPECT_NEAR(10.0 * std::log10(pattern_value(BeamPattern::uniform_line, kVertical, at)), -2.0 * 13.2615, 0.001);
  EXPECT_LT(10.0 * std::log10(pattern_value(BeamPattern::gaussian, kVertical, at)), -60.0);
}

INSTANTIATE_TEST_SUITE_P(both, SquareBeams, testing::Values(BeamPattern::gaussian, BeamPattern::uniform_line));
INSTANTIATE_TEST_SUITE_P(all, BeamPatterns,
                         testing::Values(BeamPattern::gaussian, BeamPattern::uniform_line, BeamPattern::wide_transmit,
                                         BeamPattern::wide_fan));

}  // namespace
}  // namespace sonar::synth
