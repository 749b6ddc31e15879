// SPDX-License-Identifier: Apache-2.0
#include "signal/elastic_sphere.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/units.h"

namespace sonar {
namespace {

constexpr WaterAround kWater{1500.0, 1026.0};

CalibrationSphere sphere(const char* name) {
  auto made = named_sphere(name);
  EXPECT_TRUE(made) << name;
  return *made;
}

/// The package acousticTS (tests/testthat/test-calibration_sphere.R) states these for its defaults, a sphere of WC of
/// 38.1 mm in water of 1500 m/s.
TEST(ElasticSphere, TungstenCarbideHasItsPublishedTargetStrengths) {
  const CalibrationSphere wc = sphere("wc38.1");
  EXPECT_NEAR(sphere_ts_db(wc, kWater, 38e3), -42.42, 0.005);
  EXPECT_NEAR(sphere_ts_db(wc, kWater, 70e3), -41.44, 0.005);
  EXPECT_NEAR(sphere_ts_db(wc, kWater, 120e3), -39.52, 0.006);
  EXPECT_NEAR(sphere_ts_db(wc, kWater, 200e3), -39.05, 0.006);
}

/// Simrad's data sheet of the 60 mm copper sphere: -33.6 dB at 38 kHz; Foote 1983: within 0.1 dB over 1460..1500 m/s.
TEST(ElasticSphere, CopperOf60MillimetresIsMinus33Point6At38Kilohertz) {
  for (const double speed : {1460.0, 1475.0, 1490.0}) {
    EXPECT_NEAR(sphere_ts_db(sphere("Cu60"), {speed, 1026.0}, 38e3), -33.6, 0.1) << speed;
  }
}

/// Rayleigh's limit, by hand: a small sphere that neither yields nor moves much scatters (ka)^2 a (1/3 (1 - e) + 1/2 ...);
/// a rigid, fixed one has |f| = a (ka)^2 5/6 backwards; a heavy, stiff one in water comes near.
TEST(ElasticSphere, LongWavesSeeARigidSphere) {
  CalibrationSphere rigid = sphere("wc20");
  rigid.material.density_kg_per_m3 = 1e9;
  rigid.material.longitudinal_mps = 1e6;
  rigid.material.transverse_mps = 5e5;
  constexpr double kFrequency_hz = 500.0;
  const double a = rigid.diameter_m / 2.0;
  const double ka = 2.0 * std::numbers::pi * kFrequency_hz / kWater.sound_speed_mps * a;
  EXPECT_NEAR(sphere_ts_db(rigid, kWater, kFrequency_hz), 20.0 * std::log10(a * ka * ka * 5.0 / 6.0), 0.01);
}

TEST(ElasticSphere, ScalesWithItsSize) {
  // ka is what counts: a sphere twice as large at half the frequency is 6.02 dB stronger.
  EXPECT_NEAR(sphere_ts_db(sphere("wc76.2"), kWater, 35e3) - sphere_ts_db(sphere("wc38.1"), kWater, 70e3),
              20.0 * std::log10(2.0), 1e-9);
}

TEST(ElasticSphere, ALongPulseHasTheTargetStrengthOfOneFrequency) {
  const CalibrationSphere wc = sphere("wc38.1");
  EXPECT_NEAR(sphere_ts_db(wc, kWater, 120e3, 1.0), sphere_ts_db(wc, kWater, 120e3), 1e-3);
  // In a null the mean over the band is above the value in the middle.
  double least = 0.0;
  double at = 0.0;
  for (double f = 85e3; f < 95e3; f += 20.0) {
    const double ts = sphere_ts_db(wc, kWater, f);
    if (ts < least) {
      least = ts;
      at = f;
    }
  }
  EXPECT_GT(sphere_ts_db(wc, kWater, at, 0.5e-3), least + 1.0);
}

TEST(ElasticSphere, NamesAreAMaterialAndMillimetres) {
  EXPECT_NEAR(sphere("WC38.1").diameter_m, 0.0381, 1e-15);
  EXPECT_EQ(sphere("cu60").material.name, "cu");
  for (const char* wrong : {"", "wc", "38.1", "wc38.1mm", "fe20", "wc-3", "wc1000", "wcnan"}) {
    const auto made = named_sphere(wrong);
    ASSERT_FALSE(made) << wrong;
    EXPECT_NE(made.error().text.find("wc38.1"), std::string::npos);
  }
}

/// Check values of UNESCO technical papers in marine science 44; pressures as depths.
TEST(ElasticSphere, SeaWaterHasTheDensityOfTheEquationOfState) {
  constexpr double kMetresPerBar = 1.0 / 0.100655;
  EXPECT_NEAR(sea_water_density({5.0, 0.0, 0.0, 8.0}), 999.96675, 1e-4);
  EXPECT_NEAR(sea_water_density({5.0, 35.0, 0.0, 8.0}), 1027.67547, 1e-4);
  EXPECT_NEAR(sea_water_density({25.0, 35.0, 1000.0 * kMetresPerBar, 8.0}), 1062.53817, 1e-3);
}

}  // namespace
}  // namespace sonar
