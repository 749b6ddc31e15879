// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "geo/frames.h"
#include "geo/sector.h"
#include "model/mask.h"
#include "view/image.h"

namespace sonar {

/// A school of the ping as what stands round the volume knows it.
struct SchoolPlace {
  Point<Sonar> middle;
  std::vector<Point<Sonar>> edge;  ///< none of the school lies outside these, wherever it is seen from
  std::string name;                ///< beside it in the picture; empty = nothing
  Rgba8 colour{0, 0, 0, 255};
  bool selected = false;
  bool drop_line = false;  ///< from its middle to the sea surface, and to the seabed where that is known
  double seabed_z_m = std::numeric_limits<double>::quiet_NaN();  ///< under its middle
  /// What its voxels cover, seen from above: the convex hull, in order. z of the seabed there; NaN = as under its middle.
  std::vector<Point<Sonar>> footprint;
  friend bool operator==(const SchoolPlace&, const SchoolPlace&) = default;
};

/// Middle and edge of a mask. `edge` has a few places of each fan, one voxel beyond the mask's own, because a mask fades
/// out over one voxel where it is drawn.
/// result  empty of an empty mask
[[nodiscard]] std::optional<SchoolPlace> school_place(const Sector& sector, const PingMask& mask);

}  // namespace sonar
