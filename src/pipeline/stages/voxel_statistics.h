// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "geo/frames.h"
#include "geo/sector.h"
#include "model/extinction_params.h"
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

/// The same with what schools took out of the beams given back, as schools are measured where the recipe corrects for it.
/// schools  of the ping
[[nodiscard]] VoxelStatistics corrected_statistics_of(const PingMask& mask, const StagedPing& ping,
                                                      const Sector& sector, const Placement& placement,
                                                      std::span<const PingMask* const> schools,
                                                      const ExtinctionParams& extinction);

/// What schools have taken of what is heard of each sample, as a factor >= 1 of sv that does not fall along a beam. [row]
/// [sample]; empty = nothing of that beam.
/// masks  of the schools that take sound out
[[nodiscard]] std::vector<std::vector<double>> shadow_of(const StagedPing& ping, const Sector& sector,
                                                         std::span<const PingMask* const> masks,
                                                         const ExtinctionParams& params);

/// Where what is heard of a beam lies in the shadow of schools: from that sample on, 2-way loss of least_db or more; no
/// sample = the record's end. [row]
/// masks  as shadow_of()
[[nodiscard]] std::vector<int> shadow_from(const StagedPing& ping, const Sector& sector,
                                           std::span<const PingMask* const> masks, const ExtinctionParams& params,
                                           double least_db);

}  // namespace sonar
