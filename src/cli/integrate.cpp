// SPDX-License-Identifier: Apache-2.0
#include "pipeline/integrate/integrate.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/number_text.h"
#include "cli/chosen_recipe.h"
#include "cli/described_flags.h"
#include "cli/exit_codes.h"
#include "cli/log.h"
#include "cli/named_path.h"
#include "cli/naming_option.h"
#include "cli/numbers.h"
#include "cli/progress.h"
#include "cli/verb.h"

namespace sonar {
namespace {

struct IntegrateArguments {
  std::vector<std::string> survey;
  std::string out;
  std::string transects;
  std::string recipe;
  Measured measured;
  IntegrateParams params;
  std::vector<DescribedFlags::Made> made;
  int jobs = 0;
};

constexpr std::array<OptionOf, 2> kOptions{{{"layer_bottom_m", "--layer-bottom-m"}, {"depth_max_m", "--depth-max-m"}}};

std::string with_error(double nasc, double se) {
  return fmt::format("{} m2 nmi-2, standard error {}", std::isfinite(nasc) ? fmt::format("{:.4g}", nasc) : "unknown",
                     std::isfinite(se) ? fmt::format("{:.2g}", se) : "unknown");
}

/// Of a layer also what it is if all fish are in it.
std::string nasc_text(const StratumRow& row) {
  const std::string heard = "NASC " + with_error(row.nasc_m2_nmi2, row.nasc_se_m2_nmi2);
  if (!std::isfinite(row.nasc_layer_m2_nmi2)) return heard;
  return heard + "; corrected for beam filling " + with_error(row.nasc_layer_m2_nmi2, row.nasc_layer_se_m2_nmi2);
}

void print_result(const Integrated& done, const std::string& out) {
  for (const std::string& name : done.left_out) {
    print_note(
        fmt::format("not-integrated: {}: it is of another sounder, or has no grid of fans and beams", printable(name)));
  }
  for (const std::string& name : done.without_pings) {
    print_note(fmt::format("transect-without-pings: {}: no ping lies in it, so that the tables have no row of it",
                           printable(name)));
  }
  for (const std::string& name : done.without_schools) {
    print_note(fmt::format("no-product: {}: {} has none, so that columns of schools are empty; sonarx run makes it",
                           printable(name), out));
  }
  std::int64_t reckoned = 0;
  for (const EffortRow& row : done.tables.effort) reckoned += row.edsu > 0 ? row.n_pings_without_position : 0;
  if (reckoned > 0) {
    print_note(
        fmt::format("distance-reckoned: {} on transects without a position; the distance sailed over them is dead "
                    "reckoning, see n_pings_without_position in effort.csv",
                    count_of(static_cast<std::size_t>(reckoned), "ping")));
  }
  if (const std::string extinction = extinction_text(done.tables); !extinction.empty()) {
    print_note("extinction-corrected: " + extinction);
  }
  for (const StratumRow& row : done.tables.strata) {
    if (row.level == "transect") continue;
    const std::string of = row.level == "survey" ? "survey"
                           : row.stratum.empty() ? "no stratum"
                                                 : "stratum " + printable(row.stratum);
    fmt::print("{}: {} ({} over {:.2f} nmi)\n", of, nasc_text(row),
               count_of(static_cast<std::size_t>(row.n_transects), "transect"), row.distance_nmi);
  }
  for (const char* table : {"effort.csv", "nasc.csv", "strata.csv"}) {
    fmt::print("{}\n", (std::filesystem::path(out) / table).string());
  }
}

int run_integrate(const IntegrateArguments& arguments) {
  Work work(arguments.jobs);
  const CancelOnInterrupt watch(work);
  show_progress(work);
  IntegrateOptions options;
  options.survey.assign(arguments.survey.begin(), arguments.survey.end());
  options.out = arguments.out;
  options.transects = arguments.transects;
  if (!arguments.recipe.empty() || !arguments.measured.empty()) {
    options.recipe = [&arguments] { return chosen_recipe(arguments.recipe, arguments.measured); };
  }
  options.params = arguments.params;
  const auto done = integrate_folder(options, work);
  clear_progress();
  if (!done) return report(naming_option(done.error(), kOptions));
  print_result(*done, arguments.out);
  return kExitDone;
}

}  // namespace

void add_integrate(CLI::App& app, VerbRunner& run) {
  const auto arguments = std::make_shared<IntegrateArguments>();
  CLI::App* verb = app.add_subcommand("integrate", "Echo integration: NASC over sailed distance, range and depth");
  verb->add_option("SURVEY", arguments->survey, "Folder of raw files, or raw files")->required()->check(named_path());
  verb->add_option("-o,--out", arguments->out,
                   "Work folder of a run, whose schools are told apart; the tables are written there")
      ->required()
      ->check(named_folder());
  verb->add_option("--transects", arguments->transects,
                   "CSV name,stratum,type,start_utc,stop_utc; type is transect or off (effort). Without it every "
                   "observation is a transect")
      ->check(named_file());
  verb->add_option("--recipe", arguments->recipe, "Parameters, where OUT has no products; else those of the run")
      ->check(named_file());
  add_measured_options(*verb, arguments->measured);
  DescribedFlags flags(*verb, "How water is cut", "", arguments->made);
  describe(flags, arguments->params);
  verb->add_option("-j,--jobs", arguments->jobs, "Threads; 0 = all of the machine's")->check(whole_within(0, 1024));
  verb->callback([arguments, &run] { run = [arguments] { return run_integrate(*arguments); }; });
}

}  // namespace sonar
