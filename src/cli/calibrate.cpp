// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "cli/chosen_recipe.h"
#include "cli/exit_codes.h"
#include "cli/file_to_write.h"
#include "cli/log.h"
#include "cli/named_path.h"
#include "cli/numbers.h"
#include "cli/progress.h"
#include "cli/verb.h"
#include "io/atomic_file.h"
#include "io/index_cache.h"
#include "pipeline/calibrate/sphere_report.h"
#include "pipeline/survey/survey.h"

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

/// Measured water where it was told, else the raw files' sound speed with the density of the recipe's water.
Result<WaterAround> water_around(const CalibrateArguments& arguments, const Recipe& recipe, const SurveyFiles& survey) {
  WaterProperties water = recipe.calibration.water;
  if (!arguments.water.empty()) {
    const std::vector<double> given = numbers_of(arguments.water);
    water.temperature_c = given[0];
    water.salinity_psu = given[1];
    water.depth_m = given[2];
    if (auto valid = validate(water); !valid) {
      return fail(ErrorCode::usage, fmt::format("--water {}: {}", arguments.water, valid.error().text));
    }
    return WaterAround{sound_speed_mackenzie(water), sea_water_density(water)};
  }
  for (const ObservationFiles& observation : survey.observations) {
    if (observation.grid) return WaterAround{observation.sound_speed_mps, sea_water_density(water)};
  }
  return WaterAround{sound_speed_mackenzie(water), sea_water_density(water)};
}

Result<SphereRunParams> sphere_params(const CalibrateArguments& arguments, const Recipe& recipe,
                                      const SurveyFiles& survey) {
  SphereRunParams params;
  auto sphere = named_sphere(arguments.sphere);
  if (!sphere) return fail(ErrorCode::usage, "--sphere: " + sphere.error().text);
  params.sphere = *sphere;
  if (!arguments.range.empty()) {
    const std::vector<double> given = numbers_of(arguments.range);
    if (!(given[0] >= 0.0 && given[0] < given[1])) {
      return fail(ErrorCode::usage,
                  fmt::format("--range {}: expected the nearer and the farther range in metres", arguments.range));
    }
    params.range_from_m = given[0];
    params.range_to_m = given[1];
  }
  auto water = water_around(arguments, recipe, survey);
  if (!water) return pass_on(water);
  params.water = *water;
  return params;
}

Result<SphereCalibration> calibrated(const CalibrateArguments& arguments, SphereRunParams& params, Work& work) {
  auto recipe = chosen_recipe(arguments.recipe, {"", arguments.sound_speed});
  if (!recipe) return pass_on(recipe);
  const std::vector<std::filesystem::path> paths(arguments.survey.begin(), arguments.survey.end());
  const auto survey = open_survey(paths, recipe->survey, recipe->navigation, IndexCache::of_user(), work);
  if (!survey) return pass_on(survey);
  if (auto files = require_files(*survey, paths); !files) return pass_on(files);
  auto chosen = sphere_params(arguments, *recipe, *survey);
  if (!chosen) return pass_on(chosen);
  params = *chosen;
  const auto outside = require_outside_raw(*survey, std::filesystem::absolute(arguments.out).parent_path());
  if (!outside) return pass_on(outside);
  return calibrate_by_sphere(*survey, recipe->calibration, params, work);
}

int run_calibrate(const CalibrateArguments& arguments) {
  if (auto sphere = named_sphere(arguments.sphere); !sphere) {
    return report({ErrorCode::usage, "--sphere: " + sphere.error().text, {}});
  }
  if (auto place = require_place(arguments.out); !place) return report(place.error());
  Work work(arguments.jobs);
  const CancelOnInterrupt watch(work);
  show_progress(work);
  SphereRunParams params;
  const auto made = calibrated(arguments, params, work);
  clear_progress();
  if (!made) return report(made.error());
  if (auto written = write_file(arguments.out, calibration_csv(*made)); !written) return report(written.error());
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
  CLI::Option* beams = verb->add_flag("--beams", arguments->beams, "Print a line for each beam too");
  verb->add_flag("--json", arguments->json, "Print one JSON object")->excludes(beams);
  verb->add_option("-j,--jobs", arguments->jobs, "Threads; 0 = all of the machine's")->check(whole_within(0, 1024));
  verb->callback([arguments, &run] { run = [arguments] { return run_calibrate(*arguments); }; });
}

}  // namespace sonar
