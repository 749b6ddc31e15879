// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/array.h"
#include "base/sample_flags.h"
#include "geo/sector.h"
#include "model/mask.h"

namespace sonar {

/// Where a mask is cut off.
struct MaskEdges {
  std::int32_t flags = 0;          ///< EdgeFlags of model/school.h
  double edge_fraction = 0.0;      ///< share of outer faces at kTouchesEdge edges
  double boundary_fraction = 0.0;  ///< share of outer faces at surface or near field
  double seabed_fraction = 0.0;    ///< share of outer faces at the seabed's margin
};

/// Looks at the six faces of each member: the sector's borders (rows that are cropped whole count as absent), and the
/// flags of the voxel beyond. Fore is the border whose beam looks most forward.
/// cost  linear in voxels
[[nodiscard]] MaskEdges mask_edges(const PingMask& mask, View3<const SampleFlags> flags, const Sector& sector);

}  // namespace sonar
