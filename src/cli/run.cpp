// SPDX-License-Identifier: Apache-2.0
#include "cli/run_survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/chosen_recipe.h"
#include "cli/exit_codes.h"
#include "cli/log.h"
#include "cli/merged_text.h"
#include "cli/named_path.h"
#include "cli/numbers.h"
#include "cli/open_for_run.h"
#include "cli/progress.h"
#include "cli/verb.h"
#include "io/atomic_file.h"
#include "io/product_file.h"
#include "pipeline/journal/earlier.h"
#include "pipeline/journal/journals.h"
#include "pipeline/journal/manual.h"
#include "pipeline/stages/refused_echoes.h"
#include "pipeline/tasks/merge.h"
#include "pipeline/tasks/run.h"
#include "pipeline/tasks/task_record.h"

namespace sonar {
namespace {

/// Far beyond a plan's size; a larger number is a slip.
constexpr int kMostTasks = 10'000'000;

/// "A:B", both inclusive from 0.
Result<std::optional<PingSelection>> parse_pings(const std::string& text) {
  if (text.empty()) return std::optional<PingSelection>{};
  const auto numbers = whole_numbers(text, ':');
  if (!numbers || numbers->size() != 2 || (*numbers)[0] < 0 || (*numbers)[1] < (*numbers)[0]) {
    return fail(ErrorCode::usage, fmt::format("--pings {}: expected A:B with 0 <= A <= B", text));
  }
  return std::optional<PingSelection>{PingSelection{(*numbers)[0], (*numbers)[1]}};
}

/// Whether a run could find any school at all: by itself, or by a choice of the session.
bool looks_for_schools(const Opened& opened) {
  if (opened.plan.recipe.automatic) return true;
  constexpr std::array<std::string_view, 4> kSelects{"propagate", "grow", "brush", "detect"};
  return std::any_of(opened.journal.begin(), opened.journal.end(), [&](const JournalLine& line) {
    return std::find(kSelects.begin(), kSelects.end(), line.command) != kSelects.end();
  });
}

/// What the products of these observations refused, a line each.
Result<void> print_refusals(const std::filesystem::path& out, const RunReport& report) {
  std::vector<std::string> names = report.done;
  names.insert(names.end(), report.skipped.begin(), report.skipped.end());
  std::ranges::sort(names);
  for (const std::string& observation : names) {
    const auto product = read_product(product_path(out, observation));
    if (!product) return pass_on(product);
    for (const std::string& line : refusal_lines(*product)) fmt::print("{}\n", line);
  }
  return {};
}

int finish(const Opened& opened, const RunOptions& options, RunReport report, bool json, Work& work) {
  if (options.task) {
    clear_progress();
    print_failures(opened.survey, report);
    return report.failures.empty() ? kExitDone : kExitFailed;
  }
  const std::vector<RunFailure> files = failed_files(opened.survey);
  report.failures.insert(report.failures.end(), files.begin(), files.end());
  const auto merged = merge_after(options.out, report, work, options.only);
  clear_progress();
  print_failures(opened.survey, report);
  if (!merged) return sonar::report(merged.error());
  for (const std::string& line : note_lines(*merged)) print_note(line);
  if (auto told = print_merge(*merged, options.out, json); !told) return sonar::report(told.error());
  if (opened.plan.tasks.empty()) print_note("no-observation: no file holds a ping");
  if (!looks_for_schools(opened)) {
    print_note(
        "no-detection: schools were not detected: the recipe says \"automatic\": false, and no session selects one");
  }
  if (report.failures.empty()) return kExitDone;
  return report.done.empty() && report.skipped.empty() ? kExitFailed : kExitPartly;
}

/// The observation of the one task that is asked for; empty where all are.
std::string task_name(const Opened& opened, const RunOptions& options) {
  return options.task && *options.task < opened.plan.tasks.size() ? opened.plan.tasks[*options.task].observation : "";
}

TimeNs utc_now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

/// For `sonarx status`: that it cannot be noted hinders no task.
void begin_task(const Opened& opened, const RunOptions& options) {
  const std::string name = task_name(opened, options);
  if (!name.empty()) (void)write_record(options.out, name, record_of_this_process(utc_now()));
}

void end_task(const Opened& opened, const RunOptions& options, const Result<RunReport>& done) {
  const std::string name = task_name(opened, options);
  if (name.empty()) return;
  TaskRecord record = record_of_this_process(utc_now());
  if (!done) record.error = to_line(done.error());
  if (done && !done->failures.empty()) record.error = to_line(done->failures.front().error);
  if (record.error.empty()) {
    remove_record(options.out, name);
  } else {
    (void)write_record(options.out, name, record);
  }
}

}  // namespace

int run_survey(const RunArguments& arguments) {
  if (arguments.plan.empty() == arguments.survey.empty()) {
    return report({ErrorCode::usage, "run needs a SURVEY, or --plan with --task", {}});
  }
  const auto pings = parse_pings(arguments.pings);
  if (!pings) return report(pings.error());
  Work work(arguments.jobs);
  const CancelOnInterrupt watch(work);
  show_progress(work);
  RunOptions options;
  options.out = arguments.plan.empty() ? std::filesystem::path(arguments.out)
                                       : std::filesystem::absolute(arguments.plan).parent_path();
  if (!arguments.only.empty()) options.only = arguments.only;
  if (arguments.has_task) options.task = static_cast<std::size_t>(arguments.task);
  options.pings = *pings;
  options.remeasure = arguments.remeasure;
  options.program_version = SONAR_VERSION;
  auto opened = open_for_run(arguments, work);
  if (!opened) return report(opened.error());
  if (auto outside = require_outside_raw(opened->survey, options.out); !outside) return report(outside.error());
  if (!arguments.plan.empty()) options.pings = opened->plan.pings;
  if (arguments.plan.empty()) {
    if (auto written = write_plan(*opened, arguments, options); !written) return report(written.error());
  }
  begin_task(*opened, options);
  const auto done = run_plan(opened->plan, opened->survey, opened->journal, options, work);
  end_task(*opened, options, done);
  if (!done) {
    clear_progress();
    return report(done.error());
  }
  if (arguments.why) {
    clear_progress();
    if (auto told = print_refusals(options.out, *done); !told) return report(told.error());
  }
  return finish(*opened, options, *done, arguments.json, work);
}

void add_run(CLI::App& app, VerbRunner& run) {
  const auto arguments = std::make_shared<RunArguments>();
  CLI::App* verb = app.add_subcommand("run", "Process a survey: schools, masks, tables and the map");
  verb->add_option("SURVEY", arguments->survey, "Folder of raw files, or raw files");
  auto* out =
      verb->add_option("-o,--out", arguments->out, "Work folder for products and tables")->check(named_folder());
  verb->add_option("--recipe", arguments->recipe, "Parameters of every stage (see sonarx recipe)")->check(named_file());
  add_measured_options(*verb, arguments->measured);
  verb->add_option("--session", arguments->session, "Journal of decisions to replay, or the folder of several people's")
      ->check(named_path());
  verb->add_option("-j,--jobs", arguments->jobs, "Threads; 0 = all of the machine's")->check(whole_within(0, 1024));
  verb->add_option("--only", arguments->only, "Only this observation, e.g. obs-0002")->check(some_name());
  verb->add_option(
          "--pings", arguments->pings,
          "Ping indices of each observation, both included, from 0; shorter observations give the pings they have")
      ->type_name("A:B");
  verb->add_flag("--remeasure", arguments->remeasure, "Keep masks and decisions, recompute every number");
  verb->add_flag("--why", arguments->why,
                 "List every echo above the background that was judged not to be a school, with the reason");
  verb->add_flag("--json", arguments->json, "Print what stands in OUT/survey.json instead of a text");
  auto* plan = verb->add_option("--plan", arguments->plan, "OUT/plan.json made by sonarx plan")->check(named_file());
  auto* task =
      verb->add_option("--task", arguments->task, "Which task of the plan, from 0")->check(whole_within(0, kMostTasks));
  for (const char* own : {"--recipe", "--calibration", "--session", "--only", "--pings", "--remeasure"}) {
    plan->excludes(verb->get_option(own));  // the plan says these
  }
  task->needs(plan);
  plan->needs(task);
  out->excludes(plan);
  verb->callback([arguments, task, &run, out, plan] {
    if (out->count() == 0 && plan->count() == 0) throw CLI::RequiredError("--out");
    arguments->has_task = task->count() > 0;
    run = [arguments] { return run_survey(*arguments); };
  });
}

}  // namespace sonar
