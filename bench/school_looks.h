// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "base/units.h"
#include "model/mask.h"
#include "school/runs.h"
#include "school/test_water.h"

// Looks at simulated schools, each through its own fading, which neighbours share as their beams and the pulse overlap. From
// the beams' patterns and nothing of the code under test.
namespace sonar::bench {

using Random = std::mt19937_64;

inline double between(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

enum class Form { ellipsoid, bent, hollow };

/// A school of random place, form, size and density.
struct Body {
  Form form = Form::ellipsoid;
  test::Ellipsoid hull;
  double axis_rad = 0.0;  ///< of its length, level
  double bend_m = 0.0;    ///< of its ends out of the middle's line
};

inline Body random_body(Random& random) {
  Body body;
  body.form = static_cast<Form>(std::uniform_int_distribution<int>(0, 2)(random));
  body.hull.centre =
      Sector::direction(rad_from_deg(between(random, -32.0, -12.0)), rad_from_deg(between(random, 260.0, 280.0))) *
      between(random, 90.0, 260.0);
  body.hull.half_x = between(random, 9.0, 28.0);
  body.hull.half_y = between(random, 7.0, 18.0);
  body.hull.half_z = between(random, 4.0, 11.0);
  body.hull.sv = linear_from_db(between(random, -55.0, -35.0));
  body.axis_rad = between(random, 0.0, std::numbers::pi);
  body.bend_m = body.form == Form::bent ? between(random, 0.3, 1.0) * body.hull.half_x : 0.0;
  return body;
}

/// A ping's grid and water near a body: a few hundred samples.
struct Water {
  explicit Water(const Body& body, bool own_frequencies) : grid(test::grid()) {
    constexpr double kSample_m = 0.3776;
    const double reach_m = std::max({body.hull.half_x, body.hull.half_y, body.hull.half_z}) + body.bend_m + 30.0;
    const double first_m = norm(body.hull.centre) - reach_m;
    if (own_frequencies) {
      for (std::size_t fan = 0; fan < 20; ++fan) grid.frequency_hz[fan] = 75000.0 + 2000.0 * static_cast<double>(fan);
    }
    sector = grid.sector({first_m, kSample_m, static_cast<int>(2.0 * reach_m / kSample_m)});
    expected = Array3<double>({20, 25, sector.range().count});
  }
  BeamGrid grid;
  Sector sector;
  Array3<double> expected;  ///< sv of the body and of the water
};

/// Adds the echo of a point of so much backscatter as the beams round it hear it.
inline void add_point(Water& water, const Point<Sonar>& at, double backscatter_m2) {
  constexpr double kReach = 5.0;
  const double sigma_v = rad_from_deg(test::kVerticalWidth_deg) / (4.0 * std::sqrt(std::numbers::ln2));
  const double sigma_h = rad_from_deg(test::kHorizontalWidth_deg) / (4.0 * std::sqrt(std::numbers::ln2));
  const Sector& sector = water.sector;
  const double range = norm(at);
  const double elevation = std::asin(-at.z / range);
  const double azimuth = std::atan2(at.y, at.x);
  const auto sample = static_cast<int>(std::lround(sector.range().sample_at(range)));
  if (sample < 0 || sample >= sector.range().count) return;
  const double beam_sr = 2.0 * std::numbers::pi * sigma_v * sigma_h;
  const double sv = backscatter_m2 / (range * range * sector.range().spacing_m * beam_sr);
  for (int f = 0; f < sector.fans(); ++f) {
    const double up = (elevation - sector.elevation_rad(f)) / sigma_v;
    if (std::abs(up) > kReach) continue;
    for (int b = 0; b < sector.beams(); ++b) {
      const double off = std::remainder(azimuth - sector.azimuth_rad(b), 2.0 * std::numbers::pi);
      const double aside = off * std::cos(elevation) / sigma_h;
      if (std::abs(aside) > kReach) continue;
      water.expected(f, b, sample) +=
          sv * test::two_way(test::Beams::gaussian, up, true) * test::two_way(test::Beams::gaussian, aside, false);
    }
  }
}

/// Points in the body, each heard by the beams round it.
inline void fill(Water& water, const Body& body, Random& random) {
  constexpr int kPoints = 4000;
  const test::Ellipsoid& hull = body.hull;
  const double backscatter_m2 =
      4.0 / 3.0 * std::numbers::pi * hull.half_x * hull.half_y * hull.half_z * hull.sv / kPoints;
  for (int i = 0; i < kPoints;) {
    const double x = between(random, -1.0, 1.0);
    const double y = between(random, -1.0, 1.0);
    const double z = between(random, -1.0, 1.0);
    const double out = x * x + y * y + z * z;
    if (out > 1.0 || (body.form == Form::hollow && out < 0.36)) continue;
    ++i;
    const double along = x * hull.half_x;
    const double across = y * hull.half_y + body.bend_m * (2.0 * x * x - 0.4);
    const double cos = std::cos(body.axis_rad);
    const double sin = std::sin(body.axis_rad);
    add_point(water,
              hull.centre + Point<Sonar>{along * cos - across * sin, along * sin + across * cos, z * hull.half_z},
              backscatter_m2);
  }
}

/// Correlation of the amplitudes of two beams so far apart, by summing over their two-way patterns.
inline double summed_correlation(double apart_deg, double width_deg) {
  const double sigma_deg = width_deg / (4.0 * std::sqrt(std::numbers::ln2));
  double product = 0.0;
  double square = 0.0;
  for (int i = -400; i <= 400; ++i) {
    const double z = i * 0.05;
    const double own = test::two_way(test::Beams::gaussian, z, false);
    product += std::sqrt(own * test::two_way(test::Beams::gaussian, z - apart_deg / sigma_deg, false));
    square += own;
  }
  return product / square;
}

/// Rows of a lower triangle that gives independent numbers these correlations (Cholesky).
inline std::vector<std::vector<double>> mixing(int count, double spacing_deg, double width_deg) {
  std::vector<std::vector<double>> rows(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].assign(i + 1, 0.0);
    for (std::size_t j = 0; j <= i; ++j) {
      double left = summed_correlation(static_cast<double>(i - j) * spacing_deg, width_deg);
      for (std::size_t k = 0; k < j; ++k) left -= rows[i][k] * rows[j][k];
      rows[i][j] = i == j ? std::sqrt(std::max(left, 0.0)) : (rows[j][j] > 1e-6 ? left / rows[j][j] : 0.0);
    }
  }
  return rows;
}

/// Fading of mean 1 in a box.
class Fading {
 public:
  /// own_frequencies  each fan fades by itself
  Fading(const Water& water, const IndexBox& box, double pulse_m, bool own_frequencies)
      : box_(box), pulse_samples_(static_cast<int>(std::lround(pulse_m / water.sector.range().spacing_m))) {
    for (int fan = box.first_fan; fan <= box.last_fan; ++fan) {
      const double level = std::cos(water.sector.elevation_rad(fan));
      beams_.push_back(mixing(box.beams(), 2.5 * level, test::kHorizontalWidth_deg));
    }
    if (!own_frequencies) fans_ = mixing(box.fans(), 45.0 / 19.0, test::kVerticalWidth_deg);
  }

  [[nodiscard]] Array3<double> look(Random& random) {
    const auto fans = static_cast<std::size_t>(box_.fans());
    const auto beams = static_cast<std::size_t>(box_.beams());
    Array3<double> fading({box_.fans(), box_.beams(), box_.samples()});
    const auto pulse = static_cast<std::size_t>(pulse_samples_);
    std::vector<std::vector<std::complex<double>>> heard(pulse, std::vector<std::complex<double>>(fans * beams));
    for (int s = 1 - pulse_samples_; s < box_.samples(); ++s) {
      auto& now = heard[static_cast<std::size_t>(s + pulse_samples_) % pulse];
      for (auto& one : now) one = {normal_(random), normal_(random)};
      mix_beams(now);
      if (!fans_.empty()) mix_fans(now);
      if (s < 0) continue;
      for (std::size_t i = 0; i < now.size(); ++i) {
        std::complex<double> sum = 0.0;
        for (const auto& one : heard) sum += one[i];
        fading(static_cast<int>(i / beams), static_cast<int>(i % beams), s) = std::norm(sum) / (2.0 * pulse_samples_);
      }
    }
    return fading;
  }

 private:
  void mix_beams(std::vector<std::complex<double>>& heard) const {
    const auto beams = static_cast<std::size_t>(box_.beams());
    for (std::size_t fan = 0; fan < beams_.size(); ++fan) {
      for (std::size_t b = beams; b-- > 0;) {
        std::complex<double> sum = 0.0;
        for (std::size_t k = 0; k <= b; ++k) sum += beams_[fan][b][k] * heard[fan * beams + k];
        heard[fan * beams + b] = sum;
      }
    }
  }
  void mix_fans(std::vector<std::complex<double>>& heard) const {
    const auto beams = static_cast<std::size_t>(box_.beams());
    for (std::size_t b = 0; b < beams; ++b) {
      for (std::size_t fan = fans_.size(); fan-- > 0;) {
        std::complex<double> sum = 0.0;
        for (std::size_t k = 0; k <= fan; ++k) sum += fans_[fan][k] * heard[k * beams + b];
        heard[fan * beams + b] = sum;
      }
    }
  }

  IndexBox box_;
  int pulse_samples_;
  std::vector<std::vector<std::vector<double>>> beams_;  ///< [fan]
  std::vector<std::vector<double>> fans_;
  std::normal_distribution<double> normal_;
};

}  // namespace sonar::bench
