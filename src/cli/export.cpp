// SPDX-License-Identifier: Apache-2.0
#include "pipeline/exports/export.h"

#include <fmt/format.h>

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/exit_codes.h"
#include "cli/log.h"
#include "cli/named_path.h"
#include "cli/naming_option.h"
#include "cli/numbers.h"
#include "cli/one_of.h"
#include "cli/progress.h"
#include "cli/verb.h"

namespace sonar {
namespace {

struct ExportArguments {
  std::string out;
  std::string format;
  std::string dest;
  std::string survey;
  ReduceParams reduce;
  SeabedRasterParams seabed;
  bool no_formulas = false;
  int count_from = 1;
  int jobs = 0;
};

constexpr std::array<OptionOf, 5> kOptions{{{"margin_samples", "--margin-samples"},
                                            {"margin_beams", "--margin-beams"},
                                            {"margin_fans", "--margin-fans"},
                                            {"margin_pings", "--margin-pings"},
                                            {"coarsen_beams", "--coarsen"}}};

/// Option, and the format that it belongs to.
constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kOptionsOfOneFormat{
    {{"--cell-m", "seabed"}, {"--geographic", "seabed"}, {"--no-formulas", "csv"}, {"--count-from", "lsss"}}};

int run_export(const ExportArguments& arguments) {
  Work work(arguments.jobs);
  const CancelOnInterrupt watch(work);
  show_progress(work);
  const ExportOptions options{
      arguments.out,    arguments.format,
      arguments.dest,   arguments.survey,
      arguments.reduce, arguments.no_formulas ? CsvTexts::no_formulas : CsvTexts::as_they_are,
      arguments.seabed, arguments.count_from == 0 ? LsssNumbering::from_zero : LsssNumbering::from_one};
  const auto done = export_products(options, work);
  clear_progress();
  if (!done) return report(naming_option(done.error(), kOptions));
  for (const auto& file : done->files) fmt::print("{}\n", file.string());
  for (const std::string& name : done->without_grid) {
    print_note(fmt::format("no-grid: {}: left out, for it has no grid of fans and beams", printable(name)));
  }
  return kExitDone;
}

}  // namespace

void add_export(CLI::App& app, VerbRunner& run) {
  const auto arguments = std::make_shared<ExportArguments>();
  CLI::App* verb = app.add_subcommand("export", "Write products in another program's format");
  std::string formats = "Format:";
  std::vector<std::string> names;
  for (const ExportFormat& format : export_formats()) {
    formats += fmt::format("\n{} - {}", format.name, format.text);
    names.emplace_back(format.name);
  }
  verb->add_option("OUT", arguments->out, "Work folder of a run")->required()->check(named_path());
  verb->add_option("--to", arguments->format, formats)->required()->check(one_of(names));
  verb->add_option("-o,--out,--dest", arguments->dest, "Folder that the files go to")
      ->required()
      ->check(named_folder());
  verb->add_option("--survey", arguments->survey, "Folder of the raw files (vts, sv, seabed, raw-reduced)")
      ->check(named_path("FOLDER"));
  verb->add_option("--margin-samples", arguments->reduce.margin_samples,
                   "raw-reduced: samples before and after each school that are kept beyond what its figures need");
  verb->add_option("--margin-beams", arguments->reduce.margin_beams, "raw-reduced: the same in beams, on either side");
  verb->add_option("--margin-fans", arguments->reduce.margin_fans, "raw-reduced: the same in fans, above and below");
  verb->add_option("--margin-pings", arguments->reduce.margin_pings,
                   "raw-reduced: pings kept before each school's first ping and after its last");
  verb->add_option("--coarsen", arguments->reduce.coarsen_beams,
                   "raw-reduced: keep the rest as means of so many neighbouring beams of a fan; 0 = drop it");
  verb->add_option("--cell-m", arguments->seabed.cell_m, "seabed: side of a cell of the raster, m")
      ->check(within(0.5, 10000.0))
      ->capture_default_str();
  verb->add_flag("--geographic", arguments->seabed.geographic,
                 "seabed: raster along latitudes and longitudes, not UTM");
  verb->add_flag("--no-formulas", arguments->no_formulas,
                 "csv: texts that a spreadsheet would take for a formula (= + - @) stand behind an apostrophe");
  verb->add_option("--count-from", arguments->count_from, "lsss: number of the first channel and sample, 1 or 0")
      ->check(whole_within(0, 1))
      ->capture_default_str();
  verb->add_option("-j,--jobs", arguments->jobs, "Threads; 0 = all of the machine's")->check(whole_within(0, 1024));
  verb->callback([arguments, &run, verb] {
    for (const OptionOf& of : kOptions) {
      const std::string option(of.option);
      if (arguments->format == "raw-reduced" || verb->get_option(option)->count() == 0) continue;
      throw CLI::ValidationError(option, "belongs to --to raw-reduced");
    }
    for (const auto& [option, format] : kOptionsOfOneFormat) {
      if (arguments->format == format || verb->get_option(std::string(option))->count() == 0) continue;
      throw CLI::ValidationError(std::string(option), fmt::format("belongs to --to {}", format));
    }
    run = [arguments] { return run_export(*arguments); };
  });
}

}  // namespace sonar
