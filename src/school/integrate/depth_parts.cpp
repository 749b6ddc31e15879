// SPDX-License-Identifier: Apache-2.0
#include "school/integrate/depth_parts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/units.h"

namespace sonar {
namespace {

double slope_at(double elevation_rad, double azimuth_rad, const Placement& placement) {
  return levelled_direction(Sector::direction(elevation_rad, azimuth_rad), placement).z;
}

/// Angle below the horizon under which a depth is seen from so far off.
double dip_rad(double below_m, double range_m) { return std::asin(std::clamp(below_m / range_m, -1.0, 1.0)); }

}  // namespace

BeamSlope beam_slope(const Sector& sector, const BeamGrid& grid, const Placement& placement, int row) {
  const int fan = row / sector.beams();
  const double azimuth = sector.azimuth_rad(row % sector.beams());
  const AngleBounds bounds = sector.elevation_bounds(fan);
  const double a = slope_at(bounds.upper, azimuth, placement);
  const double b = slope_at(bounds.lower, azimuth, placement);
  return {std::min(a, b), slope_at(sector.elevation_rad(fan), azimuth, placement), std::max(a, b),
          rad_from_deg(grid.vertical_width_deg[static_cast<std::size_t>(row)])};
}

double two_way_share(double from_rad, double to_rad, double width_rad) {
  const double scale = std::sqrt(8.0 * std::numbers::ln2) / width_rad;
  return 0.5 * (std::erf(to_rad * scale) - std::erf(from_rad * scale));
}

DepthParts::DepthParts(const BeamSlope& slope, double transducer_depth_m, const RangeAxis& range,
                       const CellLayout& layout, int channels) {
  const double axis_rad = dip_rad(slope.axis, 1.0);
  first_.reserve(static_cast<std::size_t>(range.count) + 1);
  for (int sample = 0; sample < range.count; ++sample) {
    first_.push_back(parts_.size());
    const double r = range.range_m(sample);
    if (r < range.spacing_m || r >= layout.max_range_m) continue;
    const auto bin = static_cast<int>(r / layout.range_bin_m);
    const double top = transducer_depth_m + r * slope.upper;
    const double bottom = transducer_depth_m + r * slope.lower;
    const auto channel_of = [&](double depth) { return std::floor((depth - layout.depth_from_m) / layout.channel_m); };
    const auto first = static_cast<int>(std::max(channel_of(top), 0.0));
    const auto last = static_cast<int>(std::min(channel_of(bottom), channels - 1.0));
    for (int channel = first; channel <= last; ++channel) {
      const double from = layout.depth_m(channel);
      const double to = layout.depth_m(channel + 1);
      const double share =
          bottom > top ? std::max(0.0, std::min(bottom, to) - std::max(top, from)) / (bottom - top) : 1.0;
      if (!(share > 0.0)) continue;
      const double beam = two_way_share(dip_rad(from - transducer_depth_m, r) - axis_rad,
                                        dip_rad(to - transducer_depth_m, r) - axis_rad, slope.width_rad);
      parts_.push_back({bin * channels + channel, share, beam});
    }
  }
  first_.push_back(parts_.size());
}

}  // namespace sonar
