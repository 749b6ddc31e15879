// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/school_curves.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/units.h"

namespace sonar {
namespace {

double mean_db_of(double sum, double volume) {
  return sum > 0.0 && volume > 0.0 ? db_from_linear(sum / volume) : kUnknown;
}

std::int16_t count_at(const Volume& filtered, const VoxelIndex& at) {
  return filtered.counts.view().row(at.row)[static_cast<std::size_t>(at.sample)];
}

PingMask grown(const GrowthStart& start, const Volume& filtered, const GrowLimits& limits, double tolerance_db) {
  PingMask out;
  for (const VoxelIndex& seed : start.seeds) {
    const MemberTable members = MemberTable::one_sided(db_from_counts(count_at(filtered, seed)), tolerance_db);
    out = unite(out, grow(filtered.counts.view(), filtered.flags.view(), members, std::span(&seed, 1), limits));
  }
  return out;
}

}  // namespace

void SvHistogram::add(const PingMask& mask, const StagedPing& ping, const Sector& sector) {
  const auto sv = ping.sv.counts.view();
  const auto flags = ping.sv.flags.view();
  for (const Run& run : mask.runs) {
    const RowBackground background(ping.background(), run.row);
    const double solid_angle = sector.solid_angle_sr(run.row / sector.beams(), run.row % sector.beams());
    for (int s = run.first_sample; s < run.end(); ++s) {
      const auto i = static_cast<std::size_t>(s);
      const std::int16_t count = sv.row(run.row)[i];
      if (is_faulty(flags.row(run.row)[i], count)) continue;
      const double volume = solid_angle * sector.shell_m3_per_sr(s);
      volume_m3[static_cast<int>(std::floor(db_from_counts(count)))] += volume;
      heard_m3 += volume;
      sv_m2 += volume * linear_from_count(count);
      background_m2 += volume * background(s);
    }
  }
}

void SvHistogram::add(const SvHistogram& more) {
  for (const auto& [bin, volume] : more.volume_m3) volume_m3[bin] += volume;
  heard_m3 += more.heard_m3;
  sv_m2 += more.sv_m2;
  background_m2 += more.background_m2;
}

double SvHistogram::share(int bin) const {
  const auto found = volume_m3.find(bin);
  return found == volume_m3.end() || !(heard_m3 > 0.0) ? 0.0 : found->second / heard_m3;
}

double SvHistogram::mean_db() const { return mean_db_of(sv_m2, heard_m3); }
double SvHistogram::background_db() const { return mean_db_of(background_m2, heard_m3); }

std::optional<GrowthStart> start_at_strongest(const PingMask& mask, double threshold_db, const Volume& filtered,
                                              const GrowParams& rules) {
  VoxelIndex strongest;
  std::int16_t most = kNoData;
  for (const Run& run : mask.runs) {
    for (int s = run.first_sample; s < run.end(); ++s) {
      const std::int16_t count = count_at(filtered, {run.row, s});
      if (count <= most) continue;
      most = count;
      strongest = {run.row, s};
    }
  }
  const double tolerance_db = most == kNoData ? kUnknown : db_from_counts(most) - threshold_db;
  if (!(tolerance_db > 0.0)) return std::nullopt;
  return GrowthStart{{strongest}, tolerance_db, rules.margin_db, rules.connectivity};
}

Result<std::vector<GrownSize>> growth_sensitivity(const GrowthStart& start, const StagedPing& ping,
                                                  const FilteredPing& filtered, const PingMask& taken,
                                                  const Sector& sector, std::span<const double> changes_db,
                                                  const std::function<bool()>& go_on) {
  GrowLimits limits;
  limits.connectivity = start.connectivity;
  PingMask inside;
  if (start.margin_db > 0.0 && filtered.above_background) {
    inside.runs = filtered.above_background(start.margin_db, Above::noise);
    limits.inside = &inside;
  }
  std::vector<GrownSize> out;
  for (const double change_db : changes_db) {
    if (!go_on()) return fail(ErrorCode::cancelled, "growing again was stopped");
    const double tolerance_db = start.tolerance_db + change_db;
    const PingMask mask = subtract(grown(start, *filtered.volume, limits, tolerance_db), taken);
    out.push_back({change_db, tolerance_db, echo_of(mask, ping, sector)});
  }
  return out;
}

std::optional<std::pair<double, double>> plateau(std::span<const GrownSize> sizes, double within_db) {
  const auto used = std::find_if(sizes.begin(), sizes.end(), [](const GrownSize& one) { return one.change_db == 0.0; });
  if (used == sizes.end() || !(used->echo.backscatter_m2 > 0.0)) return std::nullopt;
  const auto leaves = [&](const GrownSize& one) {
    const double ratio = one.echo.backscatter_m2 / used->echo.backscatter_m2;
    return !(ratio > 0.0) || std::abs(db_from_linear(ratio)) > within_db;
  };
  const auto last = std::find_if(used, sizes.end(), leaves) - 1;
  auto first = used;
  while (first != sizes.begin() && !leaves(*(first - 1))) --first;
  return std::pair{first->change_db, last->change_db};
}

}  // namespace sonar
