// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/result.h"
#include "geo/frames.h"
#include "model/navigation.h"
#include "view/volume/camera.h"
#include "view/volume/earth_pose.h"

namespace sonar {

/// A camera that the ship sails past. It stays where it is on the earth; along a track that is longer than twice the
/// sonar's reach it may move evenly from one end towards the other, so that the ship passes it as slowly.
class TrackCamera {
 public:
  /// pings    of the movie, two or more
  /// camera   of the middle ping, in its sonar frame
  /// reach_m  of the sonar, from the ship
  /// errors   mismatch: a ping without position or heading; usage: fewer than two pings
  [[nodiscard]] static Result<TrackCamera> along(std::span<const PingNavigation> pings, const Camera& camera,
                                                 double reach_m);
  /// One that stands still, however long the track is.
  /// at      the ping, of `pings`, in whose sonar frame the camera is
  /// errors  as along(); one ping is enough
  [[nodiscard]] static Result<TrackCamera> standing(std::span<const PingNavigation> pings, const Camera& camera,
                                                    const PingNavigation& at);

  /// The same from `factor` times as far from what it looks at.
  [[nodiscard]] TrackCamera from_farther(double factor) const;
  /// In the sonar frame of the ship.
  /// at  how far the movie is, pings from its first; with a fraction
  [[nodiscard]] Camera seen_from(const PingNavigation& ship, double at) const;
  /// Where what was at the camera's own ping is now, m east and north of it.
  [[nodiscard]] Point<Enu> middle(double at) const;

 private:
  TrackCamera(const PingNavigation& reference, const Camera& camera)
      : origin_(reference.transducer), pose_(reference.placement(), origin_), camera_(camera) {}

  Geographic origin_;
  EarthPose pose_;  ///< of the camera's own ping
  Camera camera_;
  Point<Enu> halfway_;  ///< between the ends of the track
  Point<Enu> travel_;   ///< of the camera in the whole movie
  double steps_ = 1.0;
};

}  // namespace sonar
