// SPDX-License-Identifier: Apache-2.0
#include "pipeline/survey/calibration_json.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "pipeline/recipe/json_parameters.h"

namespace sonar {
namespace {

constexpr int kMaxChannels = 100'000;

/// Numbers under known names; null is unknown.
Result<void> check_entry(const nlohmann::json& entry, std::size_t index) {
  if (!entry.is_object())
    return fail(ErrorCode::format, fmt::format("beam_calibration[{}]: expected an object", index));
  for (const auto& [name, value] : entry.items()) {
    bool known = name == "channel";
    BeamCalibration blank;
    columns([&](const char* column, double&, double, double) { known = known || name == column; }, blank);
    if (!known) {
      return fail(ErrorCode::format, fmt::format("beam_calibration[{}].{}: no such parameter", index, name));
    }
    if (!value.is_number() && !value.is_null()) {
      return fail(ErrorCode::format, fmt::format("beam_calibration[{}].{}: expected a number", index, name));
    }
  }
  return {};
}

}  // namespace

nlohmann::json beams_to_json(const std::vector<BeamCalibration>& beams) {
  nlohmann::json list = nlohmann::json::array();
  for (const BeamCalibration& beam : beams) {
    nlohmann::json entry{{"channel", beam.channel}};
    BeamCalibration copy = beam;
    columns(
        [&](const char* name, double& value, double, double) {
          if (std::isfinite(value)) entry[name] = value;
        },
        copy);
    list.push_back(std::move(entry));
  }
  return list;
}

Result<std::vector<BeamCalibration>> beams_from_json(const nlohmann::json& list) {
  if (!list.is_array()) return fail(ErrorCode::format, "beam_calibration: expected an array");
  std::vector<BeamCalibration> beams;
  for (const auto& entry : list) {
    if (auto sound = check_entry(entry, beams.size()); !sound) return pass_on(sound);
    const auto number = [&](const char* member) {
      return entry.contains(member) && entry[member].is_number() ? entry[member].get<double>() : kUnknown;
    };
    const double channel = number("channel");
    if (!(channel >= 0 && channel < kMaxChannels && channel == std::floor(channel))) {
      return fail(ErrorCode::format, fmt::format("beam_calibration[{}]: expected a channel", beams.size()));
    }
    BeamCalibration& beam = beams.emplace_back();
    beam.channel = static_cast<int>(channel);
    columns([&](const char* name, double& value, double, double) { value = number(name); }, beam);
  }
  return beams;
}

Result<void> check_beams(const std::vector<BeamCalibration>& beams) {
  std::set<int> channels;
  for (const BeamCalibration& beam : beams) {
    if (!channels.insert(beam.channel).second) {
      return fail(ErrorCode::bad_parameter, fmt::format("calibration: channel {} stands twice", beam.channel));
    }
    std::string problem;
    BeamCalibration copy = beam;
    columns(
        [&](const char* name, double& value, double least, double most) {
          if (problem.empty() && (value < least || value > most)) {
            problem = fmt::format("calibration: channel {}: {} = {} is outside {} .. {}", beam.channel, name, value,
                                  least, most);
          }
        },
        copy);
    if (!problem.empty()) return fail(ErrorCode::bad_parameter, problem);
  }
  return {};
}

nlohmann::json to_json(const CalibrationParams& calibration) {
  CalibrationParams copy = calibration;
  JsonWriter writer;
  describe(writer, copy);
  return {{"calibration", writer.json()}, {"beam_calibration", beams_to_json(calibration.beams)}};
}

Result<CalibrationParams> calibration_from_json(const nlohmann::json& json) {
  CalibrationParams calibration;
  if (const auto found = json.find("calibration"); found != json.end()) {
    JsonReader reader(*found, "calibration.");
    describe(reader, calibration);
    reader.finish();
    if (!reader.problem().empty()) return fail(ErrorCode::format, reader.problem());
    if (auto valid = validate(calibration); !valid) return pass_on(valid);
  }
  if (const auto list = json.find("beam_calibration"); list != json.end()) {
    auto beams = beams_from_json(*list);
    if (!beams) return pass_on(beams);
    if (auto valid = check_beams(*beams); !valid) return pass_on(valid);
    calibration.beams = std::move(*beams);
  }
  return calibration;
}

Result<CalibrationParams> read_calibration(const std::string& path, const Recipe& recipe) {
  if (path.ends_with(".json")) {
    auto read = read_recipe(path);
    if (!read) return pass_on(read);
    return std::move(read->calibration);
  }
  Recipe with = recipe;
  if (auto taken = take_calibration_file(with, path); !taken) return pass_on(taken);
  return std::move(with.calibration);
}

}  // namespace sonar
