// SPDX-License-Identifier: Apache-2.0
#include "school/density_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/units.h"
#include "school/echo_row.h"

namespace sonar {
namespace {

constexpr double kEvenKurtosis = 15.0 / 7.0;
constexpr double kEvenShape = 5.0;

/// Sums of echo x (range - a reference)^k.
using Moments = std::array<double, 5>;

void add_run(Moments& moments, const MeasureInput& ping, const Run& run, double background_factor, double about_m) {
  const Sector& sector = *ping.sector;
  const EchoRow echo(ping, run.row, background_factor);
  const double solid_angle = sector.solid_angle_sr(run.row / sector.beams(), run.row % sector.beams());
  for (int s = run.first_sample; s < run.end(); ++s) {
    double sv = 0.0;
    double background = 0.0;
    if (!echo.at(s, sv, background)) continue;
    const double off = sector.range().range_m(s) - about_m;
    double weighted = (sv - background) * solid_angle * sector.shell_m3_per_sr(s);
    for (double& sum : moments) {
      sum += weighted;
      weighted *= off;
    }
  }
}

/// Of the body, whose cumulants and those of a rectangular pulse add up to the echo's. Unknown if little is left.
double kurtosis_of(const Moments& moments, double pulse_m, double least_share) {
  const double mean = moments[1] / moments[0];
  const double second = moments[2] / moments[0];
  const double third = moments[3] / moments[0];
  const double fourth = moments[4] / moments[0];
  const double square = mean * mean;
  const double variance = second - square;
  const double fourth_central = fourth - 4.0 * mean * third + 6.0 * square * second - 3.0 * square * square;
  const double pulse2 = pulse_m * pulse_m;
  const double body = variance - pulse2 / 12.0;
  if (!(moments[0] > 0.0) || !(body > least_share * variance)) return kUnknown;
  const double fourth_cumulant = fourth_central - 3.0 * variance * variance + pulse2 * pulse2 / 120.0;
  return 3.0 + fourth_cumulant / (body * body);
}

/// Bodies whose density falls off as exp(-c r^2) up to the rim r = 1, from hollow to dense-hearted: both rise with c.
struct Bodies {
  static constexpr std::size_t kCount = 129;
  static constexpr double kMostFallOff = 8.0;  ///< c; beyond it the rim is empty and the kurtosis is a Gaussian's
  static constexpr int kShells = 200;          ///< until no digit moves that matters
  std::array<double, kCount> kurtosis{};
  std::array<double, kCount> shape{};  ///< square of the half axis over the variance along it
  Bodies() {
    for (std::size_t k = 0; k < kCount; ++k) {
      const double fall_off = kMostFallOff * (2.0 * static_cast<double>(k) / (kCount - 1) - 1.0);
      std::array<double, 3> sums{};
      for (int i = 0; i < kShells; ++i) {
        const double r = (i + 0.5) / kShells;
        double weighted = std::exp(-fall_off * r * r) * r * r;
        for (double& sum : sums) {
          sum += weighted;
          weighted *= r * r;
        }
      }
      // of r^2 a third lies along one axis, of r^4 a fifth
      const double variance = sums[1] / sums[0] / 3.0;
      kurtosis[k] = sums[2] / sums[0] / 5.0 / (variance * variance);
      shape[k] = 1.0 / variance;
    }
  }
  /// Place in the tables, fractional.
  static double place(double fall_off) { return (fall_off / kMostFallOff + 1.0) / 2.0 * (kCount - 1); }
  [[nodiscard]] double place_of_kurtosis(double wanted) const {
    const auto above = std::upper_bound(kurtosis.begin(), kurtosis.end(), wanted);
    if (above == kurtosis.begin()) return 0.0;
    if (above == kurtosis.end()) return kCount - 1.0;
    const double low = *(above - 1);
    return static_cast<double>(above - kurtosis.begin()) - 1.0 + (wanted - low) / (*above - low);
  }
  [[nodiscard]] double shape_at(double place) const {
    const auto k = std::min(static_cast<std::size_t>(place), kCount - 2);
    return shape[k] + (place - static_cast<double>(k)) * (shape[k + 1] - shape[k]);
  }
};

}  // namespace

RangeProfile range_profile(const MeasureInput& ping, const PingMask& mask, std::span<const double> background_factors,
                           const MeasureParams& params) {
  RangeProfile profile;
  if (mask.runs.empty()) return profile;
  const RangeAxis& range = ping.sector->range();
  const double about_m = range.range_m(mask.runs.front().first_sample);
  Moments moments{};
  for (const Run& run : mask.runs) {
    const auto fan = static_cast<std::size_t>(run.row / ping.sector->beams());
    add_run(moments, ping, run, background_factors[fan], about_m);
  }
  profile.kurtosis = kurtosis_of(moments, ping.pulse_m, params.density_least_share);
  profile.looks = static_cast<double>(mask.voxels()) * range.spacing_m / std::max(range.spacing_m, ping.pulse_m);
  return profile;
}

double shape_variance(double kurtosis, double most_db) {
  static const Bodies bodies;
  const double most = std::min(std::log(linear_from_db(most_db)), Bodies::kMostFallOff);
  const double place = std::clamp(bodies.place_of_kurtosis(kurtosis), Bodies::place(-most), Bodies::place(most));
  return bodies.shape_at(place);
}

double shape_variance(std::span<const RangeProfile> sights, const MeasureParams& params) {
  if (!params.find_density) return params.shape_variance;
  double looks = params.density_looks;
  double sum = params.density_looks * kEvenKurtosis;
  for (const RangeProfile& sight : sights) {
    if (!std::isfinite(sight.kurtosis)) continue;
    looks += sight.looks;
    sum += sight.looks * sight.kurtosis;
  }
  if (!(looks > 0.0)) return params.shape_variance;
  const double off = sum / looks - kEvenKurtosis;
  const double told = std::copysign(std::max(std::abs(off) - params.density_tolerance, 0.0), off);
  return params.shape_variance * shape_variance(kEvenKurtosis + told, params.density_most_db) / kEvenShape;
}

}  // namespace sonar
