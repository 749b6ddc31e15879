// SPDX-License-Identifier: Apache-2.0
#include "geo/sector.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "base/check.h"
#include "geo/shells.h"

namespace sonar {
namespace {

std::vector<AngleBounds> tile(const std::vector<double>& centres, double lone_width) {
  const std::size_t n = centres.size();
  std::vector<AngleBounds> bounds(n);
  if (n == 1) {
    bounds[0] = {centres[0] - lone_width / 2, centres[0] + lone_width / 2};
    return bounds;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double below = i > 0 ? centres[i] - centres[i - 1] : centres[1] - centres[0];
    const double above = i + 1 < n ? centres[i + 1] - centres[i] : centres[n - 1] - centres[n - 2];
    bounds[i] = {centres[i] - below / 2, centres[i] + above / 2};
  }
  return bounds;
}

double fractional_index(const std::vector<double>& centres, const std::vector<AngleBounds>& bounds, double value) {
  if (centres.size() == 1) return (value - centres[0]) / (bounds[0].upper - bounds[0].lower);
  const auto upper = std::upper_bound(centres.begin() + 1, centres.end() - 1, value);
  const auto i = static_cast<std::size_t>(upper - centres.begin()) - 1;
  return static_cast<double>(i) + (value - centres[i]) / (centres[i + 1] - centres[i]);
}

/// The inverse of fractional_index().
double angle_at(const std::vector<double>& centres, const std::vector<AngleBounds>& bounds, double index) {
  if (centres.size() == 1) return centres[0] + index * (bounds[0].upper - bounds[0].lower);
  const double last = static_cast<double>(centres.size() - 2);
  const auto i = static_cast<std::size_t>(std::clamp(std::floor(index), 0.0, last));
  return centres[i] + (index - static_cast<double>(i)) * (centres[i + 1] - centres[i]);
}

bool strictly_rising(const std::vector<double>& values) {
  return std::adjacent_find(values.begin(), values.end(), [](double a, double b) { return !(a < b); }) == values.end();
}

}  // namespace

Sector::Sector(std::vector<double> elevation_rad, std::vector<double> azimuth_rad, RangeAxis range,
               double lone_elevation_width_rad, double lone_azimuth_width_rad)
    : elevation_rad_(std::move(elevation_rad)), azimuth_rad_(std::move(azimuth_rad)), range_(range) {
  SONAR_CHECK(!elevation_rad_.empty() && !azimuth_rad_.empty());
  SONAR_CHECK(strictly_rising(elevation_rad_) && strictly_rising(azimuth_rad_));
  SONAR_CHECK(range_.spacing_m > 0.0 && range_.count >= 0);
  elevation_bounds_ = tile(elevation_rad_, lone_elevation_width_rad);
  azimuth_bounds_ = tile(azimuth_rad_, lone_azimuth_width_rad);
  shell_ = shells_m3_per_sr(range_);
}

Point<Sonar> Sector::direction(double elevation_rad, double azimuth_rad) {
  const double c = std::cos(elevation_rad);
  return {c * std::cos(azimuth_rad), c * std::sin(azimuth_rad), -std::sin(elevation_rad)};
}

Point<Sonar> Sector::centre(int fan, int beam, int sample) const {
  return direction(elevation_rad(fan), azimuth_rad(beam)) * range_.range_m(sample);
}

double Sector::solid_angle_sr(int fan, int beam) const {
  const AngleBounds e = elevation_bounds(fan);
  const AngleBounds a = azimuth_bounds(beam);
  return (a.upper - a.lower) * std::abs(std::sin(e.upper) - std::sin(e.lower));
}

SectorIndex Sector::index_of(const Point<Sonar>& p) const {
  const double range = norm(p);
  const double elevation = range > 0.0 ? std::asin(std::clamp(-p.z / range, -1.0, 1.0)) : 0.0;
  const double middle = (azimuth_rad_.front() + azimuth_rad_.back()) / 2;
  const double turns = 2.0 * std::numbers::pi;
  double azimuth = std::atan2(p.y, p.x);
  azimuth -= turns * std::round((azimuth - middle) / turns);
  return {fractional_index(elevation_rad_, elevation_bounds_, elevation),
          fractional_index(azimuth_rad_, azimuth_bounds_, azimuth), range_.sample_at(range)};
}

int Sector::row_towards(const Point<Sonar>& p) const {
  const SectorIndex at = index_of(p);
  const auto whole = [](double index, int count) {
    return static_cast<int>(std::clamp(std::round(index), 0.0, static_cast<double>(count - 1)));
  };
  return whole(at.fan, fans()) * beams() + whole(at.beam, beams());
}

Point<Sonar> Sector::place_at(const SectorIndex& index) const {
  const double elevation = angle_at(elevation_rad_, elevation_bounds_, index.fan);
  const double azimuth = angle_at(azimuth_rad_, azimuth_bounds_, index.beam);
  constexpr double kUpright = 0.5 * std::numbers::pi;
  return direction(std::clamp(elevation, -kUpright, kUpright), azimuth) * std::max(range_.range_m(index.sample), 0.0);
}

bool Sector::contains(const SectorIndex& index) const {
  return index.fan >= -0.5 && index.fan <= fans() - 0.5 && index.beam >= -0.5 && index.beam <= beams() - 0.5 &&
         index.sample >= -0.5 && index.sample <= range_.count - 0.5;
}

}  // namespace sonar
