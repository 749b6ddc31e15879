// SPDX-License-Identifier: Apache-2.0
#include "synth/sonar.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/units.h"
#include "geo/geodesic.h"

namespace sonar::synth {
namespace {

/// Sv by the sonar equation, written out once more: 20 log r + 2 alpha r, range zero at c tau / 4.
double sv_db(const Beam& b, int sample, double power_db) {
  const double c = kSoundSpeed_mps;
  const double dr = c * kSampleInterval_s / 2.0;
  const double r = std::max(dr, sample * dr - c * kPulseLength_s / 4.0);
  const double lambda = c / b.frequency_hz;
  return power_db + 20.0 * std::log10(r) + 2.0 * b.absorption_db_per_m * r -
         10.0 * std::log10(b.power_w * lambda * lambda * c * kPulseLength_s /
                           (32.0 * std::numbers::pi * std::numbers::pi)) -
         2.0 * b.gain_db - b.psi_db - 2.0 * b.sa_correction_db;
}

Body ellipsoid(const Scene& scene, double range_m, double elevation_deg, double azimuth_deg) {
  Body body;
  body.shape.length_m = 40;
  body.shape.width_m = 24;
  body.shape.height_m = 16;
  body.shape.axis_deg = 30;
  body.shape.sv_db = -40;
  body.centre_m = place_seen(scene, range_m, elevation_deg, azimuth_deg);
  return body;
}

double voxel_sum_m2(const SyntheticSonar& sonar, const Array3<float>& sv) {
  const Sector sector = sonar.grid()->grid.sector(sonar.grid()->range);
  const Shape3 shape = sv.shape();
  double sum = 0.0;
  for (int f = 0; f < shape.fans; ++f) {
    for (int b = 0; b < shape.beams; ++b) {
      for (int s = 0; s < shape.samples; ++s) {
        sum += static_cast<double>(sv(f, b, s)) * sector.volume_m3(f, b, s);
      }
    }
  }
  return sum;
}

TEST(Sonar, TheSumOfSvTimesVolumeIsTheBodysOwn) {
  for (const double range_m : {100.0, 200.0, 300.0, 400.0}) {
    for (const double elevation_deg : {-22.0, -15.0}) {
      Scene scene = empty_scene();
      scene.bodies = {ellipsoid(scene, range_m, elevation_deg, 268.0)};
      const SyntheticSonar sonar(scene);
      const double truth = scatterers(scene.bodies[0].shape).backscatter_m2;
      const double seen = voxel_sum_m2(sonar, sonar.expected_school_sv(0));
      EXPECT_NEAR(db_from_linear(seen), db_from_linear(truth), 0.3) << range_m << " m";
    }
  }
}

TEST(Sonar, HomogeneousWaterKeepsItsSv) {
  // A body so large that beams inside it see nothing else.
  Scene scene = empty_scene();
  Body body;
  body.shape.length_m = 130;
  body.shape.width_m = 130;
  body.shape.height_m = 130;
  body.shape.sv_db = -50;
  body.centre_m = place_seen(scene, 120, -22, 270);
  scene.bodies = {body};
  const SyntheticSonar sonar(scene);
  const Array3<float> sv = sonar.expected_school_sv(0);
  double sum = 0.0;
  int n = 0;
  for (int f = 7; f <= 12; ++f) {
    for (int b = 9; b <= 15; ++b) {
      for (int s = 290; s < 340; ++s, ++n) sum += static_cast<double>(sv(f, b, s));
    }
  }
  EXPECT_NEAR(db_from_linear(sum / n), -50.0, 0.1);
}

TEST(Sonar, PowerIsTheSonarEquationTheOtherWay) {
  Scene scene = empty_scene();
  for (const int channel : {0, 12, 262, 499}) scene.voxel_targets.push_back({0, channel, 700, -31.0});
  const SyntheticSonar sonar(scene);
  const Volume power = sonar.ping(0).power;
  for (const int channel : {0, 12, 262, 499}) {
    const std::int16_t count = power.counts(channel / 25, channel % 25, 700);
    EXPECT_NEAR(sv_db(scene.beams[static_cast<std::size_t>(channel)], 700, db_from_counts(count)), -31.0, 0.01);
    EXPECT_LT(power.counts(channel / 25, channel % 25, 701), count - 1000);
  }
  EXPECT_EQ(power.counts(19, 0, 1320), kNoData);
  EXPECT_EQ(power.flags(19, 0, 1320), SampleFlags::dropout);
}

TEST(Sonar, ABodyIsSeenWhereItWasPlaced) {
  Scene scene = empty_scene();
  scene.ship.course_deg = 123;
  scene.bodies = {ellipsoid(scene, 150, -45.0 + 8 * 45.0 / 19.0, 270.0 + 2.5 * 4)};  // fan 8, beam 16
  const SyntheticSonar sonar(scene);
  const SyntheticPing ping = sonar.ping(0);
  ASSERT_EQ(ping.schools.size(), 1U);
  const SchoolPingRow& row = ping.schools[0].row;
  EXPECT_NEAR(row.range_m, 150, 1.0);
  EXPECT_NEAR(row.bearing_deg, 123 + 280 - 360, 0.5);
  EXPECT_NEAR(row.depth_m, 7 + 150 * std::sin(rad_from_deg(45.0 - 8 * 45.0 / 19.0)), 1.0);
  ASSERT_EQ(ping.bodies.size(), 1U);
  const GeodesicStep off = geodesic({row.latitude, row.longitude}, {ping.bodies[0].latitude, ping.bodies[0].longitude});
  EXPECT_LT(off.distance_m, 1.5);
  EXPECT_DOUBLE_EQ(ping.bodies[0].fraction_inside, 1.0);
  EXPECT_NEAR(ping.bodies[0].volume_m3, std::numbers::pi / 6 * 40 * 24 * 16, 100);
  EXPECT_NEAR(ping.bodies[0].sv_mean_db, -40, 1e-6);
  EXPECT_EQ(row.touches_edge, 0);
}

TEST(Sonar, TheTruthIsEveryVoxelWithinTenDecibelsOfTheStrongest) {
  Scene scene = empty_scene();
  scene.bodies = {ellipsoid(scene, 200, -20, 270)};
  const SyntheticSonar sonar(scene);
  const Array3<float> sv = sonar.expected_school_sv(0);
  float strongest = 0.0F;
  for (const float v : sv.all()) strongest = std::max(strongest, v);
  std::size_t members = 0;
  for (const float v : sv.all()) members += v >= 0.1F * strongest ? 1 : 0;
  const SyntheticPing ping = sonar.ping(0);
  ASSERT_EQ(ping.schools.size(), 1U);
  EXPECT_NEAR(static_cast<double>(ping.schools[0].mask.voxels()), static_cast<double>(members), 2.0);
  const Shape3 shape = sv.shape();
  for (const sonar::Run& run : ping.schools[0].mask.runs) {
    EXPECT_GE(run.row, 0);
    EXPECT_LT(run.row, static_cast<int>(shape.rows()));
    EXPECT_GE(run.first_sample, 0);
    EXPECT_LE(run.end(), shape.samples);
  }
}

TEST(Sonar, ASchoolCutByASideSaysSo) {
  for (const auto& [azimuth_deg, flag] : {std::pair{240.0, kEdgeAft}, std::pair{300.0, kEdgeFore}}) {
    Scene scene = empty_scene();
    scene.bodies = {ellipsoid(scene, 200, -20, azimuth_deg)};
    const SyntheticPing ping = SyntheticSonar(scene).ping(0);
    ASSERT_EQ(ping.schools.size(), 1U);
    EXPECT_EQ(ping.schools[0].row.edge_flags, flag);
    EXPECT_EQ(ping.schools[0].row.touches_edge, 1);
    EXPECT_LT(ping.bodies[0].fraction_inside, 0.75);
  }
}

TEST(Sonar, TheBackgroundHidesWhatIsWeakerThanIt) {
  Scene scene = empty_scene();
  scene.bodies = {ellipsoid(scene, 200, -20, 270)};
  const std::size_t clear = SyntheticSonar(scene).ping(0).schools.at(0).mask.voxels();
  scene.water.reverberation_sv_db = -46.0;
  EXPECT_LT(SyntheticSonar(scene).ping(0).schools.at(0).mask.voxels(), clear);
  scene.water.reverberation_sv_db = -30.0;
  EXPECT_TRUE(SyntheticSonar(scene).ping(0).schools.empty());
}

TEST(Sonar, TheSeabedIsWhereThePlaneIs) {
  Scene scene = empty_scene();
  scene.water.seabed_db = -10.0;
  scene.water.seabed_depth_m = 207.0;
  const SyntheticSonar sonar(scene);
  const Array3<float> sv = sonar.expected_background_sv(0);
  // The deepest fan looks 45 degrees down: 200 m below the transducer is 282.8 m away, sample (r + 0.755) / 0.3776.
  int strongest = 0;
  for (int s = 0; s < 1324; ++s) strongest = sv(0, 12, s) > sv(0, 12, strongest) ? s : strongest;
  EXPECT_NEAR(strongest, (282.8 + 0.755) / 0.3776, 15.0);
  EXPECT_GT(db_from_linear(static_cast<double>(sv(0, 12, strongest))), -35.0);
  EXPECT_LT(db_from_linear(static_cast<double>(sv(15, 12, 700))), -150.0);
}

TEST(Sonar, BeamsThatMakeNoGridAreRenderedWithoutMasks) {
  Scene scene = empty_scene();
  scene.beams.resize(60);
  scene.bodies = {ellipsoid(scene, 150, -43, 270)};
  const SyntheticSonar sonar(scene);
  EXPECT_FALSE(sonar.grid().has_value());
  const SyntheticPing ping = sonar.ping(0);
  EXPECT_TRUE(ping.schools.empty());
  EXPECT_EQ(ping.power.counts.shape().beams, 60);
  EXPECT_GT(db_from_counts(ping.power.counts(0, 37, 400)), -170.0);
}

}  // namespace
}  // namespace sonar::synth
