// SPDX-License-Identifier: Apache-2.0
#include "session/lists/journal_list.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "pipeline/journal/journals.h"
#include "session/history.h"
#include "session/lists/cells.h"
#include "session/open/survey_schools.h"

namespace sonar {
namespace {

bool turns_back(const JournalLine& line) { return line.command == "undo" || line.command == "redo"; }

}  // namespace

JournalList::JournalList(Workspace& workspace)
    : DocumentRows(workspace, {DocumentChange::survey, DocumentChange::state}),
      titles_{{"Line", "", "in the journal's file", true},
              {"What", "", "", false, true},
              {"Time", "UTC", "when it was done", false},
              {"Operator", "", "", false},
              {"On", "", "observation and ping that it was done on", false},
              {"Undone", "", "", false}} {}

void JournalList::make() {
  lines_ = workspace().document.choices().lines;
  undone_.clear();
  if (!lines_) return;
  for (const JournalLine& one : *lines_) {
    if (!turns_back(one)) undone_.insert(one.n);
  }
  for (const JournalLine& one : effective_lines(*lines_)) undone_.erase(one.n);
}

std::optional<JournalList::Place> JournalList::place_of(const JournalLine& line) const {
  const SurveyFiles* survey = workspace().document.survey();
  if (survey == nullptr || turns_back(line)) return std::nullopt;
  for (std::size_t i = 0; i < survey->observations.size(); ++i) {
    if (const auto ping = ping_at(*survey, survey->observations[i], line.ping_time)) return Place{i, *ping};
  }
  return std::nullopt;
}

std::string JournalList::what(const JournalLine& line) const {
  if (turns_back(line)) {
    const auto target = line.args->find("target");
    const bool known = target != line.args->end() && target->is_number_integer();
    return known ? fmt::format("{} line {}", line.command, line_title(target->get<std::int64_t>())) : line.command;
  }
  const auto& names = workspace().document.choices().names;
  if (const auto named = names.find(line.n); named != names.end()) return named->second;
  const auto act = act_of(line);
  return act ? act_name(*act, {}, nullptr, nullptr) : line.command + ": " + to_line(act.error());
}

Cell JournalList::cell(std::size_t row, std::size_t column) const {
  const JournalLine& one = line(row);
  if (column == 0) return {line_title(one.n), static_cast<double>(one.n), {}};
  if (column == 1) return text_cell(what(one));
  if (column == 2) return time_cell(one.decided);
  if (column == 3) return text_cell(one.operator_name);
  if (column == 5) return text_cell(undone_.contains(one.n) ? "undone" : "");
  const auto place = place_of(one);
  if (!place) return {};
  const auto& observation = workspace().document.survey()->observations[place->observation];
  return text_cell(fmt::format("{} ping {}", observation.name, place->ping_index));
}

bool JournalList::faded(std::size_t row) const { return undone_.contains(line(row).n); }

void JournalList::open(std::size_t row) {
  if (row >= rows()) return;
  if (const auto place = place_of(line(row))) go_to_ping(workspace(), place->observation, place->ping_index);
}

}  // namespace sonar
