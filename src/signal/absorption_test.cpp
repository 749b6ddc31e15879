// SPDX-License-Identifier: Apache-2.0
#include "signal/absorption.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace sonar {
namespace {

struct Check {
  double f_khz;
  double francois_garrison;
  double ainslie_mccolm;
};

// Worked independently from the published formulas for T = 8 deg C, S = 35, D = 50 m, pH = 8; dB/km.
constexpr std::array<Check, 6> kChecks = {{{38, 10.396, 10.592},
                                           {75, 24.539, 24.956},
                                           {90, 28.953, 29.448},
                                           {94, 30.011, 30.528},
                                           {112, 34.280, 34.899},
                                           {120, 35.974, 36.642}}};

TEST(absorption, francois_garrison_check_values) {
  for (const Check& check : kChecks) {
    EXPECT_NEAR(absorption_francois_garrison(check.f_khz * 1e3, {}) * 1e3, check.francois_garrison, 6e-4);
  }
}

TEST(absorption, ainslie_mccolm_check_values) {
  for (const Check& check : kChecks) {
    EXPECT_NEAR(absorption_ainslie_mccolm(check.f_khz * 1e3, {}) * 1e3, check.ainslie_mccolm, 6e-4);
  }
}

// Some implementations write exp(-D) for the paper's exp(-D / 17) in the water term; the two meet at the surface, and
// both published formulas must stay close to each other at depth.
TEST(absorption, the_two_formulas_agree_within_a_tenth) {
  for (const double depth_m : {0.0, 200.0, 1000.0}) {
    for (const double f : {20e3, 75e3, 112e3, 200e3}) {
      const WaterProperties water{.temperature_c = 6, .salinity_psu = 35, .depth_m = depth_m, .ph = 8};
      const double ratio = absorption_ainslie_mccolm(f, water) / absorption_francois_garrison(f, water);
      EXPECT_NEAR(ratio, 1.0, 0.1) << f << " Hz, " << depth_m << " m";
    }
  }
}

TEST(absorption, mackenzie_check_values) {
  EXPECT_NEAR(sound_speed_mackenzie({.temperature_c = 25, .salinity_psu = 35, .depth_m = 1000, .ph = 8}), 1550.744,
              6e-4);
  EXPECT_NEAR(sound_speed_mackenzie({.temperature_c = 8, .salinity_psu = 35, .depth_m = 50, .ph = 8}), 1483.230, 6e-4);
  EXPECT_NEAR(sound_speed_mackenzie({.temperature_c = 6, .salinity_psu = 35, .depth_m = 20, .ph = 8}), 1474.974, 6e-4);
}

}  // namespace
}  // namespace sonar
