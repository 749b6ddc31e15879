// SPDX-License-Identifier: Apache-2.0
#include "session/slices/plane_place.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/units.h"

namespace sonar {
namespace {

using Kind = PlaneSlice::Kind;

double dot(const Point<Sonar>& a, const Point<Sonar>& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Towards the viewer: up, or to the right of the bearing, or between the two.
Point<Sonar> normal_of(const PlanePlace& place, const PlaneFrame& frame) {
  const double tilt = place.lies == Kind::horizontal ? 0.0
                      : place.lies == Kind::vertical ? std::numbers::pi / 2.0
                                                     : rad_from_deg(place.tilt_deg);
  const double azimuth = rad_from_deg(place.bearing_deg) - frame.heading_rad;
  const double level = place.lies == Kind::vertical ? 1.0 : std::sin(tilt);
  const double up = place.lies == Kind::vertical ? 0.0 : std::cos(tilt);
  return {-std::sin(azimuth) * level, std::cos(azimuth) * level, -up};
}

/// How far from the sonar towards the viewer.
double towards_viewer_m(const PlanePlace& place, const PlaneFrame& frame) {
  return place.lies == Kind::horizontal ? frame.transducer_depth_m - place.depth_m : place.offset_m;
}

void set_towards_viewer(PlanePlace& place, double to_m, const PlaneFrame& frame) {
  if (place.lies == Kind::horizontal) {
    place.depth_m = frame.transducer_depth_m - to_m;
  } else {
    place.offset_m = to_m;
  }
}

/// Between which distances along a direction the sector lies, by the corners of its cells.
struct Stretch {
  double first_m = std::numeric_limits<double>::infinity();
  double last_m = -std::numeric_limits<double>::infinity();
};
Stretch stretch_of(const Sector& sector, const Point<Sonar>& along) {
  const double far_m = sector.range().range_m(sector.range().count - 0.5);
  const double near_m = std::max(0.0, sector.range().range_m(-0.5));
  Stretch out;
  for (int f = 0; f <= sector.fans(); ++f) {
    const double elevation =
        f < sector.fans() ? sector.elevation_bounds(f).lower : sector.elevation_bounds(f - 1).upper;
    for (int b = 0; b <= sector.beams(); ++b) {
      const double azimuth = b < sector.beams() ? sector.azimuth_bounds(b).lower : sector.azimuth_bounds(b - 1).upper;
      const double rise = dot(Sector::direction(elevation, azimuth), along);
      out.first_m = std::min({out.first_m, rise * near_m, rise * far_m});
      out.last_m = std::max({out.last_m, rise * near_m, rise * far_m});
    }
  }
  return out;
}

}  // namespace

PlaneFrame plane_frame(const PingNavigation& navigation) {
  const double heading_deg = navigation.heading_deg;
  return {std::isnan(heading_deg) ? 0.0 : rad_from_deg(heading_deg), navigation.transducer_depth_m};
}

PlaneSlice plane_slice(const PlanePlace& place, const PlaneFrame& frame) {
  if (place.lies == Kind::horizontal) return horizontal_plane(place.depth_m, frame.transducer_depth_m);
  const Point<Sonar> normal = normal_of(place, frame);
  const Point<Sonar> foot = normal * place.offset_m;
  if (place.lies == Kind::vertical) {
    PlaneSlice plane = vertical_plane(rad_from_deg(place.bearing_deg) - frame.heading_rad);
    plane.origin = foot;
    return plane;
  }
  // The tilt is never 0, so that there is a level direction.
  return oblique_plane(foot, normal).value_or(PlaneSlice{});
}

PlanePlace moved_through(PlanePlace place, const Point<Sonar>& point, const PlaneFrame& frame) {
  set_towards_viewer(place, dot(point, normal_of(place, frame)), frame);
  return place;
}

PlanePlace laid_through(PlanePlace place, const Point<Sonar>& point, const PlaneFrame& frame) {
  const double bearing_deg = deg_from_rad(std::atan2(point.y, point.x) + frame.heading_rad);
  if (place.lies == Kind::vertical) place.bearing_deg = wrap_360(bearing_deg);
  if (place.lies == Kind::oblique) place.bearing_deg = wrap_360(bearing_deg - 90.0);
  return moved_through(place, point, frame);
}

PlanePlace moved_by(PlanePlace place, double by_m, const Sector& sector, const PlaneFrame& frame) {
  const Stretch stretch = stretch_of(sector, normal_of(place, frame));
  const double now_m = towards_viewer_m(place, frame);
  const double away_m = place.lies == Kind::horizontal ? by_m : -by_m;
  const double to_m = std::clamp(now_m + away_m, std::min(stretch.first_m, now_m), std::max(stretch.last_m, now_m));
  set_towards_viewer(place, to_m, frame);
  return place;
}

std::optional<PlanePlace> turned_by(PlanePlace place, double by_deg, const Point<Sonar>& about,
                                    const PlaneFrame& frame) {
  if (place.lies == Kind::horizontal) return std::nullopt;
  // What the place is off the plane it stays off.
  const double off_m = dot(about, normal_of(place, frame)) - place.offset_m;
  place.bearing_deg = wrap_360(place.bearing_deg + by_deg);
  place.offset_m = dot(about, normal_of(place, frame)) - off_m;
  return place;
}

Result<PlanePlace> vertical_through(PlanePlace place, const Point<Sonar>& a, const Point<Sonar>& b,
                                    const PlaneFrame& frame) {
  if (auto plane = vertical_plane(a, b); !plane) return pass_on(plane);
  place.lies = Kind::vertical;
  place.bearing_deg = wrap_360(deg_from_rad(std::atan2(b.y - a.y, b.x - a.x) + frame.heading_rad));
  return moved_through(place, a, frame);
}

}  // namespace sonar
