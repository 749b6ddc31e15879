// SPDX-License-Identifier: Apache-2.0
#include "synth/array/fish.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/units.h"

namespace sonar::synth::array {
namespace {

constexpr int kBearings = 61;    ///< 0 .. 180 degrees
constexpr int kElevations = 31;  ///< -90 .. 90 degrees
constexpr int kNodes = 21;       ///< of a normal distribution, -3 .. 3 standard deviations

double node(int i) { return -3.0 + 6.0 * i / (kNodes - 1); }

}  // namespace

double broadside_m2(const FishParams& params, double length_cm) {
  return linear_from_db(20.0 * std::log10(length_cm) + params.ts_offset_db);
}

double aspect(const FishParams& params, double wave_number, double length_cm, double along) {
  const double x = wave_number * params.bladder * length_cm * 0.01 * along;
  const double line = std::abs(x) < 1e-6 ? 1.0 : std::sin(x) / x;
  return params.any_aspect_share + (1.0 - params.any_aspect_share) * line * line;
}

Point<Enu> fish_axis(double heading_rad, double tilt_rad) {
  const double level = std::cos(tilt_rad);
  return {level * std::sin(heading_rad), level * std::cos(heading_rad), std::sin(tilt_rad)};
}

MeanAspect::MeanAspect(const FishParams& params, double wave_number, double length_cm) {
  for (int b = 0; b < kBearings; ++b) {
    const double bearing = std::numbers::pi * b / (kBearings - 1);
    for (int e = 0; e < kElevations; ++e) {
      const double elevation = std::numbers::pi * (static_cast<double>(e) / (kElevations - 1) - 0.5);
      const Point<Enu> seen = fish_axis(bearing, elevation);
      double sum = 0.0;
      double weights = 0.0;
      for (int h = 0; h < kNodes; ++h) {
        for (int t = 0; t < kNodes; ++t) {
          const double weight = std::exp(-(node(h) * node(h) + node(t) * node(t)) / 2.0);
          const Point<Enu> axis =
              fish_axis(node(h) * rad_from_deg(params.heading_sd_deg), node(t) * rad_from_deg(params.tilt_sd_deg));
          sum += weight * aspect(params, wave_number, length_cm, axis.x * seen.x + axis.y * seen.y + axis.z * seen.z);
          weights += weight;
        }
      }
      table_.push_back(sum / weights);
    }
  }
}

double MeanAspect::at(const Point<Enu>& seen, double heading_rad) const {
  const double bearing = std::acos(std::cos(std::atan2(seen.x, seen.y) - heading_rad));
  const double elevation = std::asin(std::clamp(seen.z, -1.0, 1.0));
  const double x = std::clamp(bearing / std::numbers::pi * (kBearings - 1), 0.0, kBearings - 1.001);
  const double y = std::clamp((elevation / std::numbers::pi + 0.5) * (kElevations - 1), 0.0, kElevations - 1.001);
  const int b = static_cast<int>(x);
  const int e = static_cast<int>(y);
  const auto value = [&](int i, int j) { return table_[static_cast<std::size_t>(i * kElevations + j)]; };
  const double fx = x - b;
  const double fy = y - e;
  return (value(b, e) * (1.0 - fx) + value(b + 1, e) * fx) * (1.0 - fy) +
         (value(b, e + 1) * (1.0 - fx) + value(b + 1, e + 1) * fx) * fy;
}

}  // namespace sonar::synth::array
