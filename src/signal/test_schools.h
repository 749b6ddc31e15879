// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/array.h"
#include "base/units.h"
#include "signal/flags.h"
#include "signal/test_data.h"

// Pings of an MS70 with schools in them, for tests of what must not take a school for a fault.
namespace sonar {

inline constexpr Shape3 kMs70{20, 25, 1320};
inline constexpr double kSpacing_m = 0.3776;

/// Elevation -45..0 in 20 fans and azimuth -30..30 in 25 beams, as on an MS70.
inline PingGeometry ms70_geometry() {
  PingGeometry geometry{.first_range_m = -0.755,
                        .spacing_m = kSpacing_m,
                        .transducer_depth_m = 7.0,
                        .elevation_deg = {},
                        .vertical_width_deg = {},
                        .level_elevation_deg = {}};
  for (int fan = 0; fan < 20; ++fan) geometry.elevation_deg.push_back(-45.0 + fan * 45.0 / 19.0);
  geometry.vertical_width_deg.assign(500, 7.0);
  return geometry;
}

struct Ellipsoid {
  double range_m, azimuth_deg, elevation_deg;
  double across_m, along_m, half_height_m;  ///< semi-axes
};

/// The body's echo in each voxel, 0..1: a beam of 7 degrees in height (12 dB (a / width)^2, two-way), and its overlap by
/// -13 dB into the beams beside.
inline Array3<double> echo_of(const Ellipsoid& e, Shape3 shape) {
  const auto place = [](double r, double az, double el) {
    return std::array{r * std::cos(el) * std::sin(az), r * std::cos(el) * std::cos(az), r * std::sin(el)};
  };
  const auto centre = place(e.range_m, rad_from_deg(e.azimuth_deg), rad_from_deg(e.elevation_deg));
  const double reach_m = std::max({e.across_m, e.along_m, e.half_height_m});
  Array3<double> echo(shape);
  constexpr int kFine = 4;
  for (int b = 0; b < shape.beams; ++b) {
    for (int s = std::max(static_cast<int>((e.range_m - reach_m) / kSpacing_m), 0); s < shape.samples; ++s) {
      if (s * kSpacing_m > e.range_m + reach_m) break;
      for (int fine = -3 * kFine; fine < (shape.fans + 3) * kFine; ++fine) {
        const double fan = static_cast<double>(fine) / kFine;
        const auto p =
            place(s * kSpacing_m, rad_from_deg(-30.0 + b * 60.0 / 24.0), rad_from_deg(-45.0 + fan * 45.0 / 19.0));
        const double d = std::pow((p[0] - centre[0]) / e.across_m, 2) + std::pow((p[1] - centre[1]) / e.along_m, 2) +
                         std::pow((p[2] - centre[2]) / e.half_height_m, 2);
        if (d >= 1.0) continue;
        for (int f = std::max(fine / kFine - 3, 0); f <= std::min(fine / kFine + 3, shape.fans - 1); ++f) {
          const double off = (f - fan) * 45.0 / 19.0 / 7.0;
          const double here = std::pow(10.0, -2.4 * off * off);
          echo(f, b, s) = std::max(echo(f, b, s), here);
          if (b > 0) echo(f, b - 1, s) = std::max(echo(f, b - 1, s), 0.05 * here);
          if (b + 1 < shape.beams) echo(f, b + 1, s) = std::max(echo(f, b + 1, s), 0.05 * here);
        }
      }
    }
  }
  return echo;
}

inline void add_echo(Array3<std::int16_t>& ping, const Array3<double>& echo, double power_db, std::uint64_t seed) {
  TestRandom random(seed);
  for (std::size_t i = 0; i < echo.all().size(); ++i) {
    if (echo.all()[i] == 0.0) continue;
    auto& count = ping.all()[i];
    count = counts_of_power(linear_from_db(db_from_counts(count)) +
                            linear_from_db(power_db) * echo.all()[i] * random.exponential());
  }
}

/// Adds a speckled body of a mean power (dB re 1 W) at its core.
inline void add_school(Array3<std::int16_t>& ping, const Ellipsoid& e, double power_db, std::uint64_t seed) {
  add_echo(ping, echo_of(e, ping.shape()), power_db, seed);
}

inline void add_power(std::int16_t& count, double power_db, TestRandom& random) {
  count = counts_of_power(linear_from_db(db_from_counts(count)) + linear_from_db(power_db) * random.exponential());
}

/// Beams differ by up to 10 dB.
inline void tilt_beams(Array3<std::int16_t>& ping) {
  const Shape3 shape = ping.shape();
  for (int f = 0; f < shape.fans; ++f) {
    for (int b = 0; b < shape.beams; ++b) {
      const auto shift = static_cast<std::int16_t>(counts_from_db(10.0 * ((f * 7 + b * 13) % 17) / 16.0));
      for (auto& v : ping.row(f, b)) v = static_cast<std::int16_t>(v + shift);
    }
  }
}

inline std::size_t faults(const Array3<std::int16_t>& ping, SampleFlags which) {
  Array3<SampleFlags> flags(ping.shape());
  flag_ping(ping.view(), {}, {}, {}, flags.view());
  return count_flag(flags, which);
}

}  // namespace sonar
