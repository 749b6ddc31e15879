// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geo/frames.h"
#include "geo/sector.h"
#include "model/mask.h"
#include "pipeline/stages/engine.h"
#include "school/measure/echo_statistics.h"

namespace sonar {

/// What any set of voxels of a ping echoes and spans: the sums that a school of these voxels has in its tables.
struct VoxelStatistics {
  EchoStatistics echo;
  MaskExtents extents;  ///< unknown of no voxel
  friend bool operator==(const VoxelStatistics&, const VoxelStatistics&) = default;
};

/// Of the unfiltered Sv, the expected background taken off.
/// threads  pure
/// cost     linear in the mask's voxels
[[nodiscard]] EchoStatistics echo_of(const PingMask& mask, const StagedPing& ping, const Sector& sector);
/// placement  of the ping: depths below the water line, the axis by its heading
[[nodiscard]] VoxelStatistics statistics_of(const PingMask& mask, const StagedPing& ping, const Sector& sector,
                                            const Placement& placement);

}  // namespace sonar
