// SPDX-License-Identifier: Apache-2.0
#include "pipeline/recipe.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/hash.h"
#include "io/atomic_file.h"
#include "io/csv_table.h"
#include "pipeline/calibration_json.h"
#include "pipeline/json_file.h"
#include "pipeline/json_parameters.h"
#include "pipeline/transfer_function_json.h"

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
  json["beam_calibration"] = beams_to_json(recipe.calibration.beams);
  return json;
}

Recipe paper_recipe() {
  Recipe recipe;
  recipe.flags.surface.mode = SurfaceMode::fan;
  recipe.flags.lost.enabled = false;
  recipe.flags.hot_beam.enabled = false;
  recipe.flags.wall.enabled = false;
  recipe.flags.impulse.enabled = false;
  recipe.background_window.enabled = false;
  recipe.seabed.enabled = false;
  recipe.automatic = false;
  recipe.grow.mode = GrowMode::paper;
  return recipe;
}

}  // namespace

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
  for (const char* member : {"recipe_version", "growth_curve", "beam_calibration"}) reader.skip(member);
  reader.finish();
  if (!reader.problem().empty()) return fail(ErrorCode::format, reader.problem());
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
  if (auto valid = validate(recipe); !valid) return pass_on(valid);
  for (const int length : {recipe.median.kernel_fans, recipe.median.kernel_beams, recipe.median.kernel_samples}) {
    if (length % 2 == 0) return fail(ErrorCode::bad_parameter, fmt::format("median: kernel {} is not odd", length));
  }
  if (recipe.track.confirm_pings > recipe.track.confirm_window) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("track.confirm_pings = {} is more than track.confirm_window = {}: no school could be seen",
                            recipe.track.confirm_pings, recipe.track.confirm_window));
  }
  if (auto valid = check_beams(recipe.calibration.beams); !valid) return pass_on(valid);
  return recipe;
}

Result<Recipe> read_recipe(const std::string& path) {
  const auto text = read_file(path);
  if (!text) return pass_on(text);
  auto recipe = recipe_from_text(*text);
  if (!recipe) return fail(recipe.error().code, recipe.error().text, {path, recipe.error().where.offset});
  return recipe;
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
  for (const std::string& name : table.header) {
    if (name == "channel" || name == "gain_db" || name == "sa_correction_db" || name == "extra_factor_db") continue;
    return fail(ErrorCode::format,
                fmt::format("line 1: column '{}' is none of channel, gain_db, sa_correction_db, extra_factor_db", name),
                {path});
  }
  if (table.header.size() < 2) {
    return fail(ErrorCode::format, "line 1: expected gain_db, sa_correction_db or extra_factor_db beside channel",
                {path});
  }
  const auto channel = table.require_column("channel");
  if (!channel) return pass_on(channel);
  for (const CsvRecord& record : table.records) {
    const auto number = table.whole(record, *channel);
    if (!number) return pass_on(number);
    if (*number < 0 || *number >= kMaxChannels) {
      return fail(ErrorCode::format, fmt::format("line {}: channel {} is not 0-based", record.line, *number), {path});
    }
    BeamCalibration beam{static_cast<int>(*number), kUnknown, kUnknown, kUnknown};
    for (const auto& [name, value] : {std::pair<const char*, double*>{"gain_db", &beam.gain_db},
                                      {"sa_correction_db", &beam.sa_correction_db},
                                      {"extra_factor_db", &beam.extra_factor_db}}) {
      const auto column = table.column(name);
      if (!column) continue;
      const auto read = table.number(record, *column);
      if (!read) return pass_on(read);
      if (!std::isfinite(*read) && !record.fields[*column].empty()) {
        return fail(ErrorCode::format, fmt::format("line {}: {} is no number", record.line, name), {path});
      }
      *value = *read;
    }
    beams.push_back(beam);
  }
  if (auto valid = check_beams(beams); !valid) return fail(valid.error().code, valid.error().text, {path});
  recipe.calibration.beams = std::move(beams);
  return {};
}

Result<void> take_calibration_file(Recipe& recipe, const std::string& path) {
  const auto table = read_csv(path);
  if (!table) return pass_on(table);
  return take_calibration_table(recipe, *table);
}

std::string recipe_hash(const Recipe& recipe) { return to_hex(hash_text(recipe_text(recipe))); }

}  // namespace sonar
