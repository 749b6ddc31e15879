// SPDX-License-Identifier: Apache-2.0
#include "school/measure/body_echo.h"

#include <gtest/gtest.h>

#include <cmath>

#include "school/measure/correct_sizes.h"
#include "school/measure/measure.h"
#include "school/test_ping.h"

namespace sonar {
namespace {

constexpr Shape3 kShape{20, 25, 900};

test::Ellipsoid faint_body() {
  test::Ellipsoid e;
  e.centre = Sector::direction(rad_from_deg(-29.0), rad_from_deg(268.0)) * 170.0;
  e.half_x = 16.0;
  e.half_y = 12.0;
  e.half_z = 7.0;
  e.sv = 2e-5;
  return e;
}

/// Seven decibels louder, 26 m of water above the other.
test::Ellipsoid loud_body() {
  test::Ellipsoid e = faint_body();
  e.centre = Sector::direction(rad_from_deg(-15.0), rad_from_deg(268.0)) * 170.0;
  e.sv = 1e-4;
  return e;
}

/// Sizes of the faint body.
/// others  what belongs to its neighbour
SchoolPingRow measured_beside(const Array3<double>& faint, const Array3<double>& loud, const PingMask& others,
                              bool speckle = false) {
  const BeamGrid grid = test::grid();
  const Sector sector = grid.sector(test::range_axis());
  const Array3<SampleFlags> flags = test::cropped_flags(kShape, sector);
  Array3<double> expected = faint;
  for (std::size_t i = 0; i < kShape.size(); ++i) expected.all()[i] += loud.all()[i];
  const Array3<std::int16_t> counts = test::counts_of(expected, 1, speckle);
  const Array3<std::int16_t> filtered = test::filtered(counts, flags);
  const test::FlatBackground flat(kShape);
  MeasureInput in;
  in.sv = counts.view();
  in.filtered = filtered.view();
  in.flags = flags.view();
  in.sector = &sector;
  in.grid = &grid;
  in.background = {flat.power_db, flat.calibration.view()};
  in.placement = {.transducer = {60.0, 4.0}, .transducer_depth_m = 7.0};
  in.others = &others;
  MeasureParams params;
  params.find_beam_shape = false;
  params.beam_gaussian_share = 1.0;
  const MeasuredSchool school = measure(in, test::truth_of(faint), params);
  return correct_sizes({{&school}}, params).front();
}

// The beams spread a loud school's echo over water where a faint one's own is weaker: it tells nothing of that one's height.
TEST(BodyEcho, ALoudNeighboursEdgeIsNotTheSchools) {
  const Sector sector = test::grid().sector(test::range_axis());
  Array3<double> faint(kShape);
  test::add_ellipsoid(faint, sector, faint_body());
  Array3<double> loud(kShape);
  test::add_ellipsoid(loud, sector, loud_body());
  const SchoolPingRow alone = measured_beside(faint, Array3<double>(kShape), {});
  const SchoolPingRow beside = measured_beside(faint, loud, subtract(test::truth_of(loud), test::truth_of(faint)));
  ASSERT_NEAR(alone.height_corrected_m / 14.0, 1.0, 0.15);
  EXPECT_NEAR(beside.height_corrected_m / alone.height_corrected_m, 1.0, 0.2);
  EXPECT_NEAR(beside.volume_corrected_m3 / alone.volume_corrected_m3, 1.0, 0.2);
}

// As beams hear a seabed below: what is fitted with it is higher than the mask, which the beam has widened.
TEST(BodyEcho, AHeightAboveTheApparentOneIsAnothersAndNotTold) {
  const Sector sector = test::grid().sector(test::range_axis());
  Array3<double> faint(kShape);
  test::add_ellipsoid(faint, sector, faint_body());
  test::Ellipsoid below = faint_body();
  below.centre = Sector::direction(rad_from_deg(-41.0), rad_from_deg(268.0)) * 170.0;
  below.half_x = below.half_y = 40.0;
  below.sv = 1e-3;
  Array3<double> loud(kShape);
  test::add_ellipsoid(loud, sector, below);
  const SchoolPingRow row = measured_beside(faint, loud, {});
  EXPECT_TRUE(std::isnan(row.height_corrected_m)) << row.height_corrected_m << " of " << row.height_m;
  EXPECT_TRUE(std::isnan(row.sv_corrected_db));
}

// The background near a school is looked for where a louder one's echo may be.
TEST(BodyEcho, ALouderSchoolBehindIsNoBackground) {
  test::Ellipsoid faint = faint_body();
  faint.sv = 3e-8;  // 15 dB above the background
  test::Ellipsoid loud = faint;
  loud.centre = Sector::direction(rad_from_deg(-29.0), rad_from_deg(268.0)) * 205.0;
  loud.half_y = 18.0;
  loud.sv = 1.5e-7;
  const BeamGrid grid = test::grid();
  const Sector sector = grid.sector(test::range_axis());
  Array3<double> one(kShape);
  Array3<double> other(kShape);
  const Array3<double> none(kShape);
  test::add_ellipsoid(one, sector, faint);
  test::add_ellipsoid(other, sector, loud);
  const SchoolPingRow alone = measured_beside(one, none, PingMask{}, true);
  const SchoolPingRow beside = measured_beside(one, other, test::truth_of(other), true);
  EXPECT_NEAR(beside.volume_corrected_m3 / alone.volume_corrected_m3, 1.0, 0.1);
  EXPECT_LT(measured_beside(one, other, PingMask{}, true).volume_corrected_m3, 0.85 * alone.volume_corrected_m3);
}

// The filter's values there are the neighbouring fans', and would make the body higher than it is.
TEST(BodyEcho, AMissingFanTellsNoHeight) {
  test::MeasuredPing whole;
  test::Ellipsoid e = faint_body();
  e.centre = Sector::direction(rad_from_deg(-20.0), rad_from_deg(265.0)) * 200.0;
  e.half_z = 9.0;
  whole.add(e);
  const SchoolPingRow expected = whole.measured(2);
  for (const int fan : {10, 11, 12}) {
    test::MeasuredPing ping = whole;
    for (int beam = 0; beam < 25; ++beam) {
      for (int s = 0; s < 900; ++s) {
        ping.flags(fan, beam, s) |= SampleFlags::dropout;
        ping.expected(fan, beam, s) = 0.0;
      }
    }
    const SchoolPingRow got = ping.measured(2);
    EXPECT_NEAR(got.height_corrected_m / expected.height_corrected_m, 1.0, 0.2) << fan;
    EXPECT_NEAR(got.volume_corrected_m3 / expected.volume_corrected_m3, 1.0, 0.25) << fan;
  }
}

}  // namespace
}  // namespace sonar
