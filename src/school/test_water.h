// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "base/array.h"
#include "base/sample_flags.h"
#include "base/units.h"
#include "geo/sector.h"
#include "model/beam_grid.h"
#include "model/mask.h"
#include "signal/median.h"

// Water with analytic schools for tests: ellipsoids cut into points, each spread by the beams; exponential
// speckle from an integer hash. Nothing here is shared with the code under test.
namespace sonar::test {

inline std::uint64_t hash64(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}
/// In (0, 1).
inline double uniform(std::uint64_t seed) {
  return (static_cast<double>(hash64(seed) >> 12) + 0.5) / 4503599627370496.0;
}

/// Standard normal.
inline double normal(std::uint64_t seed) {
  return std::sqrt(-2.0 * std::log(uniform(2 * seed))) * std::cos(2.0 * std::numbers::pi * uniform(2 * seed + 1));
}

inline constexpr double kVerticalWidth_deg = 6.6;
inline constexpr double kHorizontalWidth_deg = 3.4;

/// 20 fans from -45 to 0 degrees, 25 beams over 60 degrees about the mounting azimuth.
inline BeamGrid grid(double mounting_deg = 270.0) {
  BeamGrid g;
  for (int f = 0; f < 20; ++f) g.elevation_deg.push_back(-45.0 + f * 45.0 / 19.0);
  for (int b = 0; b < 25; ++b) g.azimuth_deg.push_back(mounting_deg - 30.0 + 2.5 * b);
  g.mounting_azimuth_deg = mounting_deg;
  g.frequency_hz.assign(20, 90000.0);
  for (int i = 0; i < 500; ++i) g.channel.push_back(i);
  g.vertical_width_deg.assign(500, kVerticalWidth_deg);
  g.horizontal_width_deg.assign(500, kHorizontalWidth_deg);
  return g;
}
inline RangeAxis range_axis(int samples = 900) { return {-0.75, 0.3776, samples}; }

/// Two-way pattern in elevation and in azimuth, received with one -3 dB width: exp(-z^2 / 2); a uniform line's
/// (sin x / x)^4; such a line that sends as a Gaussian three times as wide; a Gaussian that sends all beams of a fan alike.
enum class Beams { gaussian, uniform_line, wide_transmit, wide_fan };
/// Echo from further off the axis is left out, and of the integrals as well.
inline constexpr double kReach_sigmas = 7.0;

/// sigmas  angle off the axis in standard deviations of the Gaussian
inline double two_way(Beams beams, double sigmas, bool vertical) {
  if (beams == Beams::gaussian) return std::exp(-0.5 * sigmas * sigmas);
  if (beams == Beams::wide_fan) return std::exp((vertical ? -0.5 : -0.25) * sigmas * sigmas);
  const double x = 1.3915573782515105 * sigmas / (2.0 * std::sqrt(std::numbers::ln2));
  const double sinc = std::abs(x) < 1e-9 ? 1.0 : std::sin(x) / x;
  if (beams == Beams::uniform_line) return std::pow(sinc, 4);
  return sinc * sinc * std::exp(-0.25 * sigmas * sigmas / 9.0);
}
/// Its integral, by summing.
inline double two_way_integral(Beams beams, bool vertical) {
  constexpr int kSteps = 20'000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) sum += two_way(beams, (i + 0.5) / kSteps * kReach_sigmas, vertical);
  return 2.0 * sum * kReach_sigmas / kSteps;
}
/// Equivalent beam angle of every beam of the grid.
inline double beam_angle_db(Beams beams) {
  const double sigma_v = rad_from_deg(kVerticalWidth_deg) / (4.0 * std::sqrt(std::numbers::ln2));
  const double sigma_h = rad_from_deg(kHorizontalWidth_deg) / (4.0 * std::sqrt(std::numbers::ln2));
  return db_from_linear(two_way_integral(beams, true) * two_way_integral(beams, false) * sigma_v * sigma_h);
}

/// Power sent to an azimuth by a fan's transmit beam that ripples by so much from crest to trough, 2.7 beams a wave.
inline double transmitted(double ripple_db, int fan, double azimuth_rad) {
  return linear_from_db(0.5 * ripple_db *
                        std::sin(deg_from_rad(azimuth_rad) * 2.0 * std::numbers::pi / 6.7 + 1.3 * fan));
}
/// The mean of it over a beam's two-way pattern in azimuth, over that on its axis.
inline double mean_transmitted(Beams beams, double ripple_db, int fan, double azimuth_rad) {
  const double sigma_h = rad_from_deg(kHorizontalWidth_deg) / (4.0 * std::sqrt(std::numbers::ln2));
  double sum = 0.0;
  double whole = 0.0;
  for (int i = -700; i <= 700; ++i) {
    const double x = i * 0.01;
    sum += two_way(beams, x, false) * transmitted(ripple_db, fan, azimuth_rad + x * sigma_h);
    whole += two_way(beams, x, false);
  }
  return sum / whole / transmitted(ripple_db, fan, azimuth_rad);
}

struct Ellipsoid {
  Point<Sonar> centre;
  double half_x = 10.0;  ///< m, along the sonar frame's axes
  double half_y = 8.0;
  double half_z = 5.0;
  double sv = 1e-4;
  Beams beams = Beams::gaussian;
  double ripple_db = 0.0;               ///< of the transmit fan; beam_angle_db() goes with it
  double (*density)(double) = nullptr;  ///< of the distance from core (0) to margin (1), times sv; none = 1
};

/// Equivalent beam angle of each beam of the grid where the transmit fan ripples.
inline std::vector<double> beam_angles_db(const Sector& sector, Beams beams, double ripple_db) {
  std::vector<double> psi_db(500, beam_angle_db(beams));
  for (int row = 0; row < 500; ++row) {
    const double azimuth_rad = sector.azimuth_rad(row % 25);
    psi_db[static_cast<std::size_t>(row)] += db_from_linear(mean_transmitted(beams, ripple_db, row / 25, azimuth_rad));
  }
  return psi_db;
}

/// Expected sv of one ellipsoid: beams and nothing else. Gain is that on the axis, the transmit beam's ripple included.
inline void add_ellipsoid(Array3<double>& sv, const Sector& sector, const Ellipsoid& e, int points = 4000) {
  const double sigma_v = rad_from_deg(kVerticalWidth_deg) / (4.0 * std::sqrt(std::numbers::ln2));
  const double sigma_h = rad_from_deg(kHorizontalWidth_deg) / (4.0 * std::sqrt(std::numbers::ln2));
  const double integral = two_way_integral(e.beams, true) * two_way_integral(e.beams, false);
  const double volume = 4.0 / 3.0 * std::numbers::pi * e.half_x * e.half_y * e.half_z;
  const double dr = sector.range().spacing_m;
  std::vector<double> heard(static_cast<std::size_t>(sector.fans() * sector.beams()), 1.0);
  for (int row = 0; e.ripple_db > 0.0 && row < sector.fans() * sector.beams(); ++row) {
    const int fan = row / sector.beams();
    const double azimuth_rad = sector.azimuth_rad(row % sector.beams());
    heard[static_cast<std::size_t>(row)] =
        transmitted(e.ripple_db, fan, azimuth_rad) * mean_transmitted(e.beams, e.ripple_db, fan, azimuth_rad);
  }
  std::uint64_t n = 1;
  for (int i = 0; i < points;) {
    const double x = 2.0 * uniform(n++) - 1.0;
    const double y = 2.0 * uniform(n++) - 1.0;
    const double z = 2.0 * uniform(n++) - 1.0;
    if (x * x + y * y + z * z > 1.0) continue;
    ++i;
    const Point<Sonar> p = e.centre + Point<Sonar>{x * e.half_x, y * e.half_y, z * e.half_z};
    const double r = norm(p);
    const double elevation = std::asin(-p.z / r);
    const auto sample = static_cast<int>(std::lround(sector.range().sample_at(r)));
    if (sample < 0 || sample >= sector.range().count) continue;
    const double density = e.density == nullptr ? 1.0 : e.density(std::sqrt(x * x + y * y + z * z));
    const double weight = density * e.sv * volume / points / (r * r * dr) / (integral * sigma_v * sigma_h);
    for (int f = 0; f < sector.fans(); ++f) {
      const double de = (elevation - sector.elevation_rad(f)) / sigma_v;
      if (std::abs(de) > kReach_sigmas) continue;
      for (int b = 0; b < sector.beams(); ++b) {
        double azimuth = std::atan2(p.y, p.x) - sector.azimuth_rad(b);
        azimuth -= 2.0 * std::numbers::pi * std::round(azimuth / (2.0 * std::numbers::pi));
        const double da = azimuth * std::cos(elevation) / sigma_h;
        if (std::abs(da) > kReach_sigmas) continue;
        const double sent = e.ripple_db > 0.0
                                ? transmitted(e.ripple_db, f, sector.azimuth_rad(b) + azimuth * std::cos(elevation))
                                : 1.0;
        sv(f, b, sample) += weight * two_way(e.beams, de, true) * two_way(e.beams, da, false) * sent /
                            heard[static_cast<std::size_t>(f * sector.beams() + b)];
      }
    }
  }
}

/// Voxels within 10 dB of the strongest.
inline PingMask truth_of(const Array3<double>& sv) {
  double strongest = 0.0;
  for (const double v : sv.all()) strongest = std::max(strongest, v);
  PingMask mask;
  for (int row = 0; row < static_cast<int>(sv.shape().rows()); ++row) {
    const auto samples = sv.view().row(row);
    for (int s = 0; s < sv.shape().samples; ++s) {
      if (samples[static_cast<std::size_t>(s)] < strongest / 10.0) continue;
      if (mask.runs.empty() || mask.runs.back().row != row || mask.runs.back().end() != s)
        mask.runs.push_back({row, s, 0});
      ++mask.runs.back().count;
      mask.confidence.push_back(255);
    }
  }
  return mask;
}

inline constexpr double kNoise_db = -90.0;  ///< Sv of the background, the same everywhere

/// Counts of expected sv plus background, with or without speckle.
inline Array3<std::int16_t> counts_of(const Array3<double>& sv, std::uint64_t seed, bool speckle = true) {
  Array3<std::int16_t> counts(sv.shape());
  for (std::size_t i = 0; i < sv.shape().size(); ++i) {
    double v = sv.all()[i] + linear_from_db(kNoise_db);
    if (speckle) v *= -std::log(uniform(seed * 0x100000001ULL + i));
    const double c = std::clamp(std::round(counts_from_db(db_from_linear(v))), -32766.0, 32766.0);
    counts.all()[i] = static_cast<std::int16_t>(c);
  }
  return counts;
}

inline Array3<std::int16_t> filtered(const Array3<std::int16_t>& counts, const Array3<SampleFlags>& flags) {
  Array3<std::int16_t> out(counts.shape());
  median_into(counts.view(), flags.view(), MedianParams{}, out.view());
  return out;
}

/// Near field up to 15 m.
inline Array3<SampleFlags> cropped_flags(const Shape3& shape, const Sector& sector) {
  Array3<SampleFlags> flags(shape);
  for (int row = 0; row < static_cast<int>(shape.rows()); ++row) {
    for (int s = 0; s < shape.samples && sector.range().range_m(s) < 15.0; ++s) {
      flags.view().row(row)[static_cast<std::size_t>(s)] |= SampleFlags::near_field;
    }
  }
  return flags;
}

/// The same background for every beam, as the programs' tables would give it.
struct FlatBackground {
  explicit FlatBackground(const Shape3& shape) : power_db(shape.rows(), kNoise_db), calibration(shape) {}
  std::vector<double> power_db;
  Array3<std::int16_t> calibration;
};

}  // namespace sonar::test
