// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "cli/chosen_recipe.h"
#include "cli/described_flags.h"
#include "cli/exit_codes.h"
#include "cli/file_to_write.h"
#include "cli/log.h"
#include "cli/named_path.h"
#include "cli/numbers.h"
#include "cli/progress.h"
#include "cli/verb.h"
#include "io/index_cache.h"
#include "pipeline/calibrate/sphere_report.h"
#include "pipeline/survey/survey.h"
#include "publish/setup_pictures.h"

namespace sonar {
namespace {

struct CalibrateArguments {
  std::vector<std::string> survey;
  std::string sphere;
  std::string water;
  std::string range;
  std::string recipe;
  std::string sound_speed;
  std::string out;
  std::string picture;
  SphereLook look;
  std::vector<DescribedFlags::Made> look_flags;
  bool beams = false;
  bool json = false;
  int jobs = 0;
};

/// The numbers that a validator let through.
std::vector<double> numbers_of(const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& part : CLI::detail::split(text, ',')) {
    CLI::detail::lexical_cast(part, numbers.emplace_back());
  }
  return numbers;
}

SphereChoice choice_of(const CalibrateArguments& arguments, const Recipe& recipe) {
  SphereChoice choice;
  choice.sphere = arguments.sphere;
  if (!arguments.range.empty()) {
    const std::vector<double> given = numbers_of(arguments.range);
    choice.range_from_m = given[0];
    choice.range_to_m = given[1];
  }
  if (!arguments.water.empty()) {
    const std::vector<double> given = numbers_of(arguments.water);
    choice.water = recipe.calibration.water;
    choice.water->temperature_c = given[0];
    choice.water->salinity_psu = given[1];
    choice.water->depth_m = given[2];
  }
  return choice;
}

Result<SphereCalibration> calibrated(const CalibrateArguments& arguments, SphereRunParams& params, Work& work) {
  auto recipe = chosen_recipe(arguments.recipe, {"", arguments.sound_speed});
  if (!recipe) return pass_on(recipe);
  const std::vector<std::filesystem::path> paths(arguments.survey.begin(), arguments.survey.end());
  const auto survey = open_survey(paths, recipe->survey, recipe->navigation, IndexCache::of_user(), work);
  if (!survey) return pass_on(survey);
  if (auto files = require_files(*survey, paths); !files) return pass_on(files);
  auto chosen = sphere_run_params(choice_of(arguments, *recipe), recipe->calibration.water, *survey);
  if (!chosen) return fail(chosen.error().code, "--" + chosen.error().text);  // it begins with what is wrong
  params = *chosen;
  for (const std::string& file : {arguments.out, arguments.picture}) {
    if (file.empty()) continue;
    const auto outside = require_outside_raw(*survey, std::filesystem::absolute(file).parent_path());
    if (!outside) return pass_on(outside);
  }
  return calibrate_by_sphere(*survey, recipe->calibration, params, work);
}

int run_calibrate(const CalibrateArguments& arguments) {
  if (auto sphere = named_sphere(arguments.sphere); !sphere) {
    return report({ErrorCode::usage, "--sphere: " + sphere.error().text, {}});
  }
  if (auto place = require_place(arguments.out); !arguments.out.empty() && !place) return report(place.error());
  if (auto place = require_picture_place(arguments.picture); !place) return report(place.error());
  Work work(arguments.jobs);
  const CancelOnInterrupt watch(work);
  show_progress(work);
  SphereRunParams params;
  const auto made = calibrated(arguments, params, work);
  clear_progress();
  if (!made) return report(made.error());
  if (auto written = write_calibration(*made, arguments.out); !written) return report(written.error());
  if (!arguments.picture.empty()) {
    const auto drawn = write_sphere_picture(sphere_chart_data(*made, params), arguments.look, arguments.picture);
    if (!drawn) return report(drawn.error());
  }
  if (arguments.json) {
    fmt::print("{}", calibration_json_text(*made, params));
  } else {
    fmt::print("{}{}: {} beams; sonarx run --calibration {}\n", calibration_text(*made, params, arguments.beams),
               arguments.out, made->crossed(), arguments.out);
  }
  return kExitDone;
}

}  // namespace

void add_calibrate(CLI::App& app, VerbRunner& run) {
  const auto arguments = std::make_shared<CalibrateArguments>();
  CLI::App* verb = app.add_subcommand(
      "calibrate", "Gain, sa correction, psi and widths of each beam from a sphere that was steered through the beams");
  verb->add_option("SURVEY", arguments->survey, "Folder of raw files, or raw files, of a sphere run")->required();
  verb->add_option("--sphere", arguments->sphere,
                   "Material and diameter in mm: wc38.1 (tungsten carbide), cu60 (copper)")
      ->required()
      ->check(some_name());
  verb->add_option("-o,--out", arguments->out, "Calibration table to write (CSV)")->required()->check(named_file());
  verb->add_option("--water", arguments->water,
                   "Water around the sphere: temperature in deg C, salinity in psu, depth in m; otherwise the raw "
                   "files' sound speed")
      ->check(numbers_between_commas("T,S,DEPTH"));
  verb->add_option("--range", arguments->range,
                   "The sphere lies between these ranges in m; otherwise anywhere from 10 m on")
      ->check(numbers_between_commas("FROM,TO"));
  verb->add_option("--recipe", arguments->recipe, "Parameters of absorption and ranges (see sonarx recipe)")
      ->check(named_file());
  verb->add_option("--sound-speed", arguments->sound_speed, kSoundSpeedHelp)->check(named_path("X|FILE"));
  CLI::Option* picture =
      verb->add_option("--picture", arguments->picture,
                       "Picture to write too: map of the beams, residuals, before and after (PNG, SVG, PDF)");
  picture->check(named_file());
  DescribedFlags flags(*verb, "Picture", "", arguments->look_flags);
  describe(flags, arguments->look);
  for (const DescribedFlags::Made& made : arguments->look_flags) verb->get_option(made.flag)->needs(picture);
  CLI::Option* beams = verb->add_flag("--beams", arguments->beams, "Print a line for each beam too");
  verb->add_flag("--json", arguments->json, "Print one JSON object")->excludes(beams);
  verb->add_option("-j,--jobs", arguments->jobs, "Threads; 0 = all of the machine's")->check(whole_within(0, 1024));
  verb->callback([arguments, &run] { run = [arguments] { return run_calibrate(*arguments); }; });
}

}  // namespace sonar
