// SPDX-License-Identifier: Apache-2.0
#include "synth/array/sphere.h"

#include <gtest/gtest.h>

#include <cmath>

#include "signal/elastic_sphere.h"
#include "synth/beam_table.h"

namespace sonar::synth::array {
namespace {

/// Faran's phase angles here, MacLennan's form there: two derivations, two sets of Bessel functions.
TEST(Sphere, TwoFormsOfTheSeriesAgree) {
  for (const double diameter_mm : {20.0, 38.1, 60.0}) {
    for (const SphereMaterial material : {SphereMaterial::tungsten_carbide, SphereMaterial::copper}) {
      SphereParams params;
      params.diameter_mm = diameter_mm;
      params.material = material;
      const CalibrationSphere sphere{kSphereMaterials[static_cast<std::size_t>(material)], diameter_mm * 1e-3};
      for (double frequency_hz = 18e3; frequency_hz < 200e3; frequency_hz += 2.9e3) {
        EXPECT_NEAR(20.0 * std::log10(sphere_amplitude_m(params, frequency_hz)),
                    sphere_ts_db(sphere, {kSoundSpeed_mps, 1027.5}, frequency_hz), 1e-4)
            << diameter_mm << " " << frequency_hz;
      }
    }
  }
}

TEST(Sphere, ItIsSteeredOverTheWholePatchAndSwingsALittle) {
  SphereParams params;
  params.elevation_from_deg = -20.0;
  params.elevation_to_deg = -10.0;
  params.azimuth_from_deg = -15.0;
  params.azimuth_to_deg = 5.0;
  constexpr int kPings = 400;
  double far_step = 0.0;
  double least = 0.0;
  double most = -90.0;
  for (int ping = 0; ping < kPings; ++ping) {
    const SphereTruth at = sphere_at(params, ping, kPings, 7);
    least = std::min(least, at.elevation_deg);
    most = std::max(most, at.elevation_deg);
    EXPECT_GT(at.azimuth_deg, -16.0);
    EXPECT_LT(at.azimuth_deg, 6.0);
    EXPECT_NEAR(at.range_m, params.range_m, 2.5);
    if (ping == 0) continue;
    const SphereTruth before = sphere_at(params, ping - 1, kPings, 7);
    far_step = std::max(far_step, std::abs(at.azimuth_deg - before.azimuth_deg));
  }
  EXPECT_LT(least, -19.0);
  EXPECT_GT(most, -11.0);
  EXPECT_LT(far_step, 2.0);
}

}  // namespace
}  // namespace sonar::synth::array
