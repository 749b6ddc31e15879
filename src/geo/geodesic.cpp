// SPDX-License-Identifier: Apache-2.0
#include "geo/geodesic.h"

#include <geodesic.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace sonar {
namespace {

const geod_geodesic& wgs84() {
  static const geod_geodesic ellipsoid = [] {
    geod_geodesic g{};
    geod_init(&g, 6378137.0, 1.0 / 298.257223563);
    return g;
  }();
  return ellipsoid;
}

double turn(const PlanePoint& o, const PlanePoint& a, const PlanePoint& b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

}  // namespace

GeodesicStep geodesic(const Geographic& from, const Geographic& to) {
  GeodesicStep step;
  double azimuth = 0.0;
  geod_inverse(&wgs84(), from.latitude_deg, from.longitude_deg, to.latitude_deg, to.longitude_deg, &step.distance_m,
               &azimuth, nullptr);
  step.bearing_deg = wrap_360(azimuth);
  return step;
}

Geographic destination(const Geographic& from, double distance_m, double bearing_deg) {
  Geographic to;
  geod_direct(&wgs84(), from.latitude_deg, from.longitude_deg, bearing_deg, distance_m, &to.latitude_deg,
              &to.longitude_deg, nullptr);
  to.longitude_deg = wrap_180(to.longitude_deg);
  return to;
}

Geographic to_geographic(const Point<Enu>& p, const Geographic& origin) {
  return destination(origin, std::hypot(p.x, p.y), std::atan2(p.x, p.y) * (180.0 / std::numbers::pi));
}

Point<Enu> to_enu(const Geographic& place, const Geographic& origin) {
  const GeodesicStep step = geodesic(origin, place);
  const double bearing = step.bearing_deg * (std::numbers::pi / 180.0);
  return {step.distance_m * std::sin(bearing), step.distance_m * std::cos(bearing), 0.0};
}

std::vector<PlanePoint> convex_hull(std::vector<PlanePoint> points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<PlanePoint> hull;
  const auto chain = [&](auto begin, auto end) {
    const std::size_t first = hull.size();
    for (auto it = begin; it != end; ++it) {
      while (hull.size() >= first + 2 && turn(hull[hull.size() - 2], hull.back(), *it) <= 0.0) hull.pop_back();
      hull.push_back(*it);
    }
    hull.pop_back();
  };
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return hull;
}

}  // namespace sonar
