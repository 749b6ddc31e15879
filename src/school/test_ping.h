// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "school/measure/correct_sizes.h"
#include "school/measure/measure.h"
#include "school/measure/two_way_beam.h"
#include "school/test_water.h"

namespace sonar::test {

/// A body of 40 m x 24 m x 12 m, its middle at a range along elevation and azimuth.
inline Ellipsoid ellipsoid(double range_m, double elevation_deg, double azimuth_deg) {
  Ellipsoid e;
  e.centre = Sector::direction(rad_from_deg(elevation_deg), rad_from_deg(azimuth_deg)) * range_m;
  e.half_x = 20.0;
  e.half_y = 12.0;
  e.half_z = 6.0;
  e.sv = 1e-4;
  return e;
}

/// A ping with schools of known bodies, measured under masks of their expected echo.
struct MeasuredPing {
  explicit MeasuredPing(double mounting_deg = 270.0)
      : grid(test::grid(mounting_deg)),
        sector(grid.sector(range_axis())),
        expected(Shape3{20, 25, 900}),
        flags(cropped_flags(expected.shape(), sector)),
        flat(expected.shape()) {
    placement.transducer = {60.0, 4.0};
    placement.transducer_depth_m = 7.0;
  }

  void add(const Ellipsoid& e) {
    add_ellipsoid(expected, sector, e);
    mask = truth_of(expected);
  }

  MeasuredSchool seen(std::uint64_t seed, bool speckle = true) {
    counts = counts_of(expected, seed, speckle);
    filtered = test::filtered(counts, flags);
    MeasureInput in;
    in.sv = counts.view();
    in.filtered = filtered.view();
    in.flags = flags.view();
    in.sector = &sector;
    in.grid = &grid;
    in.background = {flat.power_db, flat.calibration.view()};
    in.placement = placement;
    in.two_way_area = two_way_area(grid, beam_angle_db, {});
    in.psi_error_db = psi_error_db;
    in.calibration_se_db = calibration_se_db;
    in.seabed = seabed;
    in.rays = rays;
    return measure(in, mask, params);
  }

  SchoolPingRow measured(std::uint64_t seed, bool speckle = true) {
    const MeasuredSchool one = seen(seed, speckle);
    return correct_sizes({{&one}}, params).front();
  }

  MeasureParams params;
  std::vector<double> beam_angle_db;  ///< none = the file has none
  std::vector<double> psi_error_db;
  std::vector<double> calibration_se_db;
  const Seabed* seabed = nullptr;
  BeamGrid grid;
  Sector sector;
  Array3<double> expected;
  Array3<SampleFlags> flags;
  FlatBackground flat;
  Placement placement;
  std::shared_ptr<const Refraction> rays;
  PingMask mask;
  Array3<std::int16_t> counts;
  Array3<std::int16_t> filtered;
};

}  // namespace sonar::test
