// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "geo/geodesic.h"
#include "geo/sector.h"
#include "model/mask.h"
#include "model/product.h"

namespace sonar {

/// A closed ring in a level plane, metres, without the repeated first point.
using Ring = std::vector<PlanePoint>;

/// How a product's pings lie: turned and bent as its recipe has it. `&PingNavigation::placement` takes beams as stabilised
/// and straight.
using PlacementOf = std::function<Placement(const PingNavigation&)>;

/// What a ping's sector covers seen from above: the outer azimuth bounds out to the farthest range, about the
/// transducer. Turned by roll and pitch, and not bent: of what is far off, nearly level beams tell.
/// out  x east, y north, m; a full circle where the beams go all round; empty without samples
[[nodiscard]] Ring footprint(const GridRecord& record, const Sector& sector, const Placement& placement);

/// The cells of a mask seen from above, one ring for each beam and each connected interval of level range. The cells of
/// all fans of a beam are united first: they overlap from above. Rings of neighbouring beams overlap by a hair (0.002
/// degrees), so that their union has no slits. Where roll or pitch turns the beams, each row of cells has rings of its own,
/// within 0.03 % of the range for each 3 degrees of azimuth.
/// placement  heading, roll, pitch and rays, as levelled() takes them
/// out        x east, y north about the transducer, m
[[nodiscard]] std::vector<Ring> mask_rings(const Sector& sector, const PingMask& mask, const Placement& placement);

/// Where one ping's plane lies in the plane of another place: turned by the meridians' convergence, then shifted.
/// Good to 1e-6 of the distance over tens of kilometres.
class PlaneShift {
 public:
  PlaneShift(const Geographic& ping, const Geographic& origin);
  [[nodiscard]] PlanePoint apply(const PlanePoint& p) const;
  /// The other way.
  [[nodiscard]] PlanePoint back(const PlanePoint& p) const;

 private:
  PlanePoint shift_;
  double sine_ = 0.0;
  double cosine_ = 1.0;
};

}  // namespace sonar
