// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tasks/run_survey.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <string_view>
#include <utility>

#include "io/atomic_file.h"
#include "io/product_file.h"
#include "pipeline/stages/refused_echoes.h"
#include "pipeline/tasks/task_record.h"

namespace sonar {
namespace {

/// Whether a run could find any school at all: by itself, or by a choice of the session.
bool looks_for_schools(const Opened& opened) {
  if (opened.plan.recipe.automatic) return true;
  constexpr std::array<std::string_view, 4> kSelects{"propagate", "grow", "brush", "detect"};
  return std::ranges::any_of(opened.journal.lines(), [&](const ReadLine& read) {
    return std::ranges::find(kSelects, read.line.command) != kSelects.end();
  });
}

/// What the products of these observations refused, a line each.
Result<void> tell_refusals(const std::filesystem::path& out, const RunReport& report, const RunTelling& tell) {
  std::vector<std::string> names = report.done;
  names.insert(names.end(), report.skipped.begin(), report.skipped.end());
  std::ranges::sort(names);
  for (const std::string& observation : names) {
    const auto product = read_product(product_path(out, observation));
    if (!product) return pass_on(product);
    for (const std::string& line : refusal_lines(*product)) tell.line({RunLine::Kind::refused, line});
  }
  return {};
}

/// The observation of the one task that is asked for; empty where all are.
std::string task_name(const Plan& plan, const RunOptions& options) {
  return options.task && *options.task < plan.tasks.size() ? plan.tasks[*options.task].observation : "";
}

TaskRecord record_since_now() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return record_of_this_process(std::chrono::duration_cast<std::chrono::nanoseconds>(now).count());
}

/// For `sonarx status`: that it cannot be noted hinders no task.
void begin_task(const Plan& plan, const RunOptions& options) {
  const std::string name = task_name(plan, options);
  if (!name.empty()) (void)write_record(options.out, name, record_since_now());
}

void end_task(const Plan& plan, const RunOptions& options, const Result<RunReport>& done) {
  const std::string name = task_name(plan, options);
  if (name.empty()) return;
  TaskRecord record = record_since_now();
  if (!done) record.error = to_line(done.error());
  if (done && !done->failures.empty()) record.error = to_line(done->failures.front().error);
  if (record.error.empty()) {
    remove_record(options.out, name);
  } else {
    (void)write_record(options.out, name, record);
  }
}

void tell_merged(const MergeReport& merged, const std::filesystem::path& out, const RunTelling& tell) {
  for (std::string& line : note_lines(merged)) tell.line({RunLine::Kind::note, std::move(line)});
  const std::string text = merge_text(merged, out);
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    tell.line({RunLine::Kind::result, text.substr(from, end - from)});
    from = end + 1;
  }
}

Result<RunDone> finish(const Opened& opened, const RunOptions& options, RunReport report, const RunTelling& tell,
                       Work& work) {
  RunDone done{std::move(report), {}, looks_for_schools(opened)};
  const auto tell_failures = [&] {
    for (const RunLine& line : failure_lines(opened.survey, done.report.failures)) tell.line(line);
  };
  if (options.task) {
    tell_failures();
    return done;
  }
  const std::vector<RunFailure> files = failed_files(opened.survey);
  done.report.failures.insert(done.report.failures.end(), files.begin(), files.end());
  auto merged = merge_after(options.out, done.report, work, options.only);
  tell_failures();
  if (!merged) return pass_on(merged);
  tell_merged(*merged, options.out, tell);
  done.merged = std::move(*merged);
  if (opened.plan.tasks.empty()) tell.line({RunLine::Kind::note, "no-observation: no file holds a ping"});
  if (!done.looked_for_schools) {
    tell.line(
        {RunLine::Kind::note,
         "no-detection: schools were not detected: the recipe says \"automatic\": false, and no session selects one"});
  }
  return done;
}

}  // namespace

std::string_view head_of(RunLine::Kind kind) {
  switch (kind) {
    case RunLine::Kind::note:
      return "note ";
    case RunLine::Kind::failure:
      return "sonarx: ";
    case RunLine::Kind::result:
    case RunLine::Kind::refused:
      break;
  }
  return "";
}

std::string shown_line(const RunLine& line) { return std::string(head_of(line.kind)) + line.text; }

Result<void> write_log(const std::filesystem::path& file, std::span<const std::string> lines) {
  return write_file(file, lines.empty() ? std::string() : fmt::format("{}\n", fmt::join(lines, "\n")));
}

std::vector<RunLine> failure_lines(const SurveyFiles& survey, std::span<const RunFailure> failures) {
  std::vector<RunLine> lines;
  const auto told_below = [&](const Diagnostic& note) {
    return note.code == DiagnosticCode::unreadable &&
           std::any_of(failures.begin(), failures.end(),
                       [&](const RunFailure& failure) { return failure.error.where.file == note.file; });
  };
  for (const Diagnostic& note : survey.diagnostics) {
    if (told_below(note)) continue;
    const std::string what = to_line({ErrorCode::format, note.text, {note.file, note.offset, note.ping_index}});
    lines.push_back({RunLine::Kind::note, fmt::format("{}: {}", name(note.code), what)});
  }
  for (const RunFailure& failure : failures) {
    const std::string of = failure.observation ? printable(*failure.observation) + ": " : "";
    lines.push_back({RunLine::Kind::failure, of + to_line(failure.error)});
  }
  return lines;
}

Result<RunDone> run_survey(const RunSources& sources, RunOptions options, const RunTelling& tell, Work& work) {
  auto opened = open_for_run(sources, work);
  if (!opened) return pass_on(opened);
  if (auto outside = require_outside_raw(opened->survey, options.out); !outside) return pass_on(outside);
  if (sources.plan.empty()) {
    if (auto written = write_plan(*opened, sources, options); !written) return pass_on(written);
  } else {
    options.pings = opened->plan.pings;
  }
  if (tell.planned) tell.planned(opened->plan);
  begin_task(opened->plan, options);
  auto report = run_plan(opened->plan, opened->survey, opened->journal, options, work);
  end_task(opened->plan, options, report);
  if (!report) return pass_on(report);
  if (tell.why) {
    if (auto told = tell_refusals(options.out, *report, tell); !told) return pass_on(told);
  }
  return finish(*opened, options, std::move(*report), tell, work);
}

}  // namespace sonar
