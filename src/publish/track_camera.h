// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/result.h"
#include "geo/frames.h"
#include "model/navigation.h"
#include "view/volume/camera.h"

namespace sonar {

/// A camera that the ship sails past. Where the track is no longer than twice the sonar's reach it stays where it is on the
/// earth; along a longer one it moves evenly from one end towards the other, so that the ship passes it as slowly.
class TrackCamera {
 public:
  /// pings    of the movie, two or more
  /// camera   of the middle ping, in its sonar frame
  /// reach_m  of the sonar, from the ship
  /// errors   mismatch: a ping without position or heading; usage: fewer than two pings
  [[nodiscard]] static Result<TrackCamera> along(std::span<const PingNavigation> pings, const Camera& camera,
                                                 double reach_m);

  /// The same from `factor` times as far from what it looks at.
  [[nodiscard]] TrackCamera from_farther(double factor) const;
  /// In the sonar frame of the ship.
  /// at  how far the movie is, pings from its first; with a fraction
  [[nodiscard]] Camera seen_from(const PingNavigation& ship, double at) const;
  /// Where the camera's middle lies, m east and north of the middle ping.
  [[nodiscard]] Point<Enu> middle(double at) const;

 private:
  [[nodiscard]] Point<Sonar> moved(const Point<Sonar>& place, const PingNavigation& ship, double at) const;

  Camera camera_;
  Geographic origin_;
  double heading_rad_ = 0.0;
  double transducer_depth_m_ = 0.0;
  Point<Enu> halfway_;  ///< between the ends of the track
  Point<Enu> travel_;   ///< of the camera in the whole movie
  double steps_ = 1.0;
};

}  // namespace sonar
