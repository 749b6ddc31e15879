// SPDX-License-Identifier: Apache-2.0
#include "session/lists/survey_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/number_text.h"
#include "model/beam_angles.h"
#include "session/lists/cells.h"
#include "session/open/survey_schools.h"

namespace sonar {
namespace {

/// "no pings of MS70 grid" in few words: how many remarks there are, and the first.
std::string notes_text(std::size_t count) {
  if (count == 0) return {};
  return count_of(static_cast<std::size_t>(count), "remark");
}

Cell span_cell(TimeNs first, TimeNs last) {
  if (first == 0) return {};
  return {span_text(first, last), static_cast<double>(first), span_brief(first, last)};
}

}  // namespace

SurveyTree::SurveyTree(Workspace& workspace)
    : DocumentRows(workspace, {DocumentChange::survey, DocumentChange::glance, DocumentChange::observation,
                               DocumentChange::state, DocumentChange::measures}),
      titles_{{"Survey", "", "observations, their files, and what is wrong with them", false},
              {"Time", "UTC", "from the first ping to the last", false},
              {"Pings", "", "", true},
              {"Schools", "", "as far as they are known", true},
              {"Remarks", "", "what is damaged or doubtful", false}} {}

void SurveyTree::add_notes(const Diagnostics& notes, int level, std::optional<std::size_t> observation) {
  // Damage comes in thousands of equal remarks: one row a kind, the list of diagnostics has them all.
  std::map<DiagnosticCode, std::vector<const Diagnostic*>> kinds;
  for (const Diagnostic& note : notes) kinds[note.code].push_back(&note);
  for (const auto& [code, all] : kinds) {
    const std::string kind(name(code));
    rows_.push_back({level,
                     observation,
                     all.size() == 1 ? kind : fmt::format("{} \u00D7 {}", all.size(), kind),
                     {},
                     {},
                     {},
                     all.front()->text});
  }
}

void SurveyTree::add_file(std::size_t file, std::optional<std::size_t> observation) {
  const SurveyFile& one = workspace().document.survey()->files[file];
  const auto& pings = one.index.pings;
  Row row{1,  observation, one.path.filename().string(), {}, count_cell(static_cast<std::int64_t>(pings.size())),
          {}, {}};
  if (!pings.empty()) row.time = span_cell(pings.front().time, pings.back().time);
  row.notes = one.error ? to_line(*one.error) : notes_text(one.index.diagnostics.size());
  rows_.push_back(std::move(row));
  add_notes(one.index.diagnostics, 2, observation);
}

void SurveyTree::add_beams(const BeamGrid& grid, std::size_t observation) {
  const std::vector<double> excess_db = psi_excess_db(grid);
  const std::string all = text_of(excess_over(excess_db));
  if (all.empty()) return;
  rows_.push_back({1, observation, fmt::format("{} fans \u00D7 {} beams", grid.fans(), grid.beams()), {}, {}, {}, all});
  for (int fan = 0; fan < grid.fans(); ++fan) {
    rows_.push_back({2,
                     observation,
                     fmt::format("fan {}, {:.1f}\u00B0", fan, grid.elevation_deg[static_cast<std::size_t>(fan)]),
                     {},
                     {},
                     {},
                     text_of(excess_of_fan(excess_db, grid, fan))});
  }
}

void SurveyTree::add_observation(std::size_t index) {
  const Document& document = workspace().document;
  const ObservationFiles& observation = document.survey()->observations[index];
  Row row{0, index, observation.name, {}, count_cell(static_cast<std::int64_t>(observation.pings.size())), {}, {}};
  if (!observation.navigation.empty()) {
    row.time = span_cell(observation.navigation.front().time, observation.navigation.back().time);
  }
  if (document.choices().states.contains(index)) {
    row.schools = count_cell(school_count(document.state(index), document.product(index)));
  }
  std::size_t remarks = observation.diagnostics.size();
  for (const std::uint32_t file : observation.files) {
    remarks += document.survey()->files[file].index.diagnostics.size();
  }
  row.notes = observation.grid ? notes_text(remarks) : "no grid of fans and beams: track alone";
  rows_.push_back(std::move(row));
  add_notes(observation.diagnostics, 1, index);
  for (const std::uint32_t file : observation.files) add_file(file, index);
  if (observation.grid) add_beams(*observation.grid, index);
}

/// While the files are read: nothing in them is counted yet.
void SurveyTree::add_glanced(const SurveyFiles& glance) {
  for (std::size_t i = 0; i < glance.observations.size(); ++i) {
    const ObservationFiles& one = glance.observations[i];
    rows_.push_back({0,
                     i,
                     one.name,
                     span_cell(one.navigation.front().time, one.navigation.back().time),
                     {},
                     {},
                     fmt::format("not read yet; a double-click opens {} alone",
                                 one.files.size() == 1 ? "its file" : fmt::format("its {} files", one.files.size()))});
  }
}

void SurveyTree::make() {
  rows_.clear();
  if (const auto& glance = workspace().document.glance()) return add_glanced(*glance);
  const SurveyFiles* survey = workspace().document.survey();
  if (survey == nullptr) return;
  std::set<std::size_t> used;
  for (std::size_t i = 0; i < survey->observations.size(); ++i) {
    add_observation(i);
    used.insert(survey->observations[i].files.begin(), survey->observations[i].files.end());
  }
  if (used.size() < survey->files.size()) {
    rows_.push_back({0, {}, "Files without pings", {}, {}, {}, {}});
    for (std::size_t i = 0; i < survey->files.size(); ++i) {
      if (!used.contains(i)) add_file(i, std::nullopt);
    }
  }
  if (survey->diagnostics.empty()) return;
  rows_.push_back({0, {}, "Remarks on the survey", {}, {}, {}, notes_text(survey->diagnostics.size())});
  add_notes(survey->diagnostics, 1, std::nullopt);
}

Cell SurveyTree::cell(std::size_t row, std::size_t column) const {
  const Row& one = rows_[row];
  if (column == 0) return text_cell(one.name);
  if (column == 1) return one.time;
  if (column == 2) return one.pings;
  if (column == 3) return one.schools;
  return text_cell(one.notes);
}

void SurveyTree::open(std::size_t row) {
  if (row >= rows_.size() || !rows_[row].observation) return;
  Document& document = workspace().document;
  if (document.glance()) return document.open_glanced(*rows_[row].observation);
  if (document.shown() && document.shown()->index() == *rows_[row].observation) return;
  if (auto shown = document.show(*rows_[row].observation); !shown) document.tell(to_line(shown.error()));
}

std::optional<std::size_t> SurveyTree::selected() const {
  const auto& shown = workspace().document.shown();
  if (!shown) return std::nullopt;
  const auto found = std::find_if(rows_.begin(), rows_.end(),
                                  [&](const Row& one) { return one.level == 0 && one.observation == shown->index(); });
  return found == rows_.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - rows_.begin()));
}

}  // namespace sonar
