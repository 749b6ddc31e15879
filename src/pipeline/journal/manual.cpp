// SPDX-License-Identifier: Apache-2.0
#include "pipeline/journal/manual.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "pipeline/commands/state.h"
#include "school/grow/propagate_tracked.h"

namespace sonar {
namespace {

PingReach reach_round(std::int64_t ping_index, const PropagateCommand& command, PingReach limits) {
  const std::int64_t back = command.reach_backward.value_or(command.reach);
  const std::int64_t forward = command.reach_forward.value_or(command.reach);
  return {back < 0 ? limits.first : std::max(limits.first, ping_index - back),
          forward < 0 ? limits.last : std::min(limits.last, ping_index + forward)};
}

/// What carried out without an observer gives the same; a side that came to its own end keeps its reach.
PropagateCommand reached_by(const PropagateCommand& command, std::int64_t clicked, const Propagation& propagation) {
  if (!propagation.stopped_at) return command;
  const std::int64_t stop = *propagation.stopped_at;
  if (stop < clicked) return as_far_as(command, clicked - stop, 0);
  return as_far_as(command, command.reach_backward.value_or(command.reach), stop - clicked);
}

SchoolMasks school_of(Propagation& propagation) {
  SchoolMasks school;
  school.decided.origin = "manual";
  for (PropagatedPing& ping : propagation.pings) {
    if (!ping.mask.empty()) school.pings.push_back({ping.ping_index, std::move(ping.mask), ping.threshold_db});
  }
  return school;
}

}  // namespace

PropagateCommand recipe_propagation(const Recipe& recipe, std::optional<GrowMode> mode) {
  PropagateCommand command;
  command.mode = mode.value_or(recipe.grow.mode);
  command.grow = recipe.grow;
  command.grow.mode = command.mode;
  command.paper = recipe.propagate_paper;
  command.tracked = recipe.propagate_tracked;
  command.growth_curve = recipe.growth_curve;
  return command;
}

Result<PropagateCommand> completed(PropagateCommand command) {
  if (command.grow.connectivity == Connectivity::all) {
    command.paper.connectivity = command.tracked.connectivity = Connectivity::all;
  }
  for (const auto& valid : {validate(command.grow), validate(command.tracked), validate(command.paper)}) {
    if (!valid) return pass_on(valid);
  }
  return command;
}

bool goes_backward(const PropagateCommand& command) { return command.reach_backward.value_or(command.reach) != 0; }
bool goes_forward(const PropagateCommand& command) { return command.reach_forward.value_or(command.reach) != 0; }

PropagateCommand as_far_as(PropagateCommand command, std::int64_t backward, std::int64_t forward) {
  command.reach_backward = backward;
  command.reach_forward = forward;
  return command;
}

namespace {

/// Ends that only the reach made: nothing else ended it there, and there are more pings.
void mark_ends(ManualSchool& made, std::int64_t ping_index, PingReach limits) {
  const auto& pings = made.school.pings;
  // One that was stopped has the reach that it came to.
  const PingReach asked = reach_round(ping_index, made.reached, limits);
  if (goes_backward(made.reached) && made.note_backward.empty() && asked.first > limits.first) {
    made.school.reach.first = pings.front().ping_index;
  }
  if (goes_forward(made.reached) && made.note_forward.empty() && asked.last < limits.last) {
    made.school.reach.last = pings.back().ping_index;
  }
}

}  // namespace

CommandContext context_of(Engine& engine, PingReach limits) {
  CommandContext context;
  context.ping = [&engine](std::int64_t ping_index) { return engine.filtered(ping_index); };
  context.sector = &engine.sector();
  context.grid = &engine.grid();
  for (const SurveyPing& ping : engine.observation().pings) context.times.push_back(engine.survey().entry(ping).time);
  context.limits = limits;
  const Recipe& recipe = engine.recipe();
  context.least_pings = names_judge(recipe.detect.left_out, "confirmation") ? 1 : recipe.track.confirmation.pings;
  return context;
}

Result<PingMask> grow_seeds(const CommandContext& context, const FilteredPing& ping, std::span<const SeedKey> seeds,
                            const TransferFunction& growth_curve, const GrowParams& params) {
  if (ping.bad) return fail(ErrorCode::bad_parameter, "the ping was made without transmitting; it shows no school");
  const std::vector<int> rows = context.grid->row_of_channel();
  // The paper grows on opacity alone.
  const bool limited = params.mode == GrowMode::tracked && params.margin_db > 0.0 && ping.above_background;
  PingMask inside;
  // What a human points at may be the water itself, as a layer is: it has to stand above the noise alone.
  if (limited) inside.runs = ping.above_background(params.margin_db, Above::noise);
  PingMask selection;
  for (const SeedKey& seed : seeds) {
    if (seed.channel < 0 || static_cast<std::size_t>(seed.channel) >= rows.size() ||
        rows[static_cast<std::size_t>(seed.channel)] < 0) {
      return fail(ErrorCode::bad_parameter, fmt::format("there is no channel {}", seed.channel));
    }
    auto grown = grow_from_click(ping.volume->counts.view(), ping.volume->flags.view(),
                                 {rows[static_cast<std::size_t>(seed.channel)], seed.sample}, growth_curve, params,
                                 limited ? &inside : nullptr);
    if (!grown) return grown;
    selection = unite(selection, *grown);
  }
  return subtract(selection, ping.taken);
}

Result<ManualSchool> carry(const CommandContext& context, std::int64_t ping_index, const PingMask& selection,
                           const PropagateCommand& command, const TakenVoxels& taken) {
  const PingProvider provider = [&](std::int64_t i) {
    auto ping = context.ping(i);
    if (ping) ping->taken = taken(i);
    return ping;
  };
  const PingReach reach = reach_round(ping_index, command, context.limits);
  auto propagation = command.mode == GrowMode::paper
                         ? propagate_paper(provider, ping_index, selection, reach, command.growth_curve, command.paper,
                                           context.on_step)
                         : propagate_tracked(provider, *context.sector, ping_index, selection, reach, command.tracked,
                                             context.on_step);
  if (!propagation) return pass_on(propagation);
  ManualSchool made;
  made.reached = reached_by(command, ping_index, *propagation);
  made.school = school_of(*propagation);
  made.note_backward = propagation->note_backward;
  made.note_forward = propagation->note_forward;
  mark_ends(made, ping_index, context.limits);
  return made;
}

std::vector<SchoolMasks> replay(Engine& engine, std::span<const JournalLine> lines, PingReach limits,
                                Diagnostics& diagnostics) {
  const JournalState state = fold(lines, {}, context_of(engine, limits));
  diagnostics.insert(diagnostics.end(), state.notes.begin(), state.notes.end());
  return masks_of(state);
}

std::optional<std::int64_t> ping_at(const SurveyFiles& survey, const ObservationFiles& observation, TimeNs time) {
  const auto found =
      std::lower_bound(observation.pings.begin(), observation.pings.end(), time,
                       [&](const SurveyPing& ping, TimeNs wanted) { return survey.entry(ping).time < wanted; });
  if (found == observation.pings.end() || survey.entry(*found).time != time) return std::nullopt;
  return found - observation.pings.begin();
}

}  // namespace sonar
