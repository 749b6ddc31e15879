// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "base/describe.h"
#include "base/result.h"
#include "geo/sector.h"
#include "model/navigation.h"
#include "view/slices/slice.h"

namespace sonar {

inline constexpr std::array<std::string_view, 3> kPlaneKindNames{"horizontal", "vertical", "oblique"};

/// How the plane of the window's plane slice lies. It goes with the ship; its bearing stays true.
struct PlanePlace {
  PlaneSlice::Kind lies = PlaneSlice::Kind::horizontal;
  double depth_m = 50.0;
  double bearing_deg = 0.0;
  double tilt_deg = 45.0;
  double offset_m = 0.0;
  friend bool operator==(const PlanePlace&, const PlanePlace&) = default;
};

template <class Visitor>
void describe(Visitor& v, PlanePlace& p) {
  v.choice(
      "plane", p.lies, kPlaneKindNames,
      "how the plane of the plane slice lies; a change lays it through the selected school, else through the middle");
  v.field("depth_m", p.depth_m,
          {.unit = "m", .min = -1e5, .max = 1e5, .text = "horizontal plane: depth below the sea surface"});
  v.field("bearing_deg", p.bearing_deg,
          {.unit = "deg",
           .min = -360,
           .max = 720,
           .text = "vertical and oblique planes: the true bearing that points right in the picture"});
  v.field(
      "tilt_deg", p.tilt_deg,
      {.unit = "deg",
       .min = 1,
       .max = 90,
       .text = "oblique plane: how steep it is, 0 = level, 90 = vertical; it goes down to the right of its bearing"});
  v.field(
      "offset_m", p.offset_m,
      {.unit = "m",
       .min = -1e5,
       .max = 1e5,
       .text = "vertical and oblique planes: distance from the sonar towards the viewer, who stands to the right of "
               "the bearing"});
}

/// What a plane that is told in depths and true bearings needs to lie in the sonar's frame.
struct PlaneFrame {
  double heading_rad = 0.0;
  double transducer_depth_m = 0.0;
};
/// Of a ping; without a heading, bearings start from the bow.
[[nodiscard]] PlaneFrame plane_frame(const PingNavigation& navigation);

[[nodiscard]] PlaneSlice plane_slice(const PlanePlace& place, const PlaneFrame& frame);

/// Moved along its normal until a point lies in it.
[[nodiscard]] PlanePlace moved_through(PlanePlace place, const Point<Sonar>& point, const PlaneFrame& frame);
/// A plane of the place's kind through a point: a vertical one goes through the sonar too, an oblique one goes down
/// away from the sonar.
[[nodiscard]] PlanePlace laid_through(PlanePlace place, const Point<Sonar>& point, const PlaneFrame& frame);
/// Moved along its normal: up, or away from the viewer; not beyond the sector, unless it lay there.
[[nodiscard]] PlanePlace moved_by(PlanePlace place, double by_m, const Sector& sector, const PlaneFrame& frame);
/// Turned clockwise about the vertical through a point that stays in it. Empty for a horizontal plane.
[[nodiscard]] std::optional<PlanePlace> turned_by(PlanePlace place, double by_deg, const Point<Sonar>& about,
                                                  const PlaneFrame& frame);
/// Vertical, through two places, seen so that the first lies left of the other.
/// errors  bad_parameter: the places are above each other
[[nodiscard]] Result<PlanePlace> vertical_through(PlanePlace place, const Point<Sonar>& a, const Point<Sonar>& b,
                                                  const PlaneFrame& frame);

}  // namespace sonar
