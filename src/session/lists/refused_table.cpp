// SPDX-License-Identifier: Apache-2.0
#include "session/lists/refused_table.h"

#include <algorithm>

#include "session/lists/cells.h"
#include "session/review/refused_layer.h"

namespace sonar {
namespace {

template <double RefusedEcho::*member, int decimals>
Cell figure(const SurveyEcho& echo) {
  return number_cell(echo.sightings.loudest->*member, decimals);
}

template <std::int64_t RefusedEcho::*member>
Cell count(const SurveyEcho& echo) {
  return count_cell(echo.sightings.loudest->*member);
}

const std::vector<ColumnOf<SurveyEcho>>& refused_columns() {
  using E = SurveyEcho;
  using R = RefusedEcho;
  static const std::vector<ColumnOf<E>> kColumns{
      {{"Echo", "", "number of the echo in its observation", true}, count<&R::echo_id>},
      {{"Observation", "", "", false}, [](const E& e) { return text_cell(e.observation->name()); }},
      {{"Ping", "", "in which it was loudest; the other columns are of it", true}, count<&R::ping_index>},
      {{"Level", "dB re 1 m\u207B\u00B9", "reference level, as a school's", true}, figure<&R::level_db, 1>},
      {{"Why", "", "what the judge looked at, and its limit", false, true},
       [](const E& e) { return text_cell(why_no_school(*e.sightings.loudest)); }},
      {{"Judge", "", "that says it is no school", false},
       [](const E& e) { return text_cell(e.sightings.loudest->judge); }},
      {{"Pings", "", "pings in which it was followed", true}, [](const E& e) { return count_cell(e.sightings.pings); }},
      {{"Depth", "m", "of its centre below the sea surface", true}, figure<&R::depth_m, 1>},
      {{"Range", "m", "of its centre from the sonar", true}, figure<&R::range_m, 1>},
      {{"Fans", "", "that it reaches over", true}, count<&R::n_fans>},
      {{"Beams", "", "that it reaches over", true}, count<&R::n_beams>},
      {{"Along range", "m", "", true}, figure<&R::range_extent_m, 1>},
      {{"Volume", "m\u00B3", "as the beams see it", true}, figure<&R::volume_m3, 0>},
      {{"Above background", "1", "evidence: standard deviations above the background", true},
       figure<&R::above_water, 1>},
      {{"Latitude", "", "of its centre", true},
       [](const E& e) { return latitude_cell(e.sightings.loudest->latitude); }},
      {{"Longitude", "", "of its centre", true},
       [](const E& e) { return longitude_cell(e.sightings.loudest->longitude); }},
  };
  return kColumns;
}

}  // namespace

RefusedTable::RefusedTable(Workspace& workspace)
    : DocumentRows(workspace, {DocumentChange::survey, DocumentChange::state}),
      titles_(titles_of(refused_columns())),
      listening_(workspace.echo.changed(), [this] { moved().tell(); }) {}

void RefusedTable::make() {
  titles_ = titles_of(refused_columns(), workspace().units());
  echoes_.clear();
  const Document& document = workspace().document;
  for (const auto& [index, state] : document.choices().states) {
    const OpenObservationPtr observation = document.open_observation(index);
    if (!observation) continue;
    const RefusedPtr rows = document.refused(index);
    for (const RefusedSightings& sightings : refused_sightings(*rows)) {
      echoes_.push_back({{index, sightings.loudest->echo_id}, observation, rows, sightings});
    }
  }
}

Cell RefusedTable::cell(std::size_t row, std::size_t column) const {
  return cell_of(refused_columns()[column], echoes_[row], workspace().units());
}

void RefusedTable::select(std::size_t row) {
  if (row >= echoes_.size()) return;
  const EchoName name = echoes_[row].name;  // what follows may make the rows anew
  go_to_echo(workspace(), name);
}

std::optional<std::size_t> RefusedTable::selected() const {
  const auto& name = workspace().echo();
  // In another ping a click on its row goes there once more.
  if (!name || !loudest_on_show(workspace(), *name)) return std::nullopt;
  const auto found = std::ranges::find(echoes_, *name, &SurveyEcho::name);
  return found == echoes_.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - echoes_.begin()));
}

}  // namespace sonar
