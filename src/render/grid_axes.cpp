// SPDX-License-Identifier: Apache-2.0
#include "render/grid_axes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace sonar {
namespace {

double angle_of_diamond(double d) {
  const double a = std::abs(d);
  return std::atan2(std::copysign(a <= 1.0 ? a : 2.0 - a, d), 1.0 - a);
}

double index_of(std::span<const double> centres, double angle) {
  const auto upper = std::upper_bound(centres.begin() + 1, centres.end() - 1, angle);
  const auto i = static_cast<std::size_t>(upper - centres.begin()) - 1;
  const double index = static_cast<double>(i) + (angle - centres[i]) / (centres[i + 1] - centres[i]);
  return std::clamp(index, 0.0, static_cast<double>(centres.size() - 1));
}

AngleTable angle_table(std::span<const double> centres, double first_diamond, double last_diamond) {
  AngleTable out;
  out.first = first_diamond;
  out.per_unit = (kAngleEntries - 1) / (last_diamond - first_diamond);
  for (int k = 0; k < kAngleEntries; ++k) {
    const double angle = angle_of_diamond(first_diamond + k / out.per_unit);
    out.value.push_back(static_cast<float>(index_of(centres, angle)));
  }
  return out;
}

double least_step(std::span<const double> centres) {
  double least = centres[1] - centres[0];
  for (std::size_t i = 1; i + 1 < centres.size(); ++i) least = std::min(least, centres[i + 1] - centres[i]);
  return least;
}

bool even(std::span<const double> centres) {
  constexpr double kSpacings = 1e-4;
  constexpr double kMost_rad = std::numbers::pi / 4 + 1e-6;
  if (centres.front() < -kMost_rad || centres.back() > kMost_rad) return false;
  const double step = (centres.back() - centres.front()) / static_cast<double>(centres.size() - 1);
  for (std::size_t i = 0; i < centres.size(); ++i) {
    if (std::abs(centres[i] - centres.front() - static_cast<double>(i) * step) > kSpacings * step) return false;
  }
  return true;
}

std::vector<float> slopes(std::span<const double> centres) {
  std::vector<float> out;
  for (std::size_t i = 0; i + 1 < centres.size(); ++i) {
    out.push_back(static_cast<float>(1.0 / (centres[i + 1] - centres[i])));
  }
  return out;
}

}  // namespace

double diamond_angle(double x, double y) {
  const double sum = std::abs(x) + std::abs(y);
  const double p = sum > 0.0 ? y / sum : 0.0;
  return x >= 0.0 ? p : std::copysign(2.0, y) - p;
}

GridAxes grid_axes(const Sector& sector) {
  GridAxes out;
  out.fans = sector.fans();
  out.beams = sector.beams();
  out.samples = sector.range().count;
  std::vector<double> azimuth;
  std::vector<double> elevation;
  for (int b = 0; b < out.beams; ++b) azimuth.push_back(sector.azimuth_rad(b));
  for (int f = 0; f < out.fans; ++f) elevation.push_back(sector.elevation_rad(f));
  out.middle_rad = 0.5 * (azimuth.front() + azimuth.back());
  for (double& a : azimuth) a -= out.middle_rad;
  out.half_width_rad = std::min(azimuth.back(), std::numbers::pi);
  out.first_elevation_rad = elevation.front();
  out.last_elevation_rad = elevation.back();
  out.first_m = sector.range().first_m;
  out.spacing_m = sector.range().spacing_m;
  out.nearest_m = std::max(0.0, out.first_m);
  out.farthest_m = sector.range().range_m(out.samples - 1);
  const double side = diamond_angle(std::cos(out.half_width_rad), std::sin(out.half_width_rad));
  out.beam_of = angle_table(azimuth, -side, side);
  out.fan_of = angle_table(elevation, diamond_angle(std::cos(elevation.front()), std::sin(elevation.front())),
                           diamond_angle(std::cos(elevation.back()), std::sin(elevation.back())));
  for (const double a : azimuth) {
    out.sin_azimuth.push_back(static_cast<float>(std::sin(a)));
    out.cos_azimuth.push_back(static_cast<float>(std::cos(a)));
  }
  for (const double e : elevation) {
    const double s = std::sin(e);
    out.sin2_elevation.push_back(static_cast<float>(s * s));
  }
  out.beams_per_rad = slopes(azimuth);
  out.fans_per_rad = slopes(elevation);
  out.even_beams = even(azimuth);
  out.even_fans = even(elevation);
  out.least_beam_rad = least_step(azimuth);
  out.least_fan_rad = least_step(elevation);
  return out;
}

}  // namespace sonar
