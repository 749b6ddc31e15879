// SPDX-License-Identifier: Apache-2.0
#include "pipeline/recipe/recipe.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>
#include <vector>

#include "base/hash.h"
#include "io/atomic_file.h"
#include "io/csv_table.h"
#include "io/current_file.h"
#include "pipeline/recipe/json_file.h"
#include "pipeline/recipe/json_parameters.h"
#include "pipeline/recipe/transfer_function_json.h"
#include "pipeline/survey/calibration_json.h"
#include "pipeline/survey/cast_files.h"
#include "pipeline/survey/currents_json.h"

namespace sonar {
namespace {

constexpr int kMaxChannels = 100'000;

nlohmann::json recipe_to_json(const Recipe& recipe) {
  Recipe copy = recipe;
  JsonWriter writer;
  describe(writer, copy);
  nlohmann::json json = writer.json();
  json["recipe_version"] = kRecipeVersion;
  json["growth_curve"] = to_json(recipe.growth_curve);
  json["sound_speed_profile"] = to_json(recipe.survey.sound_speed_profile);
  json["current_profiles"] = to_json(recipe.current_profiles);
  json["beam_calibration"] = beams_to_json(recipe.calibration.beams);
  return json;
}

Recipe paper_recipe() {
  Recipe recipe;
  recipe.flags.surface.mode = SurfaceMode::fan;
  recipe.flags.dropouts.enabled = false;
  recipe.flags.corrupted_packets.enabled = false;
  recipe.flags.interference.enabled = false;
  recipe.flags.impulse_noise.enabled = false;
  recipe.background_window.enabled = false;
  recipe.seabed.enabled = false;
  recipe.automatic = false;
  recipe.grow.mode = GrowMode::paper;
  return recipe;
}

/// One number of a calibration table, where it has the column; the first problem stays.
void read_cell(const CsvTable& table, const CsvRecord& record, const char* name, double& value, Result<void>& problem) {
  const auto column = table.column(name);
  if (!column || !problem) return;
  const auto read = table.number(record, *column);
  if (!read) {
    problem = pass_on(read);
  } else if (!std::isfinite(*read) && !record.fields[*column].empty()) {
    problem = fail(ErrorCode::format, fmt::format("line {}: {} is no number", record.line, name), {table.file});
  } else {
    value = *read;
  }
}

}  // namespace

bool operator==(const BeamCalibration& a, const BeamCalibration& b) {
  const auto numbers = [](BeamCalibration beam) {
    std::vector<double> values;
    columns([&](const char*, double& value, double, double) { values.push_back(value); }, beam);
    return values;
  };
  const std::vector<double> of_b = numbers(b);
  const std::vector<double> of_a = numbers(a);
  return a.channel == b.channel && std::equal(of_a.begin(), of_a.end(), of_b.begin(), [](double x, double y) {
           return x == y || (std::isnan(x) && std::isnan(y));
         });
}

Result<Recipe> recipe_preset(std::string_view name) {
  if (name == "default") return Recipe{};
  if (name == "paper") return paper_recipe();
  return fail(ErrorCode::usage, fmt::format("no recipe preset {}: there are default and paper", name));
}

std::string recipe_text(const Recipe& recipe) { return recipe_to_json(recipe).dump(2) + "\n"; }

Result<Recipe> recipe_from_text(std::string_view text) {
  const auto json = parse_json(text);
  if (!json) return pass_on(json);
  if (!json->is_object()) return fail(ErrorCode::format, "a recipe is a JSON object");
  if (auto version = check_version(*json, "recipe_version", kRecipeVersion); !version) return pass_on(version);
  Recipe recipe;
  JsonReader reader(*json);
  describe(reader, recipe);
  for (const char* member :
       {"recipe_version", "growth_curve", "beam_calibration", "sound_speed_profile", "current_profiles"})
    reader.skip(member);
  reader.finish();
  if (!reader.problem().empty()) return fail(ErrorCode::format, reader.problem());
  recipe.notes = reader.notes();
  if (const auto curve = json->find("growth_curve"); curve != json->end()) {
    auto made = transfer_function_from_json(*curve);
    if (!made) return fail(made.error().code, "growth_curve: " + made.error().text);
    recipe.growth_curve = std::move(*made);
  }
  if (const auto list = json->find("beam_calibration"); list != json->end()) {
    auto beams = beams_from_json(*list);
    if (!beams) return pass_on(beams);
    recipe.calibration.beams = std::move(*beams);
  }
  if (const auto list = json->find("sound_speed_profile"); list != json->end()) {
    auto profile = profile_from_json(*list);
    if (!profile) return pass_on(profile);
    recipe.survey.sound_speed_profile = std::move(*profile);
  }
  if (const auto list = json->find("current_profiles"); list != json->end()) {
    auto profiles = currents_from_json(*list);
    if (!profiles) return pass_on(profiles);
    recipe.current_profiles = std::move(*profiles);
  }
  if (auto valid = validate_recipe(recipe); !valid) return pass_on(valid);
  return recipe;
}

Result<void> validate_recipe(const Recipe& recipe) {
  if (auto valid = validate(recipe); !valid) return valid;
  if (auto valid = check_sound_speed(recipe.survey.sound_speed_mps); !valid) return pass_on(valid);
  for (const int length : {recipe.median.kernel_fans, recipe.median.kernel_beams, recipe.median.kernel_samples}) {
    if (length % 2 == 0) return fail(ErrorCode::bad_parameter, fmt::format("median: kernel {} is not odd", length));
  }
  if (recipe.track.confirmation.pings > recipe.track.confirmation.window) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("track.confirm_pings = {} is more than track.confirm_window = {}: no school could be seen",
                            recipe.track.confirmation.pings, recipe.track.confirmation.window));
  }
  if (const std::string_view none = no_judge_in(recipe.detect.left_out); !none.empty()) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("detect.left_out: no judge {}; there are {}", none, fmt::join(kJudgeNames, ", ")));
  }
  const ExtinctionParams& extinction = recipe.measure.extinction;
  if (extinction.ratio < extinction.ratio_low || extinction.ratio > extinction.ratio_high) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("measure.extinction.ratio = {} does not lie within ratio_low = {} .. ratio_high = {}",
                            extinction.ratio, extinction.ratio_low, extinction.ratio_high));
  }
  if (auto valid = check_beams(recipe.calibration.beams); !valid) return pass_on(valid);
  return {};
}

Result<Recipe> read_recipe(const std::string& path) {
  const auto text = read_file(path);
  if (!text) return pass_on(text);
  auto recipe = recipe_from_text(*text);
  if (!recipe) return fail(recipe.error().code, recipe.error().text, {path, recipe.error().where.offset});
  return recipe;
}

Result<void> write_recipe(const std::string& path, const Recipe& recipe) {
  return write_file(path, recipe_text(recipe));
}

Result<Recipe> named_recipe(const std::string& path_or_preset) {
  if (path_or_preset.empty()) return Recipe{};
  std::error_code absent;
  const bool is_file = std::filesystem::exists(path_or_preset, absent);
  if (auto preset = recipe_preset(path_or_preset); preset && !is_file) return preset;
  return read_recipe(path_or_preset);
}

Result<void> take_calibration_table(Recipe& recipe, const CsvTable& table) {
  const std::string& path = table.file;
  if (table.records.empty()) return fail(ErrorCode::format, "expected a line for each channel, found none", {path});
  std::vector<BeamCalibration> beams;
  std::string known = "channel";
  BeamCalibration blank;
  columns([&](const char* name, double&, double, double) { known += fmt::format(", {}", name); }, blank);
  for (const std::string& name : table.header) {
    if ((", " + known + ", ").find(", " + name + ", ") != std::string::npos) continue;
    return fail(ErrorCode::format, fmt::format("line 1: column '{}' is none of {}", name, known), {path});
  }
  if (table.header.size() < 2) {
    return fail(ErrorCode::format, fmt::format("line 1: beside channel expected some of {}", known), {path});
  }
  const auto channel = table.require_column("channel");
  if (!channel) return pass_on(channel);
  for (const CsvRecord& record : table.records) {
    const auto number = table.whole(record, *channel);
    if (!number) return pass_on(number);
    if (*number < 0 || *number >= kMaxChannels) {
      return fail(ErrorCode::format, fmt::format("line {}: channel {} is not 0-based", record.line, *number), {path});
    }
    BeamCalibration beam;
    beam.channel = static_cast<int>(*number);
    Result<void> read;
    columns([&](const char* name, double& value, double, double) { read_cell(table, record, name, value, read); },
            beam);
    if (!read) return pass_on(read);
    beams.push_back(beam);
  }
  if (auto valid = check_beams(beams); !valid) return fail(valid.error().code, valid.error().text, {path});
  if (table.column("psi_db")) recipe.calibration.psi = PsiSource::table;
  recipe.calibration.beams = std::move(beams);
  return {};
}

Result<void> take_calibration_file(Recipe& recipe, const std::string& path) {
  const auto table = read_csv(path);
  if (!table) return pass_on(table);
  return take_calibration_table(recipe, *table);
}

Result<void> take_sound_speed(Recipe& recipe, const std::string& value_or_path) {
  double speed_mps = 0.0;
  const char* end = value_or_path.data() + value_or_path.size();
  const auto [stop, error] = std::from_chars(value_or_path.data(), end, speed_mps);
  if (error == std::errc{} && stop == end) {
    if (!check_profile({{0.0, speed_mps}})) {
      return fail(ErrorCode::bad_parameter,
                  fmt::format("sound speed: expected 1000 to 2000 m/s, got {}", value_or_path));
    }
    recipe.survey.sound_speed_mps = speed_mps;
    recipe.survey.sound_speed_profile.clear();
    return {};
  }
  auto profile = read_sound_profile(value_or_path);
  if (!profile) return pass_on(profile);
  recipe.survey.sound_speed_mps = 0.0;
  recipe.survey.sound_speed_profile = std::move(*profile);
  return {};
}

Result<void> take_currents(Recipe& recipe, const std::string& path) {
  auto profiles = read_currents(path);
  if (!profiles) return pass_on(profiles);
  recipe.current_profiles = std::move(*profiles);
  return {};
}

std::string recipe_hash(const Recipe& recipe) { return to_hex(hash_text(recipe_text(recipe))); }

}  // namespace sonar
