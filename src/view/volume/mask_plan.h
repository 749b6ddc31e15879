// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "geo/frames.h"
#include "geo/sector.h"
#include "model/mask.h"

namespace sonar {

/// Where a mask is seen along each direction of one angular axis: a maximum projection (MIP) of its confidence along the
/// other. Seen from above a wedge is a beam and distances are level; seen from the side a wedge is a fan and distances
/// are slant ranges.
struct MaskWedge {
  double first_rad = 0.0;  ///< bounds of the wedge
  double last_rad = 0.0;
  std::int32_t first_bin = 0;      ///< bin i holds distances i * bin_m .. (i + 1) * bin_m
  std::vector<std::uint8_t> bins;  ///< largest confidence, 0 = none
};
struct MaskPlan {
  double bin_m = 1.0;
  std::vector<MaskWedge> wedges;  ///< those with a voxel, rising angles
};

/// From above: one wedge a beam, bounds clockwise from the bow, level distances from the transducer. Every cell covers
/// the level distances that it has anywhere within its elevation bounds.
[[nodiscard]] MaskPlan plan_from_above(const Sector& sector, const PingMask& mask, double bin_m);
/// From the side: one wedge a fan, bounds of elevation (positive up), slant ranges.
[[nodiscard]] MaskPlan plan_from_side(const Sector& sector, const PingMask& mask, double bin_m);

/// A raster's cells in the plane of a plan: cell (x, y) has its middle at origin + x * x_step + y * y_step, metres from
/// the transducer. From above: u to the bow, v to starboard (angles run from u to v). From the side: u outwards, v up.
struct PlanRaster {
  double origin_u = 0.0;
  double origin_v = 0.0;
  double x_step_u = 1.0;
  double x_step_v = 0.0;
  double y_step_u = 0.0;
  double y_step_v = 1.0;
  int width = 0;
  int height = 0;
};

/// Cells of a raster that a mask lights; outside the box nothing.
struct MaskPatch {
  int first_x = 0;
  int first_y = 0;
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> confidence;  ///< [height][width], 0 = none
  [[nodiscard]] bool empty() const { return confidence.empty(); }
};

/// The plan on a raster: each cell takes the bin under its middle, and each lit bin lights at least the cell of its own
/// middle, so that nothing is lost however coarse the raster.
[[nodiscard]] MaskPatch patch_of(const MaskPlan& plan, const PlanRaster& raster);

/// A mask from above on a raster where roll and pitch turn the beams or rays bend them, so that it has no plan: each cell
/// lies in the rings of mask_rings(), and each voxel lights at least the cell that its own middle, levelled(), lies in.
/// placement  its heading does not count: the raster's u points to the bow
[[nodiscard]] MaskPatch patch_from_above(const Sector& sector, const PingMask& mask, const Placement& placement,
                                         const PlanRaster& raster);

}  // namespace sonar
