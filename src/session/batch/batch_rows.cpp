// SPDX-License-Identifier: Apache-2.0
#include "session/batch/batch_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "base/number_text.h"
#include "session/lists/cells.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

std::string size_text(const RawSize& size) {
  constexpr std::array<std::pair<double, const char*>, 3> kUnits{{{1e12, "TB"}, {1e9, "GB"}, {1e6, "MB"}}};
  const auto bytes = static_cast<double>(size.bytes);
  const auto unit = std::find_if(kUnits.begin(), kUnits.end(), [&](const auto& one) { return bytes >= one.first; });
  const auto& [scale, name] = unit == kUnits.end() ? kUnits.back() : *unit;
  return fmt::format("{}, {:.3g} {}", count_of(size.files, "file"), bytes / scale, name);
}

/// Its last two names: surveys of several cruises may be called alike. All of it is told where the pointer rests.
Cell path_cell(const std::string& text, const fs::path& path) {
  const fs::path brief = path.parent_path().filename() / path.filename();
  return {printable(text), printable(text), printable(brief.string())};
}

/// How far it is, or what it took.
Cell progress_cell(const BatchSurvey& survey) {
  const BatchProgress& progress = survey.progress;
  switch (survey.state) {
    case BatchState::waiting:
      return {};
    case BatchState::running:
      return {text_of(progress), progress.share};
    case BatchState::stopped:
    case BatchState::failed:
      return {progress.of_pings > 0 ? fmt::format("{} of {} pings", grouped(static_cast<std::size_t>(progress.pings)),
                                                  grouped(static_cast<std::size_t>(progress.of_pings)))
                                    : std::string(),
              progress.share};
    case BatchState::done:
    case BatchState::partly:
      return {fmt::format("{} in {}", count_of(static_cast<std::size_t>(progress.of_pings), "ping"),
                          duration_text(survey.took_s)),
              1.0};
  }
  return {};
}

Cell schools_cell(const BatchSurvey& survey) {
  if (survey.schools) return count_cell(static_cast<std::int64_t>(*survey.schools));
  const bool ended = survey.state == BatchState::done || survey.state == BatchState::partly;
  return ended ? text_cell("not looked for") : Cell{};
}

std::string problems(const BatchSurvey& survey) {
  std::string text;
  if (survey.failed_observations > 0) text = count_of(survey.failed_observations, "observation");
  if (survey.failed_files > 0) text += (text.empty() ? "" : ", ") + count_of(survey.failed_files, "file");
  if (!text.empty() && !survey.why.empty()) text += ": ";
  return text + survey.why;
}

}  // namespace

BatchRows::BatchRows(Batch& batch) : batch_(batch) {
  listening_.to(batch.changed(), [this](BatchChange change) {
    if (change == BatchChange::surveys) changed().tell();
    if (change == BatchChange::progress) moved().tell();
  });
}

const std::vector<ListColumn>& BatchRows::columns() const {
  static const std::vector<ListColumn> kColumns{
      {"Survey", "", "Folder of raw files, or raw files: where it lies is shown when the pointer rests here"},
      {"Raw files", "", "How many there are, and how large they are together"},
      {"Results", "", "Folder that products, tables and map go to"},
      {"State", "", "Waiting, running, done, done in part (some observations or files failed), failed or stopped"},
      {"Progress", "", "Pings that are done, and the time that is left of this survey"},
      {"Schools", "", "How many were found; they are not looked for in single-beam data", true},
      {"Problems", "", "What failed, and why; the log below has all of it", false, true}};
  return kColumns;
}

Cell BatchRows::cell(std::size_t row, std::size_t column) const {
  const BatchSurvey& survey = batch_.surveys().at(row);
  switch (static_cast<Column>(column)) {
    case Column::survey:
      return path_cell(text_of(survey.paths), survey.paths.front());
    case Column::raw_files:
      return survey.size ? text_cell(size_text(*survey.size)) : Cell{};
    case Column::results:
      return survey.out.empty() ? text_cell("(choose a folder)") : path_cell(survey.out.string(), survey.out);
    case Column::state:
      return text_cell(std::string(name(survey.state)));
    case Column::progress:
      return progress_cell(survey);
    case Column::schools:
      return schools_cell(survey);
    case Column::problems:
      return text_cell(printable(problems(survey)));
  }
  return {};
}

std::string total_text(const Batch& batch) {
  const auto& surveys = batch.surveys();
  if (batch.running()) {
    const auto done = std::count_if(surveys.begin(), surveys.end(), [](const BatchSurvey& one) {
      return one.state != BatchState::waiting && one.state != BatchState::running;
    });
    std::string text = fmt::format("survey {} of {}, {:.0f} %", done + 1, surveys.size(), 100.0 * batch.share());
    if (batch.stopping()) return text + ", stopping";
    if (const auto left = batch.left_s()) text += fmt::format(", {} left", duration_text(*left));
    return text;
  }
  return surveys.empty() ? std::string() : states_text(batch);
}

}  // namespace sonar
