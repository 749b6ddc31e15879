// SPDX-License-Identifier: Apache-2.0
#include "cli/chosen_recipe.h"

#include <fmt/format.h>

#include <utility>

#include "cli/log.h"
#include "cli/named_path.h"

namespace sonar {
namespace {

/// What a file says is no wrong usage of the verb that reads it, whatever is wrong with it.
Error of_file(Error error) {
  if (error.code == ErrorCode::bad_parameter) error.code = ErrorCode::format;
  return error;
}

}  // namespace

void add_measured_options(CLI::App& verb, Measured& measured) {
  verb.add_option("--calibration", measured.calibration, kCalibrationHelp)->check(named_file());
  verb.add_option("--sound-speed", measured.sound_speed, kSoundSpeedHelp)->check(named_path("X|FILE"));
  verb.add_option("--currents", measured.currents, kCurrentsHelp)->check(named_file());
}

Result<Recipe> chosen_recipe(const std::string& recipe, const Measured& measured) {
  auto chosen = named_recipe(recipe);
  if (!chosen) return tl::unexpected(of_file(std::move(chosen.error())));
  for (const std::string& note : chosen->notes) print_note(fmt::format("earlier-parameter: {}: {}", recipe, note));
  return with_measured(std::move(*chosen), measured);
}

Result<Recipe> with_measured(Recipe recipe, const Measured& measured) {
  if (!measured.calibration.empty()) {
    auto taken = take_calibration_file(recipe, measured.calibration);
    if (!taken) return tl::unexpected(of_file(std::move(taken.error())));
  }
  if (!measured.sound_speed.empty()) {
    auto taken = take_sound_speed(recipe, measured.sound_speed);
    if (!taken && !taken.error().where.file.empty()) return tl::unexpected(of_file(std::move(taken.error())));
    if (!taken) return pass_on(taken);
  }
  if (!measured.currents.empty()) {
    auto taken = take_currents(recipe, measured.currents);
    if (!taken) return tl::unexpected(of_file(std::move(taken.error())));
  }
  return recipe;
}

}  // namespace sonar
