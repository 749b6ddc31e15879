// SPDX-License-Identifier: Apache-2.0
#include "school/measure/density_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace sonar {
namespace {

constexpr double kEvenKurtosis = 15.0 / 7.0;
constexpr double kEvenFourth = kEvenKurtosis - 3.0;  ///< fourth cumulant, in variances squared
constexpr double kEvenShape = 5.0;
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

LevelMoments::Cumulants LevelMoments::along(double axis_rad, const Point<Sonar>& centre) const {
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
  if (!(raw[0] > 0.0)) return {};
  for (std::size_t k = 1; k < 5; ++k) raw[k] /= raw[0];
  const double square = raw[1] * raw[1];
  const double variance = raw[2] - square;
  const double fourth = raw[4] - 4.0 * raw[1] * raw[3] + 6.0 * square * raw[2] - 3.0 * square * square;
  return {variance, fourth - 3.0 * variance * variance};
}

double shape_variance(double kurtosis) {
  const double k = std::clamp(kurtosis, kLeastKurtosis, kMostKurtosis);
  return k * k * (1.0 + 7.0 / 90.0 * (k - 1.0));
}

double shape_variance(std::span<const AxisSighting> sightings, const MeasureParams& params) {
  if (!params.find_density) return params.shape_variance;
  double looks = 0.0;
  double fourth = 0.0;
  double of_bodies = 0.0;
  double of_echoes = 0.0;
  for (const AxisSighting& sighting : sightings) {
    if (!std::isfinite(sighting.variance) || !std::isfinite(sighting.fourth_cumulant)) continue;
    const double body = std::max(sighting.variance, 0.0);
    looks += sighting.looks;
    fourth += sighting.looks * (sighting.fourth_cumulant - kEvenFourth * body * body);
    of_bodies += sighting.looks * body * body;
    of_echoes += sighting.looks * sighting.echo_variance * sighting.echo_variance;
  }
  if (!(of_echoes > 0.0)) return params.shape_variance;
  const double off = fourth / of_echoes * looks / (looks + params.density_looks);
  const double doubt = std::max(0.0, 1.0 - std::sqrt(of_bodies / of_echoes));
  const double told = std::copysign(std::max(std::abs(off) - doubt, 0.0), off);
  return params.shape_variance * shape_variance(kEvenKurtosis + told) / kEvenShape;
}

}  // namespace sonar
