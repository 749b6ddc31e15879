// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "pipeline/tasks/merge.h"
#include "pipeline/tasks/open_for_run.h"
#include "pipeline/tasks/plan.h"
#include "pipeline/tasks/run.h"

namespace sonar {

/// A line that a run tells a human.
struct RunLine {
  enum class Kind : std::uint8_t { result, refused, note, failure };
  Kind kind = Kind::result;
  std::string text;
};
/// As it stands in a terminal: "note no-grid: obs-0001: ...", "sonarx: obs-0002: ...".
[[nodiscard]] std::string shown_line(const RunLine& line);
/// What stands before the text of such a line.
[[nodiscard]] std::string_view head_of(RunLine::Kind kind);

/// errors  io, no_space; usage: a recording stands there
[[nodiscard]] Result<void> write_log(const std::filesystem::path& file, std::span<const std::string> lines);

/// Who hears of a run while it goes on, on the thread that runs it.
struct RunTelling {
  std::function<void(const RunLine&)> line;
  std::function<void(const Plan&)> planned;  ///< before the first observation; may be empty
  bool why = false;                          ///< each echo that was judged to be no school has a line
};

/// Notes on the survey as a whole, then the failures, a line each.
[[nodiscard]] std::vector<RunLine> failure_lines(const SurveyFiles& survey, std::span<const RunFailure> failures);

/// What a run came to.
struct RunDone {
  RunReport report;                   ///< files that gave nothing are among the failures
  std::optional<MergeReport> merged;  ///< none where one task alone was asked for
  bool looked_for_schools = false;    ///< by itself, or by a choice of the session

  /// All that was asked for is there.
  [[nodiscard]] bool whole() const { return report.failures.empty(); }
  /// Nothing is there.
  [[nodiscard]] bool nothing() const { return !whole() && report.done.empty() && report.skipped.empty(); }
};

/// The whole of a run: raw files to products, tables and map, as `sonarx run` makes them. Products that are right stay. What
/// fails for itself is told and stops nothing else.
/// out     options.out; never where raw files lie
/// errors  what keeps anything from being made; cancelled: what was finished stays. It is the caller's to tell it.
/// memory  as observe()
[[nodiscard]] Result<RunDone> run_survey(const RunSources& sources, RunOptions options, const RunTelling& tell,
                                         Work& work);

}  // namespace sonar
