// SPDX-License-Identifier: Apache-2.0
#include "publish/movies/track_camera.h"

#include <fmt/format.h>

#include <cmath>

#include "geo/geodesic.h"

namespace sonar {

namespace {

Result<void> require_on_earth(std::span<const PingNavigation> pings) {
  for (const PingNavigation& ping : pings) {
    if (on_earth(ping)) continue;
    return fail(
        ErrorCode::mismatch,
        fmt::format("a movie past which the ship sails needs the position and heading of each ping; the ping at "
                    "{} has no {}",
                    time_text(ping.time), ping.has_position() ? "heading" : "position"));
  }
  return {};
}

}  // namespace

Result<TrackCamera> TrackCamera::along(std::span<const PingNavigation> pings, const Camera& camera, double reach_m) {
  if (pings.size() < 2) return fail(ErrorCode::usage, "a movie along the track needs two pings or more");
  if (auto known = require_on_earth(pings); !known) return pass_on(known);
  TrackCamera out(pings[pings.size() / 2], camera);
  out.steps_ = static_cast<double>(pings.size() - 1);
  const Point<Enu> first = to_enu(pings.front().transducer, out.origin_);
  const Point<Enu> last = to_enu(pings.back().transducer, out.origin_);
  const Point<Enu> way = last - first;
  const double length = norm(way);
  out.halfway_ = (first + last) * 0.5;
  out.travel_ = way * (length > 2.0 * reach_m ? 1.0 - 2.0 * reach_m / length : 0.0);
  return out;
}

Result<TrackCamera> TrackCamera::standing(std::span<const PingNavigation> pings, const Camera& camera,
                                          const PingNavigation& at) {
  for (const auto needed : {pings, std::span(&at, 1)}) {
    if (auto known = require_on_earth(needed); !known) return pass_on(known);
  }
  return TrackCamera(at, camera);
}

TrackCamera TrackCamera::from_farther(double factor) const {
  TrackCamera out = *this;
  out.camera_ = zoomed(camera_, factor);
  return out;
}

Point<Enu> TrackCamera::middle(double at) const { return halfway_ + travel_ * (at / steps_ - 0.5); }

Camera TrackCamera::seen_from(const PingNavigation& ship, double at) const {
  return in_frame_of(camera_, pose_, EarthPose(ship.placement(), origin_), middle(at));
}

}  // namespace sonar
