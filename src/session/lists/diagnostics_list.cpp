// SPDX-License-Identifier: Apache-2.0
#include "session/lists/diagnostics_list.h"

#include "session/lists/cells.h"
#include "session/open/survey_schools.h"

namespace sonar {
namespace {

constexpr std::size_t kWhat = 0;
constexpr std::size_t kKind = 1;

std::string meaning_of(DiagnosticCode code) {
  for (const DiagnosticEntry& entry : diagnostic_table()) {
    if (entry.code == code) return std::string(entry.sentence);
  }
  return {};
}

}  // namespace

DiagnosticsList::DiagnosticsList(Workspace& workspace)
    : DocumentRows(workspace,
                   {DocumentChange::survey, DocumentChange::state, DocumentChange::measures, DocumentChange::notice}),
      titles_{{"What", "", "what was found and what was expected", false, true},
              {"Kind", "", "stable name of what was found", false},
              {"Observation", "", "", false},
              {"Ping", "", "index in the observation", true},
              {"File", "", "", false},
              {"Byte", "", "offset in the file", true},
              {"Meaning", "", "", false}} {}

void DiagnosticsList::add(const Diagnostics& notes, std::ptrdiff_t observation, Lost which) {
  const Document& document = workspace().document;
  // Decisions on schools that are still being found again are not lost.
  const bool waits = observation >= 0 && document.lacks_detected(static_cast<std::size_t>(observation));
  for (const Diagnostic& note : notes) {
    const bool lost = note.code == DiagnosticCode::decision_lost;
    if (lost ? waits || which == Lost::without : which == Lost::alone) continue;
    remarks_.push_back({&note, 0, observation});
  }
}

void DiagnosticsList::add_observation(std::size_t index) {
  const Document& document = workspace().document;
  const SurveyFiles& survey = *document.survey();
  const auto at = static_cast<std::ptrdiff_t>(index);
  const auto& states = document.choices().states;
  const auto state = states.find(index);
  const bool decided = state != states.end() && state->second;
  if (decided) kept_.push_back(state->second);
  if (const ProductPtr product = document.product(index)) {
    // It holds those of the files and of the choices, too; but of the choices as they were when it was measured, and what
    // was lost while schools were still being found again is not lost any more.
    kept_.push_back(product);
    add(product->diagnostics, at, decided ? Lost::without : Lost::with);
    return decided ? add(state->second->notes, at, Lost::alone) : void();
  }
  add(survey.observations[index].diagnostics, at);
  for (const std::uint32_t file : survey.observations[index].files) add(survey.files[file].index.diagnostics, at);
  if (decided) add(state->second->notes, at);
}

void DiagnosticsList::make() {
  remarks_.clear();
  kept_.clear();
  const SurveyFiles* survey = workspace().document.survey();
  if (survey == nullptr) return;
  add(survey->diagnostics, -1);
  std::vector<bool> used(survey->files.size(), false);
  for (const ObservationFiles& observation : survey->observations) {
    for (const std::uint32_t file : observation.files) used[file] = true;
  }
  for (std::size_t i = 0; i < survey->files.size(); ++i) {
    if (survey->files[i].error) remarks_.push_back({nullptr, i, -1});
    if (!used[i]) add(survey->files[i].index.diagnostics, -1);
  }
  for (std::size_t i = 0; i < survey->observations.size(); ++i) add_observation(i);
}

Cell DiagnosticsList::unreadable_cell(const Remark& remark, std::size_t column) const {
  const SurveyFile& file = workspace().document.survey()->files[remark.file];
  if (column == kWhat) return text_cell(to_line(*file.error));
  if (column == kKind) return text_cell("file-unreadable");
  return column == 4 ? text_cell(file.path.filename().string()) : Cell{};
}

Cell DiagnosticsList::cell(std::size_t row, std::size_t column) const {
  if (row < notices().size()) {
    // The last that was told stands first.
    if (column == kKind) return text_cell("notice");
    return column == kWhat ? text_cell(notices()[notices().size() - 1 - row]) : Cell{};
  }
  const Remark& remark = remarks_[row - notices().size()];
  if (remark.note == nullptr) return unreadable_cell(remark, column);
  const Diagnostic& note = *remark.note;
  if (column == kWhat) return text_cell(note.text);
  if (column == kKind) return text_cell(std::string(name(note.code)));
  if (column == 2 && remark.observation >= 0) {
    return text_cell(workspace().document.survey()->observations[static_cast<std::size_t>(remark.observation)].name);
  }
  if (column == 3 && note.ping_index >= 0) return count_cell(note.ping_index);
  if (column == 4) return text_cell(std::filesystem::path(note.file).filename().string());
  if (column == 5 && note.offset >= 0) return count_cell(note.offset);
  return column == 6 ? text_cell(meaning_of(note.code)) : Cell{};
}

void DiagnosticsList::open(std::size_t row) {
  if (row < notices().size() || row >= rows()) return;
  const Remark& remark = remarks_[row - notices().size()];
  if (remark.note == nullptr || remark.note->ping_index < 0 || remark.observation < 0) return;
  go_to_ping(workspace(), static_cast<std::size_t>(remark.observation), remark.note->ping_index);
}

}  // namespace sonar
