// SPDX-License-Identifier: Apache-2.0
#include "render/gl/hull.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sonar {
namespace {

using Corner = std::array<float, 3>;

/// Widens everything a little, against rounding at the silhouette.
constexpr double kSlack = 1e-4;
constexpr double kFacetRad = 0.06;  ///< of about

struct Extent {
  double side_rad;  ///< half width
  double low_rad, high_rad;
  double radius_m;
  int across, upwards;  ///< facets
};

/// A chord of a cone lies inside it; where the inside belongs to the sector, the cone is flattened until chords touch.
double flattened(double elevation_rad, double half_facet_rad) {
  return std::atan(std::tan(elevation_rad) * std::cos(half_facet_rad));
}

Extent extent_of(const GridAxes& axes) {
  const double steepest = 0.5 * std::numbers::pi - 1e-3;
  Extent e{};
  e.side_rad = std::min(axes.half_width_rad + kSlack, std::numbers::pi);
  e.across = std::max(2, static_cast<int>(std::ceil(2.0 * e.side_rad / kFacetRad)));
  const double half_facet = e.side_rad / e.across;
  const double low = std::clamp(axes.first_elevation_rad - kSlack, -steepest, steepest);
  const double high = std::clamp(axes.last_elevation_rad + kSlack, -steepest, steepest);
  e.low_rad = low > 0.0 ? flattened(low, half_facet) : low;
  e.high_rad = high < 0.0 ? flattened(high, half_facet) : high;
  e.upwards = std::max(2, static_cast<int>(std::ceil((e.high_rad - e.low_rad) / kFacetRad)));
  // A facet dips below the sphere by the cosine of half its diagonal.
  const double half_diagonal = std::hypot(half_facet, 0.5 * (e.high_rad - e.low_rad) / e.upwards);
  e.radius_m = axes.farthest_m * (1.0 + kSlack) / std::cos(half_diagonal);
  return e;
}

Corner corner(const Extent& e, int across, int upwards, double radius_m) {
  const double azimuth = e.side_rad * (2.0 * across / e.across - 1.0);
  const double elevation = e.low_rad + (e.high_rad - e.low_rad) * upwards / e.upwards;
  const double rho = radius_m * std::cos(elevation);
  return {static_cast<float>(rho * std::cos(azimuth)), static_cast<float>(rho * std::sin(azimuth)),
          static_cast<float>(-radius_m * std::sin(elevation))};
}

}  // namespace

std::vector<std::array<float, 3>> sector_hull(const GridAxes& axes) {
  const Extent e = extent_of(axes);
  const Corner apex{0.0F, 0.0F, 0.0F};
  const auto at = [&](int across, int upwards) { return corner(e, across, upwards, e.radius_m); };
  std::vector<Corner> out;
  for (int i = 0; i < e.across; ++i) {
    for (int j = 0; j < e.upwards; ++j) {
      out.insert(out.end(), {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    out.insert(out.end(), {apex, at(i, 0), at(i + 1, 0), apex, at(i + 1, e.upwards), at(i, e.upwards)});
  }
  for (int j = 0; j < e.upwards; ++j) {
    out.insert(out.end(), {apex, at(0, j), at(0, j + 1), apex, at(e.across, j + 1), at(e.across, j)});
  }
  return out;
}

}  // namespace sonar
