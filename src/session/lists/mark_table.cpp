// SPDX-License-Identifier: Apache-2.0
#include "session/lists/mark_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "session/lists/cells.h"

namespace sonar {
namespace {

const EventCommand* event_of(const SurveyMark& mark) { return std::get_if<EventCommand>(&mark.mark.what); }

const PingNavigation& navigation_of(const SurveyMark& mark) {
  return mark.observation->files().navigation[static_cast<std::size_t>(mark.first_ping)];
}

Cell kind_cell(const SurveyMark& mark) {
  const EventCommand* event = event_of(mark);
  return text_cell(event == nullptr ? "bad pings" : event->kind);
}

Cell what_cell(const SurveyMark& mark) {
  const EventCommand* event = event_of(mark);
  if (event != nullptr) return text_cell(event->text);
  if (mark.first_ping == mark.last_ping) return text_cell("takes no part in measures");
  return text_cell(fmt::format("to ping {}, take no part in measures", mark.last_ping));
}

const std::vector<ColumnOf<SurveyMark>>& mark_columns() {
  using M = SurveyMark;
  static const std::vector<ColumnOf<M>> kColumns{
      {{"Mark", "", "trawl, station, noise, other, bookmark, or bad pings", false}, kind_cell},
      {{"What", "", "as it was written when the mark was set", false, true}, what_cell},
      {{"Observation", "", "", false}, [](const M& m) { return text_cell(m.observation->name()); }},
      {{"Ping", "", "the first one from the mark's time on", true},
       [](const M& m) { return count_cell(m.first_ping); }},
      {{"Time", "UTC", "of that ping", false}, [](const M& m) { return time_cell(navigation_of(m).time); }},
      {{"Latitude", "", "of the sonar", true},
       [](const M& m) { return latitude_cell(navigation_of(m).transducer.latitude_deg); }},
      {{"Longitude", "", "of the sonar", true},
       [](const M& m) { return longitude_cell(navigation_of(m).transducer.longitude_deg); }},
  };
  return kColumns;
}

}  // namespace

MarkTable::MarkTable(AppModel& app)
    : DocumentRows(app.workspace, {DocumentChange::survey, DocumentChange::state, DocumentChange::observation}),
      titles_(titles_of(mark_columns())),
      listening_(app.workspace.mark.changed(), [this] { moved().tell(); }) {}

void MarkTable::make() {
  marks_ = survey_marks(workspace().document);
  pictures_ = std::ranges::any_of(
      marks_, [](const SurveyMark& one) { return event_of(one) != nullptr && event_of(one)->kind == kBookmark; });
}

Cell MarkTable::cell(std::size_t row, std::size_t column) const { return mark_columns()[column].cell(marks_[row]); }

std::optional<std::filesystem::path> MarkTable::picture(std::size_t row) const {
  if (!pictures_) return std::nullopt;
  const EventCommand* event = event_of(marks_[row]);
  if (event == nullptr || event->kind != kBookmark) return std::filesystem::path{};
  return thumbnail_of(workspace().document, *event);
}

void MarkTable::select(std::size_t row) {
  if (row < marks_.size()) go_to_mark(workspace(), marks_[row]);
}

std::optional<std::size_t> MarkTable::selected() const {
  const auto& chosen = workspace().mark();
  if (!chosen) return std::nullopt;
  const auto found = std::ranges::find(marks_, *chosen, &SurveyMark::mark);
  return found == marks_.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - marks_.begin()));
}

}  // namespace sonar
