// SPDX-License-Identifier: Apache-2.0
#include "synth/simulate.h"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/number_text.h"
#include "cli/exit_codes.h"
#include "cli/log.h"
#include "cli/named_path.h"
#include "cli/naming_option.h"
#include "cli/numbers.h"
#include "cli/one_of.h"
#include "cli/progress.h"
#include "cli/verb.h"
#include "pipeline/recipe/json_file.h"
#include "pipeline/recipe/json_parameters.h"
#include "pipeline/recipe/parameter_table.h"
#include "pipeline/survey/survey.h"
#include "signal/elastic_sphere.h"
#include "synth/array/simulate_array.h"

namespace sonar {
namespace {

struct SimulateOptions {
  std::string out;
  std::string physics = "standard";
  std::string preset;
  std::string beams;
  std::optional<int> seed;
  std::optional<int> observations;
  std::optional<int> pings;
  std::optional<int> schools;
  std::optional<double> speed_knots;
  std::optional<double> noise;
  std::optional<double> file_mb;
  std::string beam_pattern;
  std::string waters;
  std::string sphere;
  std::string params;
  bool print_params = false;
  bool describe = false;
  bool no_fish = false;
  bool force = false;
  int jobs = 0;
};

template <class T>
void take(const std::optional<T>& option, T& field) {
  if (option) field = *option;
}

/// Fills what a file names. errors: io, format; bad_parameter naming the member
template <class Params>
Result<void> take_file(const std::string& path, Params& params) {
  const auto json = read_json_file(path);
  if (!json) return pass_on(json);
  JsonReader reader(*json);
  describe(reader, params);
  reader.finish();
  if (!reader.problem().empty()) return fail(ErrorCode::bad_parameter, reader.problem(), {path});
  for (const std::string& note : reader.notes()) print_note(fmt::format("earlier-parameter: {}: {}", path, note));
  return {};
}

/// The options that every physics has.
template <class Params>
void take_options(const SimulateOptions& o, Params& p) {
  take(o.seed, p.seed);
  take(o.observations, p.observations);
  take(o.pings, p.pings);
  take(o.schools, p.schools);
  take(o.speed_knots, p.speed_knots);
  take(o.file_mb, p.file_mb);
  if (o.no_fish) p.schools = 0;
}

Result<synth::SurveyParams> parameters(const SimulateOptions& o) {
  auto preset = synth::Preset::standard;
  for (std::size_t i = 0; i < synth::kPresetNames.size(); ++i) {
    if (synth::kPresetNames[i] == o.preset) preset = static_cast<synth::Preset>(i);
  }
  synth::SurveyParams p = synth::survey_params(preset);
  if (!o.params.empty()) {
    if (auto taken = take_file(o.params, p); !taken) return pass_on(taken);
  }
  take_options(o, p);
  take(o.noise, p.noise.scale);
  for (std::size_t i = 0; i < synth::kBeamPatternNames.size(); ++i) {
    if (synth::kBeamPatternNames[i] == o.beam_pattern) p.beam_pattern = static_cast<synth::BeamPattern>(i);
  }
  return p;
}

constexpr std::array<OptionOf, 7> kOptions{{{"seed", "--seed"},
                                            {"observations", "--observations"},
                                            {"pings", "--pings"},
                                            {"schools", "--schools"},
                                            {"speed_knots", "--speed-knots"},
                                            {"noise.scale", "--noise"},
                                            {"file_mb", "--file-mb"}}};

/// errors  usage: an option that belongs to the other physics
Result<void> only_for(std::string_view physics, std::initializer_list<std::pair<std::string_view, bool>> options) {
  for (const auto& [name, given] : options) {
    if (given) return fail(ErrorCode::usage, fmt::format("{} belongs to --physics {}", name, physics));
  }
  return {};
}

Result<synth::array::ArrayParams> array_parameters(const SimulateOptions& o) {
  const auto own = only_for("standard", {{"--preset", !o.preset.empty()},
                                         {"--beams", !o.beams.empty()},
                                         {"--beam-pattern", !o.beam_pattern.empty()},
                                         {"--noise", o.noise.has_value()}});
  if (!own) return pass_on(own);
  synth::array::ArrayParams p;
  if (!o.sphere.empty()) {
    const auto sphere = named_sphere(o.sphere);
    if (!sphere) return fail(ErrorCode::usage, "--sphere: " + sphere.error().text);
    p = synth::array::sphere_run();
    p.sphere.diameter_mm = sphere->diameter_m * 1e3;
    p.sphere.material = sphere->material.name == "cu" ? synth::array::SphereMaterial::copper
                                                      : synth::array::SphereMaterial::tungsten_carbide;
  }
  if (!o.params.empty()) {
    if (auto taken = take_file(o.params, p); !taken) return pass_on(taken);
  }
  take_options(o, p);
  if (!o.waters.empty()) p.waters = o.waters == "random" ? synth::array::Waters::random : synth::array::Waters::stated;
  return p;
}

/// What is printed instead of a survey; false = a survey is wanted.
template <class Params>
bool print_instead(const SimulateOptions& o, Params& params) {
  if (o.print_params) {
    JsonWriter writer;
    describe(writer, params);
    fmt::print("{}\n", writer.json().dump(2));
  } else if (o.describe) {
    ParameterTable table("The survey");
    describe(table, params);
    fmt::print("{}", table.markdown());
  }
  return o.print_params || o.describe;
}

/// Makes the survey and says what was made.
template <class Make>
int write_survey(const SimulateOptions& o, std::int64_t wanted_schools, const Make& make) {
  if (o.out.empty())
    return report({ErrorCode::usage, "OUT is required: the folder to write into; see sonarx simulate --help", {}});
  if (auto clear = require_not_beneath_raw(o.out); !clear) return report(clear.error());
  Work work(o.jobs);
  const CancelOnInterrupt watch(work);
  show_progress(work);
  const auto made = make(work);
  clear_progress();
  if (!made) return report(naming_option(made.error(), kOptions));
  fmt::print("{}: {}, {:.1f} MB, {}, {}; the truth is in {}/truth\n", o.out, count_of(made->files.size(), "raw file"),
             static_cast<double>(made->bytes) / 1e6, count_of(static_cast<std::size_t>(made->pings), "ping"),
             count_of(static_cast<std::size_t>(made->schools), "school"), o.out);
  if (made->schools < wanted_schools) {
    print_note(
        fmt::format("fewer-schools: {}: {} of {} schools had room where the sonar sees them; more pings have more room",
                    o.out, made->schools, wanted_schools));
  }
  return kExitDone;
}

int simulate_standard(const SimulateOptions& o) {
  const auto own = only_for("array", {{"--waters", !o.waters.empty()}, {"--sphere", !o.sphere.empty()}});
  if (!own) return report(own.error());
  std::vector<synth::Beam> beams = synth::ms70_beams();
  if (!o.beams.empty()) {
    auto table = synth::read_beam_table(o.beams);
    if (!table) return report(table.error());
    beams = std::move(*table);
  }
  auto params = parameters(o);
  if (!params) return report(params.error());
  if (print_instead(o, *params)) return kExitDone;
  const bool demo = params->preset == synth::Preset::demo;
  const std::int64_t wanted = demo ? 0 : std::int64_t{params->observations} * params->schools;
  const int code = write_survey(o, wanted, [&](Work& work) {
    return synth::simulate_survey(o.out, *params, beams, o.force, SONAR_VERSION, work);
  });
  if (code == kExitDone && demo && o.observations) {
    print_note("demo-observations: the demo has its own observations; --observations was not used");
  }
  return code;
}

int simulate_array(const SimulateOptions& o) {
  auto params = array_parameters(o);
  if (!params) return report(params.error());
  if (print_instead(o, *params)) return kExitDone;
  return write_survey(o, std::int64_t{params->observations} * params->schools, [&](Work& work) {
    return synth::array::simulate_array_survey(o.out, *params, o.force, SONAR_VERSION, work);
  });
}

}  // namespace

void add_simulate(CLI::App& app, VerbRunner& run) {
  const auto o = std::make_shared<SimulateOptions>();
  CLI::App* verb = app.add_subcommand(
      "simulate",
      "Write a synthetic MS70 survey as .raw files, and its truth (schools, masks, the seabed as depth.tif)");
  verb->add_option("OUT", o->out, "Folder to write into")->check(named_path());
  verb->add_option("--physics", o->physics,
                   "How echoes are made: standard (this program's own sonar equation) or array (sums over "
                   "array elements and single fish)")
      ->check(one_of({"standard", "array"}))
      ->capture_default_str();
  verb->add_option("--preset", o->preset, "What the survey is like: easy, standard, hard or demo; standard by default")
      ->check(one_of({"easy", "standard", "hard", "demo"}));
  verb->add_option("--seed", o->seed, "Every random number follows from it");
  verb->add_option("--observations", o->observations, "Number of observations (the demo has three)");
  verb->add_option("--pings", o->pings, "Pings in each observation");
  verb->add_option("--schools", o->schools, "Schools in each observation");
  verb->add_option("--speed-knots", o->speed_knots, "The ship's speed over ground");
  verb->add_option("--beams", o->beams, "Beam table (CSV) instead of the MS70's 20 fans of 25 beams")
      ->check(named_file());
  verb->add_option("--beam-pattern", o->beam_pattern,
                   "Shape of the beams: gaussian, uniform_line (with side lobes), or sending wider than receiving: "
                   "wide_transmit (both ways), wide_fan (along the fan)")
      ->check(one_of({"gaussian", "uniform_line", "wide_transmit", "wide_fan"}));
  verb->add_option("--waters", o->waters,
                   "Array physics: the strengths of other scatterers as the parameters state them, or drawn from the "
                   "seed (random)")
      ->check(one_of({"stated", "random"}));
  verb->add_option("--sphere", o->sphere,
                   "Array physics: a run for calibration in place of a survey, with a sphere (wc38.1, cu60) that is "
                   "steered through the beams, and stated gains that err; truth/beams.csv has the true ones")
      ->check(some_name());
  verb->add_option("--params", o->params, "JSON file whose members take the place of the preset's: --print-params")
      ->check(named_file());
  auto* print =
      verb->add_flag("--print-params", o->print_params, "Print every parameter of the survey and write nothing");
  verb->add_flag("--describe", o->describe, "The same with unit, range and meaning of each, as Markdown tables")
      ->excludes(print);
  verb->add_option("--noise", o->noise, "Multiplies every noise's power and rate");
  verb->add_option("--file-mb", o->file_mb, "Size at which a new file begins");
  verb->add_flag("--no-fish", o->no_fish, "No schools at all");
  verb->add_flag("--force", o->force,
                 "Write into a folder that already holds raw files; a simulated survey there is replaced");
  verb->add_option("-j,--jobs", o->jobs, "Threads; 0 = all of the machine's")->check(whole_within(0, 1024));
  verb->callback(
      [o, &run] { run = [o] { return o->physics == "array" ? simulate_array(*o) : simulate_standard(*o); }; });
}

}  // namespace sonar
