// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "geo/frames.h"
#include "model/navigation.h"
#include "model/outline.h"
#include "view/volume/camera.h"

namespace sonar {

/// Where a ping's sonar frame lies on the earth: in the plane of a place that does not move (PlaneShift), z up from the
/// mean water line. Volumes are drawn over a flat sea as wide as the sonar reaches; what else is drawn in them lies in the
/// same plane, by true distances and bearings on the ellipsoid.
class EarthPose {
 public:
  /// ship    has a position; its roll and pitch turn nothing
  EarthPose(const Placement& ship, const Geographic& origin);

  [[nodiscard]] Point<Enu> to_earth(const Point<Sonar>& place) const;
  [[nodiscard]] Point<Sonar> to_ship(const Point<Enu>& place) const;

 private:
  PlaneShift shift_;
  double heading_rad_;
  double transducer_depth_m_;
};

/// Whether it is known where on the earth a ping's sonar frame lies, and how it is turned.
[[nodiscard]] bool on_earth(const PingNavigation& ping);

/// The camera in the frame of another ping, where its eye stands still on the earth.
/// camera  in the frame of `then`
/// result  empty where a position or heading is not known
[[nodiscard]] std::optional<Camera> standing_still(const Camera& camera, const PingNavigation& then,
                                                   const PingNavigation& now);

/// The camera in the frame of another pose, `away` (m, in the plane of both) from where it stood on the earth.
/// camera  in the frame of `then`
[[nodiscard]] Camera in_frame_of(const Camera& camera, const EarthPose& then, const EarthPose& now,
                                 const Point<Enu>& away = {});

}  // namespace sonar
