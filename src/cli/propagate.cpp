// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/number_text.h"
#include "cli/chosen_recipe.h"
#include "cli/exit_codes.h"
#include "cli/named_path.h"
#include "cli/numbers.h"
#include "cli/one_of.h"
#include "cli/progress.h"
#include "cli/verb.h"
#include "io/atomic_file.h"
#include "io/product_file.h"
#include "model/school_totals.h"
#include "pipeline/commands/command.h"
#include "pipeline/journal/manual.h"
#include "pipeline/recipe/transfer_function_json.h"
#include "pipeline/tasks/merge.h"
#include "pipeline/tasks/run.h"

namespace sonar {
namespace {

struct PropagateArguments {
  std::string survey;
  std::string observation;
  std::vector<std::string> seeds;
  double tolerance_db = 0.0;
  double tolerance_opacity = 0.0;
  std::string mode;  // empty = the recipe's
  std::int64_t reach = -1;
  std::string curve;
  std::string recipe;
  Measured measured;
  std::string operator_name;
  std::string out;
  int jobs = 0;
};

constexpr double kLeastToleranceDb = 0.1;
constexpr double kMostToleranceDb = 60.0;

struct Seed {
  std::int64_t ping = 0;
  std::int64_t fan = 0;
  std::int64_t beam = 0;
  std::int64_t sample = 0;
};

Result<Seed> parse_seed(const std::string& text) {
  const auto numbers = whole_numbers(text, ',');
  if (!numbers || numbers->size() != 4) {
    return fail(ErrorCode::usage, fmt::format("--seed {}: expected PING,FAN,BEAM,SAMPLE", text));
  }
  return Seed{(*numbers)[0], (*numbers)[1], (*numbers)[2], (*numbers)[3]};
}

Result<std::vector<Seed>> parse_seeds(const PropagateArguments& arguments, const ObservationFiles& observation) {
  std::vector<Seed> seeds;
  for (const std::string& text : arguments.seeds) {
    const auto seed = parse_seed(text);
    if (!seed) return pass_on(seed);
    if (seed->ping < 0 || seed->ping >= static_cast<std::int64_t>(observation.pings.size())) {
      return fail(ErrorCode::usage,
                  fmt::format("--seed {}: {} has pings 0 to {}", text, observation.name, observation.pings.size() - 1));
    }
    if (seed->fan < 0 || seed->fan >= observation.grid->fans() || seed->beam < 0 ||
        seed->beam >= observation.grid->beams() || seed->sample < 0 || seed->sample >= observation.range.count) {
      return fail(ErrorCode::usage,
                  fmt::format("--seed {}: the grid has {} fans, {} beams, {} samples", text, observation.grid->fans(),
                              observation.grid->beams(), observation.range.count));
    }
    if (!seeds.empty() && seeds.front().ping != seed->ping) {
      return fail(ErrorCode::usage, fmt::format("--seed {}: all seeds of one selection lie in one ping", text));
    }
    seeds.push_back(*seed);
  }
  return seeds;
}

/// The paper grows in opacity and the default one-sided in dB: a tolerance in the other's unit is turned by the growth
/// curve's mean slope.
Result<void> take_tolerance(const PropagateArguments& arguments, PropagateCommand& command) {
  const bool in_opacity = command.mode == GrowMode::paper;
  const bool told_in_opacity = arguments.tolerance_opacity > 0.0;
  if (!told_in_opacity && !(arguments.tolerance_db > 0.0)) return {};
  const double told = told_in_opacity ? arguments.tolerance_opacity : arguments.tolerance_db;
  const auto [option, other] = told_in_opacity ? std::pair{"--tolerance-opacity", "--tolerance-db"}
                                               : std::pair{"--tolerance-db", "--tolerance-opacity"};
  double tolerance = told;
  if (in_opacity != told_in_opacity) {
    const auto slope = command.growth_curve.mean_db_per_opacity();
    if (!slope) {
      return fail(ErrorCode::usage, fmt::format("{} {}: the growth curve ends no higher than it begins, so dB and "
                                                "opacity cannot be turned into each other; name {} in this mode",
                                                option, told, other));
    }
    tolerance = told_in_opacity ? told * *slope : told / *slope;
  }
  const double least = in_opacity ? 0.0 : kLeastToleranceDb;
  const double most = in_opacity ? 1.0 : kMostToleranceDb;
  if (tolerance < least || tolerance > most) {
    return fail(ErrorCode::usage, fmt::format("{} {}: is {:.4g} {} in this mode, expected {} .. {}", option, told,
                                              tolerance, in_opacity ? "of opacity" : "dB", least, most));
  }
  if (in_opacity) {
    command.grow.tolerance_opacity = tolerance;
  } else {
    command.grow.tolerance_db = command.tracked.tolerance_db = tolerance;
  }
  return {};
}

Result<PropagateCommand> make_command(const PropagateArguments& arguments, const Recipe& recipe) {
  std::optional<GrowMode> mode;
  if (!arguments.mode.empty()) mode = arguments.mode == "paper" ? GrowMode::paper : GrowMode::tracked;
  PropagateCommand command = recipe_propagation(recipe, mode);
  command.reach = arguments.reach;
  if (!arguments.curve.empty()) {
    auto curve = read_transfer_function(arguments.curve);
    if (!curve) return pass_on(curve);
    command.growth_curve = std::move(*curve);
  }
  if (auto taken = take_tolerance(arguments, command); !taken) return pass_on(taken);
  return completed(std::move(command));
}

void print_school(const ObservationProduct& product, std::int64_t reach) {
  for (const SchoolRow& row : product.schools) {
    // Where the background is louder than the echo there is no mean.
    const std::string sv_text = std::isfinite(row.sv_mean_db) ? fmt::format("{:.1f} dB", row.sv_mean_db) : "unknown";
    fmt::print("school: {}, {} to {}, volume {:.0f} m3, mean Sv {}, backscatter {:.3g} m2\n",
               count_of(static_cast<std::size_t>(row.n_pings), "ping"), iso_time(row.first_time_utc),
               iso_time(row.last_time_utc), row.volume_m3, sv_text, echo_m2(row));
  }
  for (const Diagnostic& note : product.diagnostics) {
    if (note.code == DiagnosticCode::propagation_ended) fmt::print("{}\n", note.text);
  }
  for (const SchoolRow& row : product.schools) {
    if (row.ended_at_reach.empty()) continue;
    const char* sides =
        ends_first(row.ended_at_reach) ? ends_last(row.ended_at_reach) ? "both ways" : "backwards" : "forwards";
    fmt::print("goes on beyond {} {}: continue? (a larger --reach, or none)\n",
               count_of(static_cast<std::size_t>(reach), "ping"), sides);
  }
}

/// The reason why the click could not be carried out; null where it was.
const Diagnostic* refusal(const ObservationProduct& product) {
  const auto found = std::find_if(product.diagnostics.begin(), product.diagnostics.end(),
                                  [](const Diagnostic& note) { return note.code == DiagnosticCode::decision_lost; });
  return found == product.diagnostics.end() ? nullptr : &*found;
}

/// Whether the text began so; what follows is left of it.
bool take_off(std::string& text, const std::string& beginning) {
  if (!text.starts_with(beginning)) return false;
  text.erase(0, beginning.size());
  return true;
}

/// "--seed 6,6,7,3: has no data": the seed that is refused, as the user wrote it. That it is a line of a journal is no matter
/// of theirs.
std::string refusal_text(const JournalLine& line, std::string why, const std::vector<std::string>& seeds) {
  take_off(why, said_of(line));
  for (const std::string& text : seeds) {
    const auto seed = parse_seed(text);
    if (!seed) continue;
    const auto place = fmt::format("the seed at fan {}, beam {}, sample {} ", seed->fan, seed->beam, seed->sample);
    if (take_off(why, place)) return fmt::format("--seed {}: {}", text, why);
  }
  return fmt::format("--seed {}: {}", fmt::join(seeds, " "), why);
}

struct Clicked {
  std::vector<std::filesystem::path> paths;
  SurveyFiles survey;
  const ObservationFiles* observation = nullptr;
  PropagateCommand command;
  std::int64_t ping_index = 0;
};

Result<Clicked> click(const PropagateArguments& arguments, const Recipe& recipe, Work& work) {
  Clicked clicked;
  clicked.paths = {arguments.survey};
  auto survey = open_survey(clicked.paths, recipe.survey, recipe.navigation, IndexCache::of_user(), work);
  if (!survey) return pass_on(survey);
  clicked.survey = std::move(*survey);
  clicked.observation = clicked.survey.find(arguments.observation);
  if (clicked.observation == nullptr) {
    return fail(ErrorCode::usage, fmt::format("no observation {} in {}", arguments.observation, arguments.survey));
  }
  if (!clicked.observation->grid) {
    return fail(ErrorCode::usage, arguments.observation + " has no grid of fans and beams to select in");
  }
  auto command = make_command(arguments, recipe);
  if (!command) return pass_on(command);
  clicked.command = std::move(*command);
  const auto seeds = parse_seeds(arguments, *clicked.observation);
  if (!seeds) return pass_on(seeds);
  clicked.ping_index = seeds->front().ping;
  for (const Seed& seed : *seeds) {
    const std::int64_t row = seed.fan * clicked.observation->grid->beams() + seed.beam;
    clicked.command.seeds.push_back(
        {clicked.observation->grid->channel[static_cast<std::size_t>(row)], static_cast<int>(seed.sample)});
  }
  return clicked;
}

Result<void> write_outcome(const Clicked& clicked, const JournalLine& line, const ObservationProduct& product,
                           const Recipe& recipe, const RunOptions& options) {
  const auto file = product_path(options.out, product.observation);
  if (auto written = write_product(product, file, Beside::own_folder); !written) return written;
  Journal head;
  head.recipe_hash = product.recipe_hash;
  head.recipe = product.recipe_json;
  head.files = input_files(clicked.survey, *clicked.observation);
  const std::string text = journal_head_text(head) + "\n" + journal_text(line) + "\n";
  if (auto written = write_file(options.out / "session.jsonl", text); !written) return written;
  Plan plan = make_plan(clicked.survey, clicked.paths, options.out / "session.jsonl", recipe,
                        {{}, std::span(&line, 1), SONAR_VERSION});
  std::erase_if(plan.tasks, [&](const PlanTask& task) { return task.observation != product.observation; });
  return write_file(options.out / "plan.json", plan_text(plan));
}

/// OUT holds this one school: results of a run, or of another click, are not overwritten.
Result<void> require_own_folder(const std::filesystem::path& out, const JournalLine& line) {
  std::error_code absent;
  if (!std::filesystem::exists(out / "plan.json", absent)) return {};
  const auto journal = read_journal((out / "session.jsonl").string());
  const bool same = journal && journal->lines.size() == 1 && journal->lines[0].ping_time == line.ping_time &&
                    journal->lines[0].args == line.args;
  if (same) return {};
  return fail(ErrorCode::usage, "holds other results; name a folder of its own", {out.string()});
}

int propagate_verb(const PropagateArguments& arguments) {
  Work work(arguments.jobs);
  const CancelOnInterrupt watch(work);
  show_progress(work);
  auto recipe = chosen_recipe(arguments.recipe, arguments.measured);
  if (!recipe) return report(recipe.error());
  recipe->automatic = false;
  const auto clicked = click(arguments, *recipe, work);
  if (!clicked) return report(clicked.error());
  if (auto outside = require_outside_raw(clicked->survey, arguments.out); !outside) return report(outside.error());
  const TimeNs now =
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch()).count();
  const TimeNs ping_time =
      clicked->survey.ping_time(*clicked->observation, static_cast<std::size_t>(clicked->ping_index));
  const JournalLine line = line_of({1, now, arguments.operator_name, ping_time, clicked->command});
  if (auto own = require_own_folder(arguments.out, line); !own) return report(own.error());
  if (auto space = require_free_space(arguments.out, kLeastFreeBytes); !space) return report(space.error());
  RunOptions options;
  options.out = arguments.out;
  const ObserveOptions observe_options{{}, std::span(&line, 1), SONAR_VERSION};
  const auto product = observe(clicked->survey, *clicked->observation, *recipe, observe_options, work);
  clear_progress();
  if (!product) return report(product.error());
  if (const Diagnostic* why = refusal(*product)) {
    return report({ErrorCode::bad_parameter, refusal_text(line, why->text, arguments.seeds), {}});
  }
  if (auto written = write_outcome(*clicked, line, *product, *recipe, options); !written)
    return report(written.error());
  const auto merged = merge_after(options.out, RunReport{}, work);
  if (!merged) return report(merged.error());
  print_school(*product, arguments.reach);
  return kExitDone;
}

}  // namespace

void add_propagate(CLI::App& app, VerbRunner& run) {
  const auto arguments = std::make_shared<PropagateArguments>();
  CLI::App* verb = app.add_subcommand(
      "propagate", "Grow a school from a seed, as a click in the window does, and propagate it through time both ways");
  verb->add_option("SURVEY", arguments->survey, "Folder of raw files, or a raw file")->required();
  verb->add_option("--observation", arguments->observation, "Observation in which the seed lies, e.g. obs-0001")
      ->required()
      ->check(some_name());
  verb->add_option("--seed", arguments->seeds,
                   "Voxel to grow from, counted from 0: fans from the deepest, beams clockwise; several are joined")
      ->required()
      ->type_name("PING,FAN,BEAM,SAMPLE");
  auto* in_db =
      verb->add_option(
              "--tolerance-db", arguments->tolerance_db,
              "dB below the reference (else the recipe's); mode paper turns it into opacity by the growth curve")
          ->check(within(kLeastToleranceDb, kMostToleranceDb));
  auto* in_opacity =
      verb->add_option("--tolerance-opacity", arguments->tolerance_opacity,
                       "Difference of opacity (else the recipe's); mode tracked turns it into dB by the growth curve")
          ->check(within(0.0001, 1.0));
  in_db->excludes(in_opacity);
  verb->add_option("--mode", arguments->mode, "tracked, or paper: as the 2007 paper did")
      ->check(one_of({"tracked", "paper"}));
  verb->add_option("--reach", arguments->reach, "Pings to each side; default: all")->check(whole_within(0, 1000000));
  verb->add_option("--transfer-function", arguments->curve, "Growth curve TF.json")->check(named_file());
  verb->add_option("--recipe", arguments->recipe, "Parameters of every stage (see sonarx recipe)")->check(named_file());
  add_measured_options(*verb, arguments->measured);
  verb->add_option("--operator", arguments->operator_name, "Who clicked, for the journal")->type_name("NAME");
  verb->add_option("-o,--out", arguments->out, "Work folder for products and tables")
      ->required()
      ->check(named_folder());
  verb->add_option("-j,--jobs", arguments->jobs, "Threads; 0 = all of the machine's")->check(whole_within(0, 1024));
  verb->callback([arguments, &run] { run = [arguments] { return propagate_verb(*arguments); }; });
}

}  // namespace sonar
