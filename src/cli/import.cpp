// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/number_text.h"
#include "cli/chosen_recipe.h"
#include "cli/exit_codes.h"
#include "cli/file_to_write.h"
#include "cli/log.h"
#include "cli/named_path.h"
#include "cli/numbers.h"
#include "cli/progress.h"
#include "cli/verb.h"
#include "io/atomic_file.h"
#include "io/recordings.h"
#include "pipeline/imports/import.h"

namespace sonar {
namespace {

struct ImportArguments {
  std::string survey;
  std::vector<std::string> files;
  std::string observation;
  std::optional<int> fan;
  std::string beams;
  std::optional<int> count_from;
  std::string recipe;
  std::string operator_name;
  std::string out;
  int jobs = 0;
};

Result<std::optional<BeamSpan>> parse_beams(const std::string& text) {
  if (text.empty()) return std::optional<BeamSpan>{};
  const auto numbers = whole_numbers(text, ':');
  const bool span = numbers && numbers->size() == 2 && (*numbers)[0] >= 0 && (*numbers)[0] <= (*numbers)[1];
  if (!span || (*numbers)[1] > 1'000'000) {
    return fail(ErrorCode::usage, fmt::format("--beams {}: expected A:B with 0 <= A <= B", text));
  }
  return std::optional<BeamSpan>{BeamSpan{static_cast<int>((*numbers)[0]), static_cast<int>((*numbers)[1])}};
}

/// Option, and the ending of the files that it is for.
constexpr std::array<std::pair<const char*, std::string_view>, 3> kOptionsOfOneFormat{
    {{"--fan", ".evr"}, {"--beams", ".evr"}, {"--count-from", ".work"}}};

/// A journal holds decisions of people: none is written over.
Result<void> require_new_journal(const std::filesystem::path& file) {
  if (!has_ending(file, ".jsonl"))
    return fail(ErrorCode::usage, "expected a name that ends in .jsonl", {file.string()});
  std::error_code absent;
  if (std::filesystem::exists(std::filesystem::symlink_status(file, absent))) {
    return fail(ErrorCode::usage, "is there already; expected the name of a new journal", {file.string()});
  }
  return require_place(file);
}

Result<ImportedJournal> imported_journal(const ImportArguments& arguments, Work& work) {
  if (auto place = require_new_journal(arguments.out); !place) return pass_on(place);
  const auto beams = parse_beams(arguments.beams);
  if (!beams) return pass_on(beams);
  const auto recipe = chosen_recipe(arguments.recipe, {});
  if (!recipe) return pass_on(recipe);
  const std::vector<std::filesystem::path> paths{arguments.survey};
  const auto survey = open_survey(paths, recipe->survey, recipe->navigation, IndexCache::of_user(), work);
  if (!survey) return pass_on(survey);
  if (auto files = require_files(*survey, paths); !files) return pass_on(files);
  const auto folder = std::filesystem::absolute(arguments.out).parent_path();
  if (auto outside = require_outside_raw(*survey, folder); !outside) return pass_on(outside);
  auto place = import_place(*survey, arguments.observation);
  if (!place) return pass_on(place);
  place->fan = arguments.fan;
  place->beams = *beams;
  if (arguments.count_from) {
    place->lsss = *arguments.count_from == 0 ? LsssNumbering::from_zero : LsssNumbering::from_one;
  }
  Imported imported;
  for (const std::string& file : arguments.files) {
    if (auto read = import_file(file, *place, imported, work); !read) return pass_on(read);
  }
  const TimeNs now =
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch()).count();
  return import_journal(*survey, *recipe, imported, {arguments.operator_name, now}, work);
}

int import_verb(const ImportArguments& arguments) {
  Work work(arguments.jobs);
  const CancelOnInterrupt watch(work);
  show_progress(work);
  const auto made = imported_journal(arguments, work);
  clear_progress();
  if (!made) return report(made.error());
  for (const std::string& line : made->left_out) print_note("import-left-out: " + line);
  if (made->journal.lines.empty()) {
    return report({ErrorCode::mismatch, "nothing in the files belongs to the survey; no journal was written", {}});
  }
  if (auto written = write_file(arguments.out, journal_text(made->journal)); !written) return report(written.error());
  fmt::print("{}: {}, {}, {}, {}\n", arguments.out, count_of(made->schools, "school"), count_of(made->voxels, "voxel"),
             count_of(made->marks, "mark"), count_of(made->bad, "bad interval"));
  return kExitDone;
}

}  // namespace

void add_import(CLI::App& app, VerbRunner& run) {
  const auto arguments = std::make_shared<ImportArguments>();
  std::string kinds = "What to read:";
  for (const ImportFormat& format : import_formats()) kinds += fmt::format("\n{} - {}", format.ending, format.text);
  CLI::App* verb = app.add_subcommand(
      "import", "Write a journal of what files of other programs say of a survey: schools, marks, bad pings");
  verb->add_option("SURVEY", arguments->survey, "Folder of raw files, or a raw file")->required();
  verb->add_option("FILE", arguments->files, kinds)->required()->check(named_file());
  verb->add_option(
          "-o,--out", arguments->out,
          "Journal to write (.jsonl), for run --session; among the journals of a survey the window reads it too")
      ->required()
      ->check(named_file());
  verb->add_option("--observation", arguments->observation,
                   "Only this observation, e.g. obs-0002; default: all of the sounder that comes first")
      ->check(some_name());
  verb->add_option("--fan", arguments->fan, "Fan from 0, the deepest, of regions whose notes do not name one")
      ->check(whole_within(0, 100000));
  verb->add_option("--beams", arguments->beams, "Beams from 0 of the same; default: all of the fan")->type_name("A:B");
  verb->add_option("--count-from", arguments->count_from,
                   ".work: number of the first channel and sample, 1 or 0; default: what files of export tell, else 1")
      ->check(whole_within(0, 1));
  verb->add_option("--recipe", arguments->recipe, "Parameters of every stage (see sonarx recipe)")->check(named_file());
  verb->add_option("--operator", arguments->operator_name, "Who imports, for the journal")->type_name("NAME");
  verb->add_option("-j,--jobs", arguments->jobs, "Threads; 0 = all of the machine's")->check(whole_within(0, 1024));
  verb->callback([arguments, &run, verb] {
    for (const auto& [option, ending] : kOptionsOfOneFormat) {
      const auto suits = [&](const std::string& file) { return has_ending(file, ending); };
      if (verb->get_option(option)->count() == 0 || std::ranges::any_of(arguments->files, suits)) continue;
      throw CLI::ValidationError(option, fmt::format("belongs to files that end in {}; none is given", ending));
    }
    run = [arguments] { return import_verb(*arguments); };
  });
}

}  // namespace sonar
