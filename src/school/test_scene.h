// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "school/detect/detect.h"
#include "school/evidence/block_means.h"
#include "school/evidence/null_model.h"
#include "school/seabed/seabed.h"
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
    Array3<double> one(expected.shape());
    add_ellipsoid(one, sector, e);
    truths.push_back(truth_of(one));
    for (std::size_t i = 0; i < one.shape().size(); ++i) expected.all()[i] += one.all()[i];
  }

  /// Clear sightings of a ping whose neighbours hold the same, or nothing but noise.
  std::vector<Detection> look(std::uint64_t seed, const DetectParams& params = {}, const PingMask* taken = nullptr) {
    counts = counts_of(in_water(0, expected), seed);
    disturb(counts);
    Array3<std::int16_t> sv(counts.shape());
    median_into(std::as_const(counts).view(), std::as_const(flags).view(), box, sv.view());
    const Background background{flat.power_db, flat.calibration.view()};
    const Seabed seabed = find_seabed(std::as_const(sv).view(), std::as_const(flags).view(), background, sector,
                                      test::grid().vertical_width_deg, {});
    flag_seabed_itself(seabed, flags.view());
    std::vector<Array3<std::int16_t>> means;
    for (std::uint64_t k = 0; k < 5; ++k) {
      Array3<std::int16_t> other = counts;
      if (k > 0) {
        other = counts_of(in_water(k, alone ? Array3<double>(expected.shape()) : expected), 1000 * k + seed);
      }
      disturb(other);
      means.push_back(
          block_means(std::as_const(other).view(), std::as_const(flags).view(), block_samples(sector.range())));
    }
    std::vector<WaterPing> window;
    for (const Array3<std::int16_t>& mean : means) window.push_back({&mean, &seabed, background});
    const WaterLevels water = water_levels(window, sector, kLeastEvidence).front();
    const PingEcho echo{std::as_const(sv).view(),
                        std::as_const(counts).view(),
                        std::as_const(flags).view(),
                        sector,
                        background,
                        seabed,
                        water,
                        peaked};
    std::vector<Detection> found = detect(echo, params, taken, refused);
    std::erase_if(found, [&](const Detection& d) { return d.evidence < clear_evidence(params); });
    return found;
  }

  /// A ping of the window: its echoes with the water's own.
  [[nodiscard]] Array3<double> in_water(std::uint64_t ping, Array3<double> echoes) const {
    if (!reverberation) return echoes;
    for (int row = 0; row < 500; ++row) {
      for (int s = 0; s < 900; ++s) echoes.view().row(row)[static_cast<std::size_t>(s)] += reverberation(ping, row, s);
    }
    return echoes;
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
  void disturb(Array3<std::int16_t>& all) const {
    for (int row = 0; row < 500; ++row) {
      for (int s = 0; s < 900; ++s) {
        if (any(flags.view().row(row)[static_cast<std::size_t>(s)] & kFault)) {
          all.view().row(row)[static_cast<std::size_t>(s)] = static_cast<std::int16_t>(counts_from_db(-10.0));
        }
      }
    }
  }

  Sector sector;
  Array3<double> expected;
  Array3<SampleFlags> flags;
  Array3<std::int16_t> counts;
  FlatBackground flat;
  MedianParams box;
  bool peaked = true;
  std::vector<RefusedDetection>* refused = nullptr;
  std::function<double(std::uint64_t ping, int row, int sample)> reverberation;  ///< its s_v, another one in each ping
  bool alone = false;  ///< the pings before and behind show none of it
  std::vector<PingMask> truths;
};

}  // namespace sonar::test
