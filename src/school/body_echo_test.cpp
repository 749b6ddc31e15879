// SPDX-License-Identifier: Apache-2.0
#include "school/body_echo.h"

#include <gtest/gtest.h>

#include "school/correct_sizes.h"
#include "school/measure.h"
#include "school/test_water.h"

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
SchoolPingRow measured_beside(const Array3<double>& faint, const Array3<double>& loud, const PingMask& others) {
  const BeamGrid grid = test::grid();
  const Sector sector = grid.sector(test::range_axis());
  const Array3<SampleFlags> flags = test::cropped_flags(kShape, sector);
  Array3<double> expected = faint;
  for (std::size_t i = 0; i < kShape.size(); ++i) expected.all()[i] += loud.all()[i];
  const Array3<std::int16_t> counts = test::counts_of(expected, 1, false);
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
TEST(BodyEcho, ALoudNeighboursFlankIsNotTheSchools) {
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

}  // namespace
}  // namespace sonar
