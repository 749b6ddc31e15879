// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/voxel_statistics.h"

#include "school/mask_shape.h"

namespace sonar {

EchoStatistics echo_of(const PingMask& mask, const StagedPing& ping, const Sector& sector) {
  MeasureInput input;
  input.sv = ping.sv.counts.view();
  input.flags = ping.sv.flags.view();
  input.sector = &sector;
  input.background = ping.background();
  return echo_statistics(input, mask);
}

VoxelStatistics statistics_of(const PingMask& mask, const StagedPing& ping, const Sector& sector,
                              const Placement& placement) {
  VoxelStatistics out;
  out.echo = echo_of(mask, ping, sector);
  if (!mask.empty()) out.extents = mask_extents(mask, shape_of(mask, sector).covariance, sector, placement);
  return out;
}

}  // namespace sonar
