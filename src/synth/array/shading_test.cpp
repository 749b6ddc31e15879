// SPDX-License-Identifier: Apache-2.0
#include "synth/array/shading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "synth/array/pulse.h"

namespace sonar::synth::array {
namespace {

/// Level of a line array, dB below its axis, at a phase step between elements.
double level_db(const std::vector<double>& weights, double step_rad) {
  std::complex<double> sum;
  double axis = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum += weights[i] * std::polar(1.0, step_rad * static_cast<double>(i));
    axis += weights[i];
  }
  return 20.0 * std::log10(std::abs(sum) / axis);
}

/// Heights of the side lobes: local maxima off the axis.
std::vector<double> side_lobes_db(const std::vector<double>& weights) {
  std::vector<double> lobes;
  constexpr double kStep = 1e-3;
  for (double x = kStep; x < std::numbers::pi - 2.0 * kStep; x += kStep) {
    const double here = level_db(weights, x);
    if (here > level_db(weights, x - kStep) && here >= level_db(weights, x + kStep)) lobes.push_back(here);
  }
  return lobes;
}

TEST(Shading, DolphsSideLobesAreAllAsHighAsAskedFor) {  // Dolph 1946
  for (const int n : {20, 21}) {
    const auto lobes = side_lobes_db(shading_weights(Shading::dolph, n, -28.0));
    ASSERT_GT(lobes.size(), 6U);
    for (const double lobe : lobes) EXPECT_NEAR(lobe, -28.0, 0.05) << n;
  }
}

TEST(Shading, TaylorsFirstSideLobesAreAsAskedForAndTheOthersFall) {  // Taylor 1955
  const auto lobes = side_lobes_db(shading_weights(Shading::taylor, 34, -25.0));
  EXPECT_NEAR(lobes[0], -25.0, 0.8);
  EXPECT_LT(lobes.back(), lobes[0] - 5.0);
}

TEST(Shading, AUniformLineHasItsKnownSideLobe) {  // (sin x / x)^2: -13.26 dB
  EXPECT_NEAR(side_lobes_db(shading_weights(Shading::uniform, 60, -25.0))[0], -13.26, 0.05);
}

TEST(Pulse, ARectanglesMatchedEchoIsATriangle) {  // its square's integral is 2/3 of the pulse, by hand
  const Pulse pulse(2.0e-3, 0.5e-3, 0.0);
  EXPECT_NEAR(pulse.effective_s(), 2.0e-3 * 2.0 / 3.0, 1e-6);
  EXPECT_NEAR(pulse.amplitude(0.0), 1.0, 1e-12);
  EXPECT_NEAR(pulse.amplitude(-0.5e-3), 0.75, 1e-3);
  EXPECT_EQ(pulse.amplitude(2.1e-3), 0.0);
}

TEST(Pulse, TapsSampleTheEchoAroundItsPeak) {
  const Pulse pulse(2.0e-3, 0.5e-3, 0.5);
  const double peak = 100.3;
  const auto& taps = pulse.taps(peak);
  for (int t = 0; t < Pulse::kTaps; ++t) {
    const double offset = (Pulse::first_tap(peak) + t - peak) * 0.5e-3;
    // A tap's phase is told to 1/64 of a sample; the steepest slope is about 1 / 0.5 ms.
    EXPECT_NEAR(static_cast<double>(taps[static_cast<std::size_t>(t)]), pulse.amplitude(offset), 0.01) << t;
  }
}

}  // namespace
}  // namespace sonar::synth::array
