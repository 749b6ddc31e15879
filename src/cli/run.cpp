// SPDX-License-Identifier: Apache-2.0
#include "cli/run_survey.h"

#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "cli/chosen_recipe.h"
#include "cli/exit_codes.h"
#include "cli/log.h"
#include "cli/merged_text.h"
#include "cli/named_path.h"
#include "cli/numbers.h"
#include "cli/progress.h"
#include "cli/verb.h"
#include "pipeline/tasks/run_survey.h"

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

}  // namespace

Result<Recipe> recipe_for(const RunArguments& arguments, const Journal& journal) {
  if (!arguments.recipe.empty() || journal.recipe.empty()) {
    return chosen_recipe(arguments.recipe, arguments.measured);
  }
  auto recipe = recipe_from_text(journal.recipe);
  if (!recipe) return fail(ErrorCode::format, "its recipe: " + recipe.error().text, {arguments.session});
  return with_measured(std::move(*recipe), arguments.measured);
}

RunSources sources_of(const RunArguments& arguments) {
  return {{arguments.survey.begin(), arguments.survey.end()},
          arguments.session,
          [&arguments](const Journal& journal) { return recipe_for(arguments, journal); },
          arguments.plan};
}

int run_verb(const RunArguments& arguments) {
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
  const auto print = [&arguments](const RunLine& line) {
    clear_progress();
    if (!arguments.json || line.kind != RunLine::Kind::result) print_line(line);
  };
  const auto done = run_survey(sources_of(arguments), options, {print, {}, arguments.why}, work);
  clear_progress();
  if (!done) return report(done.error());
  if (arguments.json && done->merged) {
    if (auto told = print_merge(*done->merged, options.out, true); !told) return report(told.error());
  }
  if (done->whole()) return kExitDone;
  return arguments.has_task || done->nothing() ? kExitFailed : kExitPartly;
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
    run = [arguments] { return run_verb(*arguments); };
  });
}

}  // namespace sonar
