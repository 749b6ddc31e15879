// SPDX-License-Identifier: Apache-2.0
#include "session/tools/growth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/number_text.h"
#include "base/units.h"
#include "pipeline/stages/voxel_statistics.h"

namespace sonar {
namespace {

/// Voxels that a growth leaves to the schools that humans made or accepted: of all but the one that it adds to.
PingMask taken_by_others(const GrowthTrial& trial, std::optional<std::size_t> but) {
  PingMask taken;
  if (!trial.state || trial.command.to == GrowTo::take_away) return taken;
  for (std::size_t i = 0; i < trial.state->schools.size(); ++i) {
    const StateSchool& school = *trial.state->schools[i];
    if (!keeps_its_voxels(school) || i == but) continue;
    if (const auto* there = in_ping(school.masks, trial.ping->ping_index)) taken = unite(taken, there->mask);
  }
  return taken;
}

}  // namespace

GrowParams grow_params(const SelectParams& params) {
  return {params.mode, params.connectivity, params.tolerance_db, params.tolerance_opacity, params.margin_db};
}

PropagateCommand propagation_as_set(const Workspace& workspace) {
  const SelectParams& select = workspace.select.values();
  const Recipe& recipe = workspace.document.recipe();
  PropagateCommand command;
  command.mode = select.mode;
  command.grow = grow_params(select);
  command.growth_curve = workspace.growth_curve();
  command.paper = recipe.propagate_paper;
  command.paper.connectivity = select.connectivity;
  command.tracked = recipe.propagate_tracked;
  command.tracked.tolerance_db = select.tolerance_db;
  command.tracked.connectivity = select.connectivity;
  command.reach = select.reach_pings;
  return command;
}

SeedKey seed_key(const OpenObservation& observation, const Voxel& voxel) {
  const auto row = static_cast<std::size_t>(voxel.fan * observation.grid().beams() + voxel.beam);
  return {observation.grid().channel[row], voxel.sample};
}

std::optional<SeedKey> best_seed(const PingMask& mask, const Volume& filtered, const BeamGrid& grid) {
  std::optional<SeedKey> best;
  std::int16_t loudest = kNoData;
  for (const Run& run : mask.runs) {
    const auto counts = filtered.counts.view().row(run.row);
    const auto flags = filtered.flags.view().row(run.row);
    for (int s = run.first_sample; s < run.end(); ++s) {
      const auto i = static_cast<std::size_t>(s);
      if (counts[i] <= loudest || any(flags[i] & kNeverMember)) continue;
      loudest = counts[i];
      best = SeedKey{grid.channel[static_cast<std::size_t>(run.row)], s};
    }
  }
  return best;
}

JournalStatePtr state_of(const Document& document, std::size_t observation) {
  const auto& states = document.choices().states;
  const auto found = states.find(observation);
  return found == states.end() ? nullptr : found->second;
}

std::optional<std::size_t> school_of_voxel(const JournalState& state, std::int64_t ping_index, const Sector& sector,
                                           const Voxel& voxel) {
  for (std::size_t i = 0; i < state.schools.size(); ++i) {
    const auto* there = in_ping(state.schools[i]->masks, ping_index);
    if (there != nullptr && confidence_at(there->mask, voxel.fan * sector.beams() + voxel.beam, voxel.sample) > 0) {
      return i;
    }
  }
  return std::nullopt;
}

std::string too_weak(const Volume& filtered, const BeamGrid& grid, const GrowCommand& command) {
  if (command.seeds.size() != 1) return {};
  const SeedKey& seed = command.seeds.front();
  const auto at = std::find(grid.channel.begin(), grid.channel.end(), seed.channel);
  const auto counts = filtered.counts.view();
  if (at == grid.channel.end()) return {};
  const auto row = counts.row(static_cast<int>(at - grid.channel.begin()));
  const auto sample = static_cast<std::size_t>(seed.sample);
  if (seed.sample < 0 || sample >= row.size() || row[sample] == kNoData) return {};
  if (any(filtered.flags.view().row(static_cast<int>(at - grid.channel.begin()))[sample] & kNeverMember)) return {};
  const double sv_db = db_from_counts(row[sample]);
  if (command.growth_curve.opacity(sv_db) > 0.0) return {};
  return fmt::format("too weak to grow from: the growth curve is 0 at {:.1f} dB", sv_db);
}

Result<PingMask> try_growth(const GrowthTrial& trial) {
  const CommandContext& context = trial.observation->context();
  std::optional<std::size_t> school;
  if (trial.command.school) {
    school = trial.state ? school_at(*trial.state, context, *trial.command.school) : std::nullopt;
    if (!school) return fail(ErrorCode::bad_parameter, "the selected school is no more");
  }
  FilteredPing ping = trial.observation->engine().filtered(*trial.ping);
  if (trial.observation->recalibrated()) {
    // What is tried is what the act will do, and that stands on the calibration of the choices.
    auto of_choices = context.ping(trial.ping->ping_index);
    if (!of_choices) return pass_on(of_choices);
    ping = std::move(*of_choices);
  }
  const bool needed = trial.command.to == GrowTo::take_away || trial.command.to == GrowTo::replace;
  const auto* there = needed ? in_ping(trial.state->schools[*school]->masks, trial.ping->ping_index) : nullptr;
  if (needed && there == nullptr) return fail(ErrorCode::bad_parameter, "the selected school is not in this ping");
  if (auto why = too_weak(*ping.volume, trial.observation->grid(), trial.command); !why.empty()) {
    return fail(ErrorCode::bad_parameter, std::move(why));
  }
  ping.taken = taken_by_others(trial, school);
  auto grown = grow_seeds(context, ping, trial.command.seeds, trial.command.growth_curve, trial.command.grow);
  if (!grown) return grown;
  if (grown->empty()) return fail(ErrorCode::bad_parameter, "all voxels there belong to other schools");
  if (trial.command.to != GrowTo::take_away) return grown;
  PingMask gone = subtract(there->mask, subtract(there->mask, *grown));
  if (gone.empty()) return fail(ErrorCode::bad_parameter, "the selected school has nothing there");
  return gone;
}

std::string growth_text(const PingMask& mask, const StagedPing& ping, const Sector& sector) {
  const EchoStatistics echo = echo_of(mask, ping, sector);
  std::string text =
      fmt::format("{} voxel{}, {:.3g} m\u00B3", grouped(mask.voxels()), mask.voxels() == 1 ? "" : "s", echo.volume_m3);
  if (!std::isnan(echo.sv_mean_db)) text += fmt::format(", mean Sv {:.1f} dB", echo.sv_mean_db);
  return text;
}

Preview preview_of(const GrowthTrial& trial) {
  Preview preview;
  preview.ping_index = trial.ping->ping_index;
  auto mask = try_growth(trial);
  if (!mask) {
    preview.text = mask.error().text;
    return preview;
  }
  preview.text = growth_text(*mask, *trial.ping, trial.observation->sector());
  preview.mask = std::make_shared<const PingMask>(std::move(*mask));
  return preview;
}

}  // namespace sonar
