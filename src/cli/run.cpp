// SPDX-License-Identifier: Apache-2.0
#include "cli/run_survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/chosen_recipe.h"
#include "cli/exit_codes.h"
#include "cli/named_path.h"
#include "cli/progress.h"
#include "cli/verb.h"
#include "cli/whole_numbers.h"
#include "io/atomic_file.h"
#include "io/product.h"
#include "pipeline/journal/earlier.h"
#include "pipeline/journal/journals.h"
#include "pipeline/journal/manual.h"
#include "pipeline/stages/refused_echoes.h"
#include "pipeline/tasks/merge.h"
#include "pipeline/tasks/run.h"

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

/// The plan of a run that names its survey; written to OUT/plan.json.
struct Opened {
  Plan plan;
  SurveyFiles survey;
  std::vector<JournalLine> journal;
};

/// Journal lines whose ping is in no observation: listed, never moved.
void note_lost_choices(Opened& opened) {
  for (const JournalLine& line : opened.journal) {
    const bool found = std::any_of(opened.survey.observations.begin(), opened.survey.observations.end(),
                                   [&](const ObservationFiles& observation) {
                                     return ping_at(opened.survey, observation, line.ping_time).has_value();
                                   });
    if (found) continue;
    opened.survey.diagnostics.push_back({DiagnosticCode::decision_lost, opened.plan.session, -1, -1,
                                         fmt::format("choice {} ({}): the survey has no ping of {}", line_title(line.n),
                                                     line.command, iso_time(line.ping_time))});
  }
}

Result<Opened> open_for_run(const RunArguments& arguments, Work& work) {
  Opened opened;
  std::vector<std::filesystem::path> paths(arguments.survey.begin(), arguments.survey.end());
  opened.plan.session = arguments.session;
  if (!arguments.plan.empty()) {
    auto plan = read_plan(arguments.plan);
    if (!plan) return pass_on(plan);
    opened.plan = std::move(*plan);
    paths.assign(opened.plan.survey.begin(), opened.plan.survey.end());
  }
  auto journal = opened.plan.session.empty() ? Result<Journal>(Journal{}) : read_session(opened.plan.session);
  if (!journal) return pass_on(journal);
  if (arguments.plan.empty()) {
    auto recipe = recipe_for(arguments, *journal);
    if (!recipe) return pass_on(recipe);
    opened.plan.recipe = std::move(*recipe);
  }
  const Recipe& recipe = opened.plan.recipe;
  auto survey = open_survey(paths, recipe.survey, recipe.navigation, IndexCache::of_user(), work);
  if (!survey) return pass_on(survey);
  if (auto some = require_files(*survey, paths); !some) return pass_on(some);
  opened.survey = std::move(*survey);
  opened.survey.diagnostics.insert(opened.survey.diagnostics.end(), journal->diagnostics.begin(),
                                   journal->diagnostics.end());
  opened.journal = effective_lines(journal->lines);
  note_lost_choices(opened);
  return opened;
}

Result<void> write_plan(Opened& opened, const RunArguments& arguments, const RunOptions& options) {
  if (auto ours = require_no_newer_plan(options.out); !ours) return ours;
  const std::vector<std::filesystem::path> paths(arguments.survey.begin(), arguments.survey.end());
  opened.plan = make_plan(opened.survey, paths, arguments.session, opened.plan.recipe,
                          {options.pings, opened.journal, options.program_version});
  if (auto possible = require_possible(opened.plan, options); !possible) return possible;
  if (auto held = set_aside(options.out, opened.plan); !held) return held;
  return write_file(options.out / "plan.json", plan_text(opened.plan));
}

/// Why a file gave nothing; empty where it did.
std::string why_nothing_came_of(const RawIndex& index) {
  if (index.gives_samples()) {
    const bool unusable = index.pings.empty() && index.datagrams.count("RAW0") > 0;
    return unusable ? "none of its samples could be used; sonarx info tells why" : "";
  }
  for (const Diagnostic& note : index.diagnostics) {
    if (note.code == DiagnosticCode::not_recognised || note.code == DiagnosticCode::format_not_read) return note.text;
  }
  return fmt::format("format {} is not read by this version", name(index.format));
}

/// Files that gave nothing, each with the reason.
std::vector<RunFailure> failed_files(const SurveyFiles& survey) {
  std::vector<RunFailure> failures;
  for (const SurveyFile& file : survey.files) {
    const std::string why = why_nothing_came_of(file.index);
    if (file.error) {
      failures.push_back({std::nullopt, *file.error});
    } else if (!why.empty()) {
      failures.push_back({std::nullopt, {ErrorCode::format, why, {file.path.string(), 0}}});
    }
  }
  return failures;
}

void print_failures(const SurveyFiles& survey, const RunReport& report) {
  const auto told_below = [&](const Diagnostic& note) {
    return note.code == DiagnosticCode::unreadable &&
           std::any_of(report.failures.begin(), report.failures.end(),
                       [&](const RunFailure& failure) { return failure.error.where.file == note.file; });
  };
  for (const Diagnostic& note : survey.diagnostics) {
    if (told_below(note)) continue;
    fmt::print(stderr, "note {}: {}\n", name(note.code),
               to_line({ErrorCode::format, note.text, {note.file, note.offset, note.ping_index}}));
  }
  for (const RunFailure& failure : report.failures) {
    const std::string of = failure.observation ? printable(*failure.observation) + ": " : "";
    fmt::print(stderr, "sonarx: {}{}\n", of, to_line(failure.error));
  }
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

int finish(const Opened& opened, const RunOptions& options, RunReport report, Work& work) {
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
  for (const std::string& line : note_lines(*merged)) fmt::print(stderr, "{}\n", line);
  fmt::print("{}", merge_text(*merged, options.out));
  if (opened.plan.tasks.empty()) fmt::print(stderr, "note: no file holds a ping; there is no observation\n");
  if (!looks_for_schools(opened)) {
    fmt::print(stderr,
               "note: no schools were looked for: the recipe says \"automatic\": false, and no session selects one\n");
  }
  if (report.failures.empty()) return kExitDone;
  return report.done.empty() && report.skipped.empty() ? kExitFailed : kExitPartly;
}

}  // namespace

Result<void> require_no_newer_plan(const std::filesystem::path& out) {
  std::error_code absent;
  if (!std::filesystem::exists(out / "plan.json", absent)) return {};
  const auto plan = read_plan(out / "plan.json");
  if (!plan && plan.error().code == ErrorCode::newer_version) return pass_on(plan);
  return {};
}

Result<Recipe> recipe_for(const RunArguments& arguments, const Journal& journal) {
  if (arguments.recipe.empty() && arguments.measured.empty() && !journal.recipe.empty()) {
    auto recipe = recipe_from_text(journal.recipe);
    if (!recipe) return fail(recipe.error().code, "its recipe: " + recipe.error().text, {arguments.session});
    return recipe;
  }
  return chosen_recipe(arguments.recipe, arguments.measured);
}

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
  const auto done = run_plan(opened->plan, opened->survey, opened->journal, options, work);
  if (!done) {
    clear_progress();
    return report(done.error());
  }
  if (arguments.why) {
    clear_progress();
    if (auto told = print_refusals(options.out, *done); !told) return report(told.error());
  }
  return finish(*opened, options, *done, work);
}

void add_run(CLI::App& app, VerbRunner& run) {
  const auto arguments = std::make_shared<RunArguments>();
  CLI::App* verb = app.add_subcommand("run", "Process a survey: schools, masks, tables and the map");
  verb->add_option("SURVEY", arguments->survey, "Folder of raw files, or raw files");
  auto* out = verb->add_option("--out", arguments->out, "Work folder for products and tables")->check(named_path());
  verb->add_option("--recipe", arguments->recipe, "Parameters of every stage (see sonarx recipe)");
  add_measured_options(*verb, arguments->measured);
  verb->add_option("--session", arguments->session,
                   "Journal of human choices to replay, or the folder of several people's");
  verb->add_option("--jobs", arguments->jobs, "Threads; 0 = what the machine has")->check(CLI::Range(0, 1024));
  verb->add_option("--only", arguments->only, "One observation, e.g. obs-0002")->check(some_name());
  verb->add_option("--pings", arguments->pings,
                   "Ping indices A:B of each observation, both included, from 0; shorter ones give what they have");
  verb->add_flag("--remeasure", arguments->remeasure, "Keep masks and decisions, recompute every number");
  verb->add_flag("--why", arguments->why, "Tell every echo that stood out and is no school, with the reason");
  auto* plan = verb->add_option("--plan", arguments->plan, "OUT/plan.json made by sonarx plan");
  auto* task =
      verb->add_option("--task", arguments->task, "Which task of the plan, from 0")->check(CLI::Range(0, kMostTasks));
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

void add_plan(CLI::App& app, VerbRunner& run) {
  const auto arguments = std::make_shared<RunArguments>();
  CLI::App* verb = app.add_subcommand("plan", "Cut the work of run into independent tasks");
  verb->add_option("SURVEY", arguments->survey, "Folder of raw files, or raw files")->required();
  verb->add_option("--out", arguments->out, "Work folder for products and tables")->required()->check(named_path());
  verb->add_option("--recipe", arguments->recipe, "Parameters of every stage (see sonarx recipe)");
  add_measured_options(*verb, arguments->measured);
  verb->add_option("--session", arguments->session,
                   "Journal of human choices to replay, or the folder of several people's");
  verb->add_option("--jobs", arguments->jobs, "Threads; 0 = what the machine has")->check(CLI::Range(0, 1024));
  verb->callback([arguments, &run] {
    run = [arguments] {
      Work work(arguments->jobs);
      const CancelOnInterrupt watch(work);
      show_progress(work);
      auto opened = open_for_run(*arguments, work);
      clear_progress();
      if (!opened) return report(opened.error());
      RunOptions options;
      options.out = arguments->out;
      options.program_version = SONAR_VERSION;
      if (auto outside = require_outside_raw(opened->survey, options.out); !outside) return report(outside.error());
      if (auto written = write_plan(*opened, *arguments, options); !written) return report(written.error());
      const std::vector<RunFailure> failed = failed_files(opened->survey);
      print_failures(opened->survey, {{}, {}, failed});
      if (opened->plan.tasks.empty()) {
        fmt::print("0 tasks: no file holds a ping\n");
      } else {
        fmt::print("{} tasks, 0 to {}: sonarx run --plan {} --task K, then sonarx merge {}\n",
                   opened->plan.tasks.size(), opened->plan.tasks.size() - 1, (options.out / "plan.json").string(),
                   options.out.string());
      }
      return failed.empty() ? kExitDone : kExitPartly;
    };
  });
}

}  // namespace sonar
