// SPDX-License-Identifier: Apache-2.0
#include "sonar_explorer/schools.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "api/implementation.h"
#include "api/running_work.h"
#include "api/throwing.h"
#include "pipeline/commands/command.h"
#include "pipeline/journal/journal.h"
#include "pipeline/journal/manual.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/stages/observe.h"
#include "sonar_explorer/version.h"

namespace sonar_explorer {
namespace {

Product shared(sonar::ObservationProduct product) {
  return Product(std::make_shared<const sonar::ObservationProduct>(std::move(product)));
}

sonar::PropagateCommand command_of(Observation::State& state, std::int64_t ping, const std::vector<Seed>& seeds,
                                   const GrowOptions& options) {
  const sonar::Recipe& recipe = state.recipe.own();
  const sonar::BeamGrid& grid = state.engine_or_throw().grid();
  const auto wrong = [](std::string text) { raise({sonar::ErrorCode::bad_parameter, std::move(text), {}}); };
  require_ping(ping, state.files->pings.size(), state.files->name);
  if (seeds.empty()) wrong("no seed is given");
  if (options.mode && *options.mode != "tracked" && *options.mode != "paper") {
    wrong(fmt::format("mode '{}' is none of tracked, paper", *options.mode));
  }
  std::optional<sonar::GrowMode> mode;
  if (options.mode) mode = *options.mode == "paper" ? sonar::GrowMode::paper : sonar::GrowMode::tracked;
  sonar::PropagateCommand command = sonar::recipe_propagation(recipe, mode);
  const bool paper = command.mode == sonar::GrowMode::paper;
  if (paper && options.tolerance_db) wrong("tolerance_db is of mode tracked; expected tolerance_opacity in mode paper");
  if (!paper && options.tolerance_opacity) {
    wrong("tolerance_opacity is of mode paper; expected tolerance_db in mode tracked");
  }
  if (options.tolerance_db) command.grow.tolerance_db = command.tracked.tolerance_db = *options.tolerance_db;
  if (options.tolerance_opacity) command.grow.tolerance_opacity = *options.tolerance_opacity;
  command = value_or_throw(sonar::completed(std::move(command)));
  for (const Seed& seed : seeds) {
    if (seed.fan < 0 || seed.fan >= grid.fans() || seed.beam < 0 || seed.beam >= grid.beams() || seed.sample < 0 ||
        seed.sample >= state.files->range.count) {
      wrong(fmt::format("seed {}, {}, {}: the grid has {} fans, {} beams, {} samples", seed.fan, seed.beam, seed.sample,
                        grid.fans(), grid.beams(), state.files->range.count));
    }
    command.seeds.push_back({grid.channel[static_cast<std::size_t>(seed.fan * grid.beams() + seed.beam)], seed.sample});
  }
  return command;
}

/// What a journal with this one line makes of the observation, nothing detected.
Product selected(Observation::State& state, std::int64_t ping, const sonar::PropagateCommand& command) {
  sonar::Recipe recipe = state.recipe.own();
  recipe.automatic = false;
  const sonar::TimeNs time = state.survey->ping_time(*state.files, static_cast<std::size_t>(ping));
  const std::vector<sonar::JournalLine> lines{sonar::line_of({1, 0, {}, time, command})};
  RunningWork running(state.threads);
  auto product =
      value_or_throw(sonar::observe(*state.survey, *state.files, recipe, {{}, lines, version()}, running.work()));
  for (const sonar::Diagnostic& note : product.diagnostics) {
    if (note.code != sonar::DiagnosticCode::decision_lost) continue;
    // That a selection is a line of a journal is no matter of the caller's.
    const std::string said = sonar::said_of(lines.front());
    const std::string why = note.text.starts_with(said) ? note.text.substr(said.size()) : note.text;
    raise({sonar::ErrorCode::bad_parameter, why, {"", -1, note.ping_index}});
  }
  return shared(std::move(product));
}

}  // namespace

Product detect(const Observation& observation) {
  Observation::State& state = observation.state();
  (void)state.engine_or_throw();
  sonar::Recipe recipe = state.recipe.own();
  recipe.automatic = true;  // it is what is asked for
  RunningWork running(state.threads);
  return shared(
      value_or_throw(sonar::observe(*state.survey, *state.files, recipe, {{}, {}, version()}, running.work())));
}

Product grow(const Observation& observation, std::int64_t ping, const std::vector<Seed>& seeds,
             const GrowOptions& options) {
  return propagate(observation, ping, seeds, 0, options);
}

Product propagate(const Observation& observation, std::int64_t ping, const std::vector<Seed>& seeds, std::int64_t reach,
                  const GrowOptions& options) {
  sonar::PropagateCommand command = command_of(observation.state(), ping, seeds, options);
  command.reach = reach < 0 ? -1 : reach;
  return selected(observation.state(), ping, command);
}

Product measure(const Observation& observation, const Product& product) {
  Observation::State& state = observation.state();
  RunningWork running(state.threads);
  return shared(value_or_throw(sonar::remeasure(*state.survey, *state.files, product.own(), state.recipe.own(),
                                                {{}, {}, version()}, running.work())));
}

}  // namespace sonar_explorer
