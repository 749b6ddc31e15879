// SPDX-License-Identifier: Apache-2.0
#include "publish/track_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "geo/geodesic.h"

namespace sonar {

Result<TrackCamera> TrackCamera::along(std::span<const PingNavigation> pings, const Camera& camera, bool named,
                                       double reach_m) {
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
  std::vector<Point<Enu>> places;
  for (const PingNavigation& ping : pings) places.push_back(to_enu(ping.transducer, out.origin_));
  const Point<Enu> way = places.back() - places.front();
  const double length = norm(way);
  out.halfway_ = (places.front() + places.back()) * 0.5;
  out.travel_ = way * (length > 2.0 * reach_m ? 1.0 - 2.0 * reach_m / length : 0.0);
  double farthest = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    farthest = std::max(farthest, norm(places[i] - out.middle(static_cast<double>(i))));
  }
  // The sector's size was all that the camera saw; now the ship, with the sector, moves as far to either side.
  out.camera_ = named ? camera : zoomed(camera, 1.0 + farthest / std::max(1.0, reach_m));
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
