// SPDX-License-Identifier: Apache-2.0
#include "school/measure/density_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace sonar {
namespace {

constexpr double kLeastKurtosis = 1.0;  ///< of anything: that of two lumps
constexpr double kMostKurtosis = 2.45;  ///< of a core 10 dB denser than the margin, falling off as exp(-c r^2)

constexpr std::array<std::array<double, 5>, 5> kBinomial = {
    {{1, 0, 0, 0, 0}, {1, 1, 0, 0, 0}, {1, 2, 1, 0, 0}, {1, 3, 3, 1, 0}, {1, 4, 6, 4, 1}}};

}  // namespace

void LevelMoments::add(double azimuth_rad, std::span<const double, 5> of_range) {
  double x = 1.0;
  for (std::size_t i = 0; i < 5; ++i, x *= std::cos(azimuth_rad)) {
    double xy = x;
    for (std::size_t j = 0; i + j < 5; ++j, xy *= std::sin(azimuth_rad)) sums[i][j] += xy * of_range[i + j];
  }
}

Cumulants cumulants(std::array<double, 5> sums) {
  if (!(sums[0] > 0.0)) return {};
  for (std::size_t k = 1; k < 5; ++k) sums[k] /= sums[0];
  const double square = sums[1] * sums[1];
  const double variance = sums[2] - square;
  const double fourth = sums[4] - 4.0 * sums[1] * sums[3] + 6.0 * square * sums[2] - 3.0 * square * square;
  return {variance, fourth - 3.0 * variance * variance};
}

Cumulants LevelMoments::along(double axis_rad, const Point<Sonar>& centre) const {
  const double level = std::hypot(centre.x, centre.y) / norm(centre);
  const double x = level * std::cos(axis_rad);
  const double y = level * std::sin(axis_rad);
  std::array<double, 5> raw{};
  for (std::size_t k = 0; k < 5; ++k) {
    for (std::size_t j = 0; j <= k; ++j) {
      raw[k] += kBinomial[k][j] * std::pow(x, static_cast<double>(k - j)) * std::pow(y, static_cast<double>(j)) *
                sums[k - j][j];
    }
  }
  return cumulants(raw);
}

double shape_variance(double kurtosis) {
  const double k = std::clamp(kurtosis, kLeastKurtosis, kMostKurtosis);
  return k * k * (1.0 + 7.0 / 90.0 * (k - 1.0));
}

double density_kurtosis(std::span<const AxisSighting> sightings, double expected, const MeasureParams& params) {
  double looks = 0.0;
  double fourth = 0.0;
  double of_bodies = 0.0;
  double of_echoes = 0.0;
  for (const AxisSighting& sighting : sightings) {
    if (!std::isfinite(sighting.variance) || !std::isfinite(sighting.fourth_cumulant)) continue;
    const double body = std::max(sighting.variance, 0.0);
    looks += sighting.looks;
    fourth += sighting.looks * (sighting.fourth_cumulant - (expected - 3.0) * body * body);
    of_bodies += sighting.looks * body * body;
    of_echoes += sighting.looks * sighting.echo_variance * sighting.echo_variance;
  }
  if (!params.find_density || !(of_echoes > 0.0)) return expected;
  const double off = fourth / of_echoes * looks / (looks + params.density_looks);
  const double doubt = std::max(0.0, 1.0 - std::sqrt(of_bodies / of_echoes));
  return std::clamp(expected + std::copysign(std::max(std::abs(off) - doubt, 0.0), off), kLeastKurtosis, kMostKurtosis);
}

}  // namespace sonar
