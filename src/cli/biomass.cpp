// SPDX-License-Identifier: Apache-2.0
#include "pipeline/biomass/biomass.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

#include "base/number_text.h"
#include "cli/exit_codes.h"
#include "cli/log.h"
#include "cli/named_path.h"
#include "cli/numbers.h"
#include "cli/progress.h"
#include "cli/verb.h"
#include "pipeline/biomass/ts_table.h"

namespace sonar {
namespace {

struct BiomassArguments {
  std::string out;
  std::string lengths;
  std::string ts;
  std::string ts_table;
  std::string areas;
  std::string species;
  WeightLength weight;
  bool list_ts = false;
  bool print_ts = false;
};

int list_relations(const BiomassArguments& arguments) {
  const auto table = read_ts_table(arguments.ts_table);
  if (!table) return report(table.error());
  for (const TsRelation& relation : *table) fmt::print("{}\n", printable(ts_text(relation)));
  return kExitDone;
}

/// "1.2e+06 (8e+05 to 2e+06)".
std::string with_band(double value, double low, double high) {
  if (!std::isfinite(value)) return "unknown";
  if (!std::isfinite(low)) return fmt::format("{:.3g} (no band)", value);
  return fmt::format("{:.3g} ({:.2g} to {:.2g})", value, low, high);
}

void print_notes(const Biomass& done) {
  const FishChoice& fish = done.fish;
  if (fish.chosen.frequency_from_khz > done.sonar.to_khz || fish.chosen.frequency_to_khz < done.sonar.from_khz) {
    print_note(fmt::format("ts-frequency: {} was found at other frequencies than the sonar's {:.4g} to {:.4g} kHz",
                           printable(fish.chosen.name), done.sonar.from_khz, done.sonar.to_khz));
  }
  if (fish.chosen.aspect == TsAspect::dorsal) {
    print_note(fmt::format("ts-aspect: {} is of fish seen from above; a sideways beam sees their sides",
                           printable(fish.chosen.name)));
  }
  if (done.without_course > 0 && fish.chosen.directivity.known()) {
    print_note(fmt::format("ts-any-heading: {} without a known course; fish of any heading are meant there",
                           count_of(static_cast<std::size_t>(done.without_course), "school")));
  }
  if (done.cut > 0) {
    print_note(fmt::format("cut-schools: {} cut off by an edge in every ping: more fish than counted",
                           count_of(static_cast<std::size_t>(done.cut), "school")));
  }
  if (done.without_numbers > 0) {
    print_note(fmt::format("no-numbers: {} without numbers: backscatter or place is unknown",
                           count_of(static_cast<std::size_t>(done.without_numbers), "school")));
  }
  if (!done.integrated) {
    print_note("no-strata: there is no strata.csv of sonarx integrate: only the schools that were seen are counted");
  }
}

void print_result(const Biomass& done, const std::string& out) {
  print_notes(done);
  fmt::print("{}\n", printable(ts_text(done.fish.chosen)));
  if (done.fish.choices.size() > 1) {
    std::string names;
    for (const TsRelation& choice : done.fish.choices) names += (names.empty() ? "" : ", ") + choice.name;
    fmt::print("the band spans {}\n", printable(names));
  }
  for (const BiomassStratumRow& row : done.strata) {
    fmt::print("{}: {} seen, {} fish, {} t",
               row.level == "survey" ? "survey"
               : row.stratum.empty() ? "no stratum"
                                     : "stratum " + printable(row.stratum),
               count_of(static_cast<std::size_t>(row.n_schools), "school"),
               with_band(row.numbers_seen, row.numbers_seen_low, row.numbers_seen_high),
               with_band(row.biomass_seen_t, row.biomass_seen_low_t, row.biomass_seen_high_t));
    if (std::isfinite(row.numbers_per_nmi2)) {
      fmt::print("; {} fish nmi-2",
                 with_band(row.numbers_per_nmi2, row.numbers_per_nmi2_low, row.numbers_per_nmi2_high));
    }
    if (std::isfinite(row.numbers)) {
      fmt::print("; {} fish, {} t in {:g} nmi2", with_band(row.numbers, row.numbers_low, row.numbers_high),
                 with_band(row.biomass_t, row.biomass_low_t, row.biomass_high_t), row.area_nmi2);
    }
    fmt::print("\n");
  }
  for (const char* table : {"biomass.csv", "biomass_pings.csv", "biomass_strata.csv"}) {
    fmt::print("{}\n", (std::filesystem::path(out) / table).string());
  }
}

int run_biomass(const BiomassArguments& arguments) {
  if (arguments.print_ts) {
    fmt::print("{}", ts_presets_csv());
    return kExitDone;
  }
  if (arguments.list_ts) return list_relations(arguments);
  if (arguments.out.empty() || arguments.lengths.empty() || arguments.ts.empty()) {
    return report({ErrorCode::usage, "expected OUT, --lengths and --ts; see sonarx biomass --help", {}});
  }
  Work work(1);
  const CancelOnInterrupt watch(work);
  show_progress(work);
  BiomassOptions options;
  options.out = arguments.out;
  options.lengths = arguments.lengths;
  options.ts = arguments.ts;
  options.ts_table = arguments.ts_table;
  options.areas = arguments.areas;
  options.species = arguments.species;
  options.weight = arguments.weight;
  const auto done = biomass_folder(options, work);
  clear_progress();
  if (!done) return report(done.error());
  print_result(*done, arguments.out);
  return kExitDone;
}

}  // namespace

void add_biomass(CLI::App& app, VerbRunner& run) {
  const auto arguments = std::make_shared<BiomassArguments>();
  CLI::App* verb =
      app.add_subcommand("biomass", "Numbers and biomass of fish in schools, strata and the survey, with a band");
  verb->add_option("OUT", arguments->out, "Work folder of a run, and of integrate where strata are wanted")
      ->check(named_folder());
  verb->add_option("--lengths", arguments->lengths, "CSV length_cm,count (fish measured) or length_cm,fraction")
      ->check(named_file());
  verb->add_option("--ts", arguments->ts, "Name of a target strength relation; --list-ts shows them")
      ->check(some_name());
  verb->add_option("--ts-table", arguments->ts_table,
                   "CSV of relations in place of the program's; --print-ts makes one")
      ->check(named_file());
  verb->add_option("--weight-a", arguments->weight.a_g, "a of W = a L^b, in grams of cm; without it no biomass")
      ->check(within(1e-9, 1e3));
  verb->add_option("--weight-b", arguments->weight.b, "b of W = a L^b")
      ->check(within(0.1, 10.0))
      ->capture_default_str();
  verb->add_option("--species", arguments->species, "Only schools with this word in the column species")
      ->check(some_name());
  verb->add_option("--areas", arguments->areas, "CSV stratum,area_nmi2, for the fish in the areas of strata")
      ->check(named_file());
  CLI::Option* list =
      verb->add_flag("--list-ts", arguments->list_ts,
                     "Print the relations, each with frequency, aspect and source, and whether a figure is recalled");
  verb->add_flag("--print-ts", arguments->print_ts, "Print the program's relations as CSV, to edit")->excludes(list);
  verb->callback([arguments, &run] { run = [arguments] { return run_biomass(*arguments); }; });
}

}  // namespace sonar
