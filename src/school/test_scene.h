// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "school/detect.h"
#include "school/test_water.h"

namespace sonar::test {

/// One ping of analytic schools, and what detection makes of it.
struct Scene {
  explicit Scene(double mounting_deg = 270.0)
      : sector(grid(mounting_deg).sector(range_axis())),
        expected(Shape3{20, 25, 900}),
        flags(cropped_flags(expected.shape(), sector)),
        flat(expected.shape()) {}

  void add(double range_m, double elevation_deg, double azimuth_deg, double sv_db, Point<Sonar> half = {14, 9, 5}) {
    Ellipsoid e;
    e.centre = Sector::direction(rad_from_deg(elevation_deg), rad_from_deg(azimuth_deg)) * range_m;
    e.half_x = half.x;
    e.half_y = half.y;
    e.half_z = half.z;
    e.sv = linear_from_db(sv_db);
    Array3<double> alone(expected.shape());
    add_ellipsoid(alone, sector, e);
    truths.push_back(truth_of(alone));
    for (std::size_t i = 0; i < alone.shape().size(); ++i) expected.all()[i] += alone.all()[i];
  }

  std::vector<Detection> look(std::uint64_t seed, const DetectParams& params = {}) {
    counts = counts_of(expected, seed);
    disturb();
    const Array3<std::int16_t> sv = filtered(counts, flags);
    const Background background{flat.power_db, flat.calibration.view()};
    return detect(sv.view(), std::as_const(counts).view(), flags.view(), sector, background, params);
  }

  /// The median of so many samples of a beam about one, where none is faulty.
  [[nodiscard]] std::int16_t along_beam(int row, int sample, int samples) const {
    const auto all = counts.view().row(row);
    const int half = samples / 2;
    const int first = std::max(0, sample - half);
    const int end = std::min(static_cast<int>(all.size()), sample + half + 1);
    std::vector<std::int16_t> window(all.begin() + first, all.begin() + end);
    std::sort(window.begin(), window.end());
    return window[window.size() / 2];
  }

  /// Overwritten samples carry their flag.
  void disturb() {
    for (int row = 0; row < 500; ++row) {
      for (int s = 0; s < 900; ++s) {
        if (any(flags.view().row(row)[static_cast<std::size_t>(s)] & kFault)) {
          counts.view().row(row)[static_cast<std::size_t>(s)] = static_cast<std::int16_t>(counts_from_db(-10.0));
        }
      }
    }
  }

  Sector sector;
  Array3<double> expected;
  Array3<SampleFlags> flags;
  Array3<std::int16_t> counts;
  FlatBackground flat;
  std::vector<PingMask> truths;
};

}  // namespace sonar::test
