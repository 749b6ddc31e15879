// SPDX-License-Identifier: Apache-2.0
#include "school/integrate/depth_parts.h"

#include <algorithm>
#include <array>
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

DepthAlong::DepthAlong(const Placement& placement) {
  ray_.transducer_depth_m = placement.transducer_depth_m;
  ray_.rays = placement.rays;
}

double DepthAlong::depth_m(double slope, double range_m) const {
  if (!bent()) return ray_.transducer_depth_m + range_m * slope;
  const double level = std::sqrt(std::max(1.0 - slope * slope, 0.0));
  return ray_.transducer_depth_m + levelled(Point<Sonar>{range_m * level, 0.0, range_m * slope}, ray_).z;
}

double DepthAlong::deepest_m(const BeamSlope& slope, double farthest_m) const {
  constexpr int kSteps = 64;  // a ray may turn back upwards
  double deepest = 0.0;
  for (int i = bent() ? 1 : kSteps; i <= kSteps; ++i) {
    const double range_m = farthest_m * i / kSteps;
    for (const double one : {slope.upper, slope.axis, slope.lower}) {
      deepest = std::max(deepest, depth_m(one, range_m));
    }
  }
  return deepest;
}

namespace {

/// The depth that a straight path has where bent ones reach a depth: between and beyond three of them evenly.
class Straightened {
 public:
  /// depths of the bent paths are those of the straight ones, `upper` first
  Straightened(const std::array<double, 3>& straight_m, const std::array<double, 3>& bent_m)
      : straight_m_(straight_m), bent_m_(bent_m) {}
  [[nodiscard]] double of(double depth_m) const {
    const std::size_t part = depth_m < bent_m_[1] ? 0 : 1;
    const double thick_m = bent_m_[part + 1] - bent_m_[part];
    // Rays that meet tell no thickness.
    if (!(thick_m > 1e-6)) return depth_m + straight_m_[1] - bent_m_[1];
    const double share = (depth_m - bent_m_[part]) / thick_m;
    return straight_m_[part] + share * (straight_m_[part + 1] - straight_m_[part]);
  }

 private:
  std::array<double, 3> straight_m_;
  std::array<double, 3> bent_m_;
};

}  // namespace

DepthParts::DepthParts(const BeamSlope& slope, const DepthAlong& along, const RangeAxis& range,
                       const CellLayout& layout, int channels) {
  const double axis_rad = dip_rad(slope.axis, 1.0);
  const double transducer_m = along.transducer_depth_m();
  first_.reserve(static_cast<std::size_t>(range.count) + 1);
  for (int sample = 0; sample < range.count; ++sample) {
    first_.push_back(parts_.size());
    const double r = range.range_m(sample);
    if (r < range.spacing_m || r >= layout.max_range_m) continue;
    const auto bin = static_cast<int>(r / layout.range_bin_m);
    std::array<double, 3> straight_m{slope.upper, slope.axis, slope.lower};
    std::array<double, 3> depths_m = straight_m;
    for (double& one : straight_m) one = transducer_m + r * one;
    for (double& one : depths_m) one = along.depth_m(one, r);
    const Straightened straightened(straight_m, depths_m);
    const auto off_axis = [&](double depth_m) {
      const double straight = along.bent() ? straightened.of(depth_m) : depth_m;
      return dip_rad(straight - transducer_m, r) - axis_rad;
    };
    // Neighbouring rays may have crossed.
    const double top = std::min(depths_m[0], depths_m[2]);
    const double bottom = std::max(depths_m[0], depths_m[2]);
    const auto channel_of = [&](double depth) { return std::floor((depth - layout.depth_from_m) / layout.channel_m); };
    const auto first = static_cast<int>(std::max(channel_of(top), 0.0));
    const auto last = static_cast<int>(std::min(channel_of(bottom), channels - 1.0));
    for (int channel = first; channel <= last; ++channel) {
      const double from = layout.depth_m(channel);
      const double to = layout.depth_m(channel + 1);
      const double share =
          bottom > top ? std::max(0.0, std::min(bottom, to) - std::max(top, from)) / (bottom - top) : 1.0;
      if (!(share > 0.0)) continue;
      parts_.push_back({bin * channels + channel, share, two_way_share(off_axis(from), off_axis(to), slope.width_rad)});
    }
  }
  first_.push_back(parts_.size());
}

}  // namespace sonar
