// SPDX-License-Identifier: Apache-2.0
#include "pipeline/journal/state_product.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "pipeline/journal/continued.h"
#include "pipeline/stages/observe.h"
#include "pipeline/stages/refused_echoes.h"
#include "pipeline/tasks/join_tracks.h"

namespace sonar {
namespace {

bool same_figures(const FigureValues& a, const FigureValues& b) {
  return std::equal(a.begin(), a.end(), b.begin(),
                    [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

/// The state's schools, each under the state's number.
std::vector<SchoolMasks> numbered_as_shown(const Engine& engine, JournalState state) {
  for (auto& school : state.schools) {
    auto copy = std::make_shared<StateSchool>(*school);
    copy->masks.decided.school_id = copy->number;
    school = std::move(copy);
  }
  std::vector<SchoolMasks> schools = measured_masks_of(state, datagram_times(engine.survey(), engine.observation()));
  name_parts(schools, engine.observation().name);
  return schools;
}

std::string hash_of(const CalibrationParams& calibration) {
  Recipe recipe;
  recipe.calibration = calibration;
  return recipe_hash(recipe);
}

/// Figures follow the calibration; of a recipe that cannot be read it is taken for the same.
bool measured_under(const ObservationProduct& product, const CalibrationParams& calibration) {
  const auto recipe = recipe_from_text(product.recipe_json);
  return !recipe || hash_of(recipe->calibration) == hash_of(calibration);
}

/// By school and ping.
template <class Row>
std::map<std::pair<std::int64_t, std::int64_t>, const Row*> by_school_and_ping(const std::vector<Row>& rows) {
  std::map<std::pair<std::int64_t, std::int64_t>, const Row*> found;
  for (const Row& row : rows) found[{row.school_id, row.ping_index}] = &row;
  return found;
}

/// What the tracker noted stays in its place, under the schools that have its voxels now.
void follow_events(const ObservationProduct& measured, std::span<const SchoolMasks> schools,
                   ObservationProduct& product) {
  const auto is_event = [](const Diagnostic& note) { return note.code == DiagnosticCode::track_event; };
  const auto at = std::ranges::find_if(product.diagnostics, is_event) - product.diagnostics.begin();
  std::erase_if(product.diagnostics, is_event);
  const auto placed = placed_events(noted_events(measured), detected_schools(measured));
  const Diagnostics events = event_notes(events_now(placed, schools));
  product.diagnostics.insert(product.diagnostics.begin() + at, events.begin(), events.end());
}

}  // namespace

ObservationProduct state_product_of_results(const Engine& engine, const JournalState& state,
                                            const ObservationProduct& measured) {
  const auto masks = by_school_and_ping(measured.masks);
  auto rows = by_school_and_ping(measured.school_pings);
  if (!measured_under(measured, engine.recipe().calibration)) rows.clear();
  ObservationProduct product = measured;
  product.input_hash.clear();
  product.schools.clear();
  product.school_pings.clear();
  product.masks.clear();
  product.diagnostics.insert(product.diagnostics.end(), state.notes.begin(), state.notes.end());
  product.next_school_id = state.next_number;
  product.rejected = still_refused(measured.rejected, state, engine.grid());
  const std::vector<TimeNs> times = datagram_times(engine.survey(), engine.observation());
  for (std::size_t i = 0; i < times.size(); ++i) product.pings[i].bad = product.pings[i].bad || is_bad(state, times[i]);
  std::vector<SchoolMasks> schools = numbered_as_shown(engine, state);
  std::ranges::sort(schools, {}, [](const SchoolMasks& school) { return school.decided.school_id; });
  follow_events(measured, schools, product);
  for (const SchoolMasks& school : schools) {
    for (const SchoolMasks::InPing& in_ping : school.pings) {
      const std::pair key(school.track_id, in_ping.ping_index);
      const auto mask = masks.find(key);
      const auto row = rows.find(key);
      const bool same = mask != masks.end() && mask->second->mask == in_ping.mask;
      const std::int64_t number = school.decided.school_id;
      product.masks.push_back(
          {number, in_ping.ping_index, in_ping.mask, same ? mask->second->fault : std::vector<bool>{}});
      if (!same || row == rows.end()) continue;
      product.school_pings.push_back(*row->second);
      product.school_pings.back().school_id = number;
    }
  }
  summarise_schools(schools, engine.recipe(), product);
  // Standard errors need the pings: those of a school that is as it was measured still hold.
  for (SchoolRow& school : product.schools) {
    for (const SchoolRow& before : measured.schools) {
      if (before.school_id == school.school_id && same_figures(figures_of(before), figures_of(school)))
        school.se = before.se;
    }
  }
  join_at_reach(product, engine.recipe().merge);
  return product;
}

Result<ObservationProduct> state_product(Engine& engine, const JournalState& state, const StateProductOptions& options,
                                         Work& work) {
  ObservationProduct product = empty_product(engine.survey(), engine.observation(), engine.recipe(),
                                             {{}, options.journal, options.program_version});
  product.diagnostics.insert(product.diagnostics.end(), state.notes.begin(), state.notes.end());
  for (Diagnostic& note : engine.calibration_notes()) product.diagnostics.push_back(std::move(note));
  if (options.background) {
    const std::int64_t pings = engine.pings();
    if (auto done = engine.estimate_background(0, pings - 1, work); !done) return pass_on(done);
    for (std::int64_t i = 0; i < pings; ++i) product.background_db.push_back(engine.background_db(i));
  }
  product.next_school_id = state.next_number;
  product.rejected = still_refused({options.refused.begin(), options.refused.end()}, state, engine.grid());
  std::vector<SchoolMasks> schools = numbered_as_shown(engine, state);
  const Diagnostics events = event_notes(events_now(options.events, schools));
  product.diagnostics.insert(product.diagnostics.end(), events.begin(), events.end());
  if (auto done = measure_schools(engine, std::move(schools), product, work, options.before); !done) {
    return pass_on(done);
  }
  join_at_reach(product, engine.recipe().merge);
  return product;
}

std::vector<std::int64_t> pings_to_measure(const Engine& engine, const JournalState& state,
                                           const MeasuredPings& before) {
  return pings_to_measure(engine, numbered_as_shown(engine, state), before);
}

std::vector<SchoolMasks> detected_schools(const ObservationProduct& product) {
  std::vector<SchoolMasks> schools;
  for (const SchoolRow& row : product.schools) {
    SchoolMasks school;
    school.track_id = row.school_id;
    school.decided.school_id = row.school_id;
    for (const SchoolMask& mask : product.masks) {
      if (mask.school_id != row.school_id) continue;
      const auto of_ping = std::find_if(product.school_pings.begin(), product.school_pings.end(), [&](const auto& r) {
        return r.school_id == row.school_id && r.ping_index == mask.ping_index;
      });
      school.pings.push_back(
          {mask.ping_index, mask.mask, of_ping == product.school_pings.end() ? kUnknown : of_ping->threshold_db});
    }
    schools.push_back(std::move(school));
  }
  return schools;
}

std::vector<SchoolMasks> decided_schools(const ObservationProduct& product) {
  std::vector<SchoolMasks> schools = detected_schools(product);
  for (std::size_t i = 0; i < schools.size(); ++i) schools[i].decided = product.schools[i];
  return schools;
}

}  // namespace sonar
