// SPDX-License-Identifier: Apache-2.0
#include "sonar_explorer/survey.h"

#include <fmt/format.h>

#include <span>
#include <utility>

#include "api/implementation.h"
#include "api/running_work.h"
#include "api/throwing.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/stages/load_volume.h"
#include "pipeline/stages/observe.h"

namespace sonar_explorer {

sonar::Engine& Observation::State::engine_or_throw() {
  if (!engine) {
    raise({sonar::ErrorCode::usage, files->name + ": its beams make no grid of fans and beams", {}});
  }
  return *engine;
}

const std::string& Observation::name() const { return state_->files->name; }

std::string Observation::sounder() const { return sonar::source_of(*state_->files); }

std::vector<std::string> Observation::files() const {
  std::vector<std::string> names;
  for (const std::uint32_t f : state_->files->files) names.push_back(state_->survey->files[f].path.filename().string());
  return names;
}

std::size_t Observation::pings() const { return state_->files->pings.size(); }

std::vector<PingPlace> Observation::places() const {
  std::vector<PingPlace> places;
  for (const sonar::PingNavigation& at : state_->files->navigation) {
    places.push_back({at.time, at.transducer.latitude_deg, at.transducer.longitude_deg, at.heading_deg, at.speed_mps,
                      at.pitch_deg, at.roll_deg, at.transducer_depth_m, at.bad});
  }
  return places;
}

std::optional<Grid> Observation::grid() const {
  if (!state_->engine) return std::nullopt;
  const sonar::BeamGrid& own = state_->engine->grid();
  Grid grid{own.elevation_deg, own.azimuth_deg, own.frequency_hz, {}, own.channel};
  const sonar::RangeAxis& range = state_->files->range;
  for (int i = 0; i < range.count; ++i) grid.range_m.push_back(range.range_m(i));
  return grid;
}

std::vector<double> Observation::cell_volumes_m3() const {
  std::vector<double> volumes;
  if (!state_->engine) return volumes;
  const sonar::Sector& sector = state_->engine->sector();
  for (int fan = 0; fan < sector.fans(); ++fan) {
    for (int beam = 0; beam < sector.beams(); ++beam) {
      const double solid_angle = sector.solid_angle_sr(fan, beam);
      for (int s = 0; s < sector.range().count; ++s) volumes.push_back(solid_angle * sector.shell_m3_per_sr(s));
    }
  }
  return volumes;
}

Ping Observation::ping(std::int64_t index) const {
  sonar::Engine& engine = state_->engine_or_throw();
  require_ping(index, pings(), name());
  {
    const std::scoped_lock lock(state_->estimating);
    RunningWork running(1);
    value_or_throw(engine.estimate_background(index, index, running.work()));
  }
  auto power = value_or_throw(sonar::load_volume(*state_->survey, *state_->files, static_cast<std::size_t>(index)));
  auto arrays = std::make_shared<Ping::Arrays>(
      Ping::Arrays{std::move(power.volume.counts), value_or_throw(engine.staged(index))});
  return Ping(std::move(arrays));
}

Survey Survey::open(const std::vector<std::filesystem::path>& paths, const Recipe& recipe, int threads) {
  if (paths.empty() || threads < 0) {
    raise({sonar::ErrorCode::usage,
           paths.empty() ? "no path: expected files or folders" : "threads must not be negative",
           {}});
  }
  RunningWork running(threads);
  auto files = std::make_shared<sonar::SurveyFiles>(value_or_throw(sonar::open_survey(
      paths, recipe.own().survey, recipe.own().navigation, sonar::IndexCache::of_user(), running.work())));
  value_or_throw(sonar::require_files(*files, paths));
  Survey survey;
  for (const sonar::ObservationFiles& observation : files->observations) {
    auto state = std::make_shared<Observation::State>();
    state->survey = files;
    state->files = &observation;
    state->recipe = recipe;
    state->threads = threads;
    if (observation.grid) state->engine.emplace(*files, observation, recipe.own());
    survey.observations_.emplace_back(std::move(state));
  }
  survey.notes_ = lines_of(files->diagnostics);
  return survey;
}

const Observation& Survey::observation(const std::string& name) const {
  for (const Observation& one : observations_) {
    if (one.name() == name) return one;
  }
  raise({sonar::ErrorCode::usage, fmt::format("no observation {} in this survey", name), {}});
}

Shape Ping::shape() const {
  const sonar::Shape3& own = arrays_->power.shape();
  return {own.fans, own.beams, own.samples};
}
std::span<const std::int16_t> Ping::power() const { return arrays_->power.all(); }
std::span<const std::int16_t> Ping::sv() const { return arrays_->staged.sv.counts.all(); }
std::span<const std::int16_t> Ping::sv_filtered() const {
  return std::as_const(arrays_->staged.filtered->counts).all();
}
std::span<const std::uint8_t> Ping::flags() const {
  const auto flags = arrays_->staged.sv.flags.all();
  return {reinterpret_cast<const std::uint8_t*>(flags.data()), flags.size()};
}
std::span<const double> Ping::background_power_db() const { return arrays_->staged.background_db; }

}  // namespace sonar_explorer
