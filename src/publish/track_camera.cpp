// SPDX-License-Identifier: Apache-2.0
#include "publish/track_camera.h"

#include <fmt/format.h>

#include <cmath>

#include "base/units.h"
#include "geo/geodesic.h"

namespace sonar {

Result<TrackCamera> TrackCamera::along(std::span<const PingNavigation> pings, const Camera& camera, double reach_m) {
  if (pings.size() < 2) return fail(ErrorCode::usage, "a movie along the track needs two pings or more");
  for (const PingNavigation& ping : pings) {
    if (ping.has_position() && !std::isnan(ping.heading_deg)) continue;
    return fail(
        ErrorCode::mismatch,
        fmt::format("a movie along the track needs the position and heading of each ping; the ping at {} has no {}",
                    time_text(ping.time), ping.has_position() ? "heading" : "position"));
  }
  TrackCamera out;
  const PingNavigation& reference = pings[pings.size() / 2];
  out.origin_ = reference.transducer;
  out.heading_rad_ = rad_from_deg(reference.heading_deg);
  out.transducer_depth_m_ = reference.transducer_depth_m;
  out.steps_ = static_cast<double>(pings.size() - 1);
  const Point<Enu> first = to_enu(pings.front().transducer, out.origin_);
  const Point<Enu> last = to_enu(pings.back().transducer, out.origin_);
  const Point<Enu> way = last - first;
  const double length = norm(way);
  out.halfway_ = (first + last) * 0.5;
  out.travel_ = way * (length > 2.0 * reach_m ? 1.0 - 2.0 * reach_m / length : 0.0);
  out.camera_ = camera;
  return out;
}

TrackCamera TrackCamera::from_farther(double factor) const {
  TrackCamera out = *this;
  out.camera_ = zoomed(camera_, factor);
  return out;
}

Point<Enu> TrackCamera::middle(double at) const { return halfway_ + travel_ * (at / steps_ - 0.5); }

Point<Sonar> TrackCamera::moved(const Point<Sonar>& place, const PingNavigation& ship, double at) const {
  const Point<Enu> on_earth = to_enu(place, heading_rad_) + middle(at);
  Point<Sonar> out = to_sonar(on_earth - to_enu(ship.transducer, origin_), rad_from_deg(ship.heading_deg));
  // Depths are below the transducer, which may heave; the camera does not.
  out.z += transducer_depth_m_ - ship.transducer_depth_m;
  return out;
}

Camera TrackCamera::seen_from(const PingNavigation& ship, double at) const {
  Camera out = camera_;
  out.eye = moved(camera_.eye, ship, at);
  out.target = moved(camera_.target, ship, at);
  return out;
}

}  // namespace sonar
