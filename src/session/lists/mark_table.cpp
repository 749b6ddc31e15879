// SPDX-License-Identifier: Apache-2.0
#include "session/lists/mark_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <variant>

#include "session/lists/cells.h"
#include "session/open/survey_schools.h"

namespace sonar {
namespace {

const EventCommand* event_of(const MarkRow& row) {
  const auto* mark = std::get_if<SurveyMark>(&row.what);
  return mark == nullptr ? nullptr : std::get_if<EventCommand>(&mark->mark.what);
}

const Transect* transect_of(const MarkRow& row) {
  const auto* there = std::get_if<SurveyPeriod>(&row.what);
  return there == nullptr ? nullptr : &there->period;
}

Cell kind_cell(const MarkRow& row) {
  if (const Transect* transect = transect_of(row)) {
    return text_cell(transect->type == EffortType::off ? "off effort" : "transect");
  }
  const EventCommand* event = event_of(row);
  return text_cell(event == nullptr ? "bad pings" : event->kind);
}

Cell what_cell(const MarkRow& row) {
  if (const Transect* transect = transect_of(row)) {
    return text_cell(transect->stratum.empty() ? transect->name
                                               : fmt::format("{} (stratum {})", transect->name, transect->stratum));
  }
  if (const EventCommand* event = event_of(row)) return text_cell(event->text);
  const auto& mark = std::get<SurveyMark>(row.what);
  if (mark.first_ping == mark.last_ping) return text_cell("takes no part in measures");
  return text_cell(fmt::format("to ping {}, take no part in measures", mark.last_ping));
}

const std::vector<ColumnOf<MarkRow>>& mark_columns() {
  using M = MarkRow;
  static const std::vector<ColumnOf<M>> kColumns{
      {{"Mark", "", "trawl, station, noise, other, bookmark, bad pings, transect, or off effort", false}, kind_cell},
      {{"What", "", "as it was written when the mark was set, or in the table of transects", false, true}, what_cell},
      {{"Observation", "", "", false}, [](const M& m) { return text_cell(m.observation); }},
      {{"Ping", "", "the first one from the mark's time on", true}, [](const M& m) { return count_cell(m.ping); }},
      {{"Time", "UTC", "of that ping", false}, [](const M& m) { return time_cell(m.at.time); }},
      {{"Latitude", "", "of the sonar", true}, [](const M& m) { return latitude_cell(m.at.transducer.latitude_deg); }},
      {{"Longitude", "", "of the sonar", true},
       [](const M& m) { return longitude_cell(m.at.transducer.longitude_deg); }},
  };
  return kColumns;
}

MarkRow row_of(SurveyMark mark) {
  const std::size_t index = mark.mark.observation;
  const std::string name = mark.observation->name();
  const std::int64_t ping = mark.first_ping;
  const PingNavigation at = mark.observation->files().navigation[static_cast<std::size_t>(ping)];
  return {std::move(mark), index, name, ping, at};
}

MarkRow row_of(SurveyPeriod period, const SurveyFiles& survey) {
  const std::size_t index = period.observation;
  const ObservationFiles& observation = survey.observations[index];
  const std::int64_t ping = period.first_ping;
  return {std::move(period), index, observation.name, ping, observation.navigation[static_cast<std::size_t>(ping)]};
}

}  // namespace

MarkTable::MarkTable(AppModel& app)
    : DocumentRows(app.workspace, {DocumentChange::survey, DocumentChange::state, DocumentChange::observation}),
      titles_(titles_of(mark_columns())),
      listening_(app.workspace.mark.changed(), [this] { moved().tell(); }) {
  listening_.to(app.workspace.transects.changed(), [this] { refresh(); });
}

void MarkTable::make() {
  marks_.clear();
  for (SurveyMark& mark : survey_marks(workspace().document)) marks_.push_back(row_of(std::move(mark)));
  for (SurveyPeriod& period : survey_periods(workspace())) {
    marks_.push_back(row_of(std::move(period), *workspace().document.survey()));
  }
  std::ranges::stable_sort(marks_, {}, [](const MarkRow& row) { return std::pair(row.observation_index, row.ping); });
  pictures_ = std::ranges::any_of(
      marks_, [](const MarkRow& row) { return event_of(row) != nullptr && event_of(row)->kind == kBookmark; });
}

Cell MarkTable::cell(std::size_t row, std::size_t column) const { return mark_columns()[column].cell(marks_[row]); }

std::optional<std::filesystem::path> MarkTable::picture(std::size_t row) const {
  if (!pictures_) return std::nullopt;
  const EventCommand* event = event_of(marks_[row]);
  if (event == nullptr || event->kind != kBookmark) return std::filesystem::path{};
  return thumbnail_of(workspace().document, *event);
}

void MarkTable::select(std::size_t row) {
  if (row >= marks_.size()) return;
  const MarkRow there = marks_[row];  // what follows may make the rows anew
  if (const auto* mark = std::get_if<SurveyMark>(&there.what)) return go_to_mark(workspace(), *mark);
  go_to_ping(workspace(), there.observation_index, there.ping);
}

std::optional<std::size_t> MarkTable::selected() const {
  const auto& chosen = workspace().mark();
  if (!chosen) return std::nullopt;
  const auto found = std::ranges::find_if(marks_, [&](const MarkRow& row) {
    const auto* mark = std::get_if<SurveyMark>(&row.what);
    return mark != nullptr && mark->mark == *chosen;
  });
  return found == marks_.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - marks_.begin()));
}

}  // namespace sonar
