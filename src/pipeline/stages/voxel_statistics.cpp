// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/voxel_statistics.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

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

PingGain gain_of(const StagedPing& ping, const Sector& sector, std::span<const PingMask* const> schools,
                 const ExtinctionParams& params) {
  MeasureInput input = input_of(ping, sector);
  input.filtered = ping.filtered->counts.view();
  return ping_gain(input, schools, params.ratio, params.most_db);
}

}  // namespace

EchoStatistics echo_of(const PingMask& mask, const StagedPing& ping, const Sector& sector) {
  return echo_statistics(input_of(ping, sector), mask);
}

std::vector<std::vector<double>> shadow_of(const StagedPing& ping, const Sector& sector,
                                           std::span<const PingMask* const> masks, const ExtinctionParams& params) {
  std::vector<std::vector<double>> out;
  for (BeamGain& beam : gain_of(ping, sector, masks, params)) {
    // Where less than the background is heard the sum falls a little.
    for (std::size_t s = 1; s < beam.behind.size(); ++s) beam.behind[s] = std::max(beam.behind[s], beam.behind[s - 1]);
    out.push_back(std::move(beam.behind));
  }
  return out;
}

std::vector<int> shadow_from(const StagedPing& ping, const Sector& sector, std::span<const PingMask* const> masks,
                             const ExtinctionParams& params, double least_db) {
  const double least = linear_from_db(least_db);
  std::vector<int> from;
  for (const std::vector<double>& beam : shadow_of(ping, sector, masks, params)) {
    const auto first = std::ranges::lower_bound(beam, least);
    from.push_back(first == beam.end() ? sector.range().count : static_cast<int>(first - beam.begin()));
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

VoxelStatistics corrected_statistics_of(const PingMask& mask, const StagedPing& ping, const Sector& sector,
                                        const Placement& placement, std::span<const PingMask* const> schools,
                                        const ExtinctionParams& extinction) {
  MeasureInput input = input_of(ping, sector);
  PingGain gain = gain_of(ping, sector, schools, extinction);
  // Only the mask's beams are asked for, and a pointer waits for them.
  PingGain of_mask(gain.size());
  for (const Run& run : mask.runs) {
    const auto row = static_cast<std::size_t>(run.row);
    if (of_mask[row].within.empty()) of_mask[row] = std::move(gain[row]);
  }
  const Array3<std::int16_t> sv = without_extinction(input.sv, input.background, of_mask, 1.0);
  VoxelStatistics out = statistics_of(mask, ping, sector, placement);
  input.sv = sv.view();
  out.echo = echo_statistics(input, mask);
  return out;
}

}  // namespace sonar
