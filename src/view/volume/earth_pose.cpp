// SPDX-License-Identifier: Apache-2.0
#include "view/volume/earth_pose.h"

#include <cmath>

namespace sonar {

EarthPose::EarthPose(const Placement& ship, const Geographic& origin)
    : shift_(ship.transducer, origin), heading_rad_(ship.heading_rad), transducer_depth_m_(ship.transducer_depth_m) {}

Point<Enu> EarthPose::to_earth(const Point<Sonar>& place) const {
  const Point<Enu> level = to_enu(place, heading_rad_);
  const PlanePoint there = shift_.apply({level.x, level.y});
  return {there.x, there.y, level.z - transducer_depth_m_};
}

Point<Sonar> EarthPose::to_ship(const Point<Enu>& place) const {
  const PlanePoint here = shift_.back({place.x, place.y});
  return to_sonar(Point<Enu>{here.x, here.y, place.z + transducer_depth_m_}, heading_rad_);
}

bool on_earth(const PingNavigation& ping) { return ping.has_position() && !std::isnan(ping.heading_deg); }

Camera in_frame_of(const Camera& camera, const EarthPose& then, const EarthPose& now, const Point<Enu>& away) {
  const auto moved = [&](const Point<Sonar>& place) { return now.to_ship(then.to_earth(place) + away); };
  Camera out = camera;
  out.eye = moved(camera.eye);
  out.target = moved(camera.target);
  out.up = moved(camera.target + camera.up) - out.target;
  return out;
}

std::optional<Camera> standing_still(const Camera& camera, const PingNavigation& then, const PingNavigation& now) {
  if (!on_earth(then) || !on_earth(now)) return std::nullopt;
  return in_frame_of(camera, EarthPose(then.placement(), then.transducer), EarthPose(now.placement(), then.transducer));
}

}  // namespace sonar
