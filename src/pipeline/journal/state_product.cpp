// SPDX-License-Identifier: Apache-2.0
#include "pipeline/journal/state_product.h"

#include <algorithm>
#include <utility>

#include "pipeline/journal/continued.h"
#include "pipeline/stages/observe.h"
#include "pipeline/stages/refused_echoes.h"
#include "pipeline/tasks/join_tracks.h"

namespace sonar {
namespace {

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

}  // namespace

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

}  // namespace sonar
