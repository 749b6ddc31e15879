// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/voxel_statistics.h"

#include <algorithm>

#include "base/units.h"
#include "school/mask_shape.h"
#include "school/measure/extinction.h"

namespace sonar {

namespace {

MeasureInput input_of(const StagedPing& ping, const Sector& sector) {
  MeasureInput input;
  input.sv = ping.sv.counts.view();
  input.flags = ping.sv.flags.view();
  input.sector = &sector;
  input.background = ping.background();
  return input;
}

}  // namespace

EchoStatistics echo_of(const PingMask& mask, const StagedPing& ping, const Sector& sector) {
  return echo_statistics(input_of(ping, sector), mask);
}

std::vector<int> shadow_from(const StagedPing& ping, const Sector& sector, std::span<const PingMask* const> masks,
                             const ExtinctionParams& params, double least_db) {
  MeasureInput input = input_of(ping, sector);
  input.filtered = ping.filtered->counts.view();
  std::vector<int> from;
  for (const BeamGain& beam : ping_gain(input, masks, params.ratio, params.most_db)) {
    const double least = linear_from_db(least_db);
    const auto first = std::ranges::find_if(beam.behind, [&](double gain) { return gain >= least; });
    from.push_back(first == beam.behind.end() ? sector.range().count : static_cast<int>(first - beam.behind.begin()));
  }
  return from;
}

VoxelStatistics statistics_of(const PingMask& mask, const StagedPing& ping, const Sector& sector,
                              const Placement& placement) {
  VoxelStatistics out;
  out.echo = echo_of(mask, ping, sector);
  if (!mask.empty()) out.extents = mask_extents(mask, shape_of(mask, sector).covariance, sector, placement);
  return out;
}

}  // namespace sonar
