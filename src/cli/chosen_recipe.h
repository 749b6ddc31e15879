// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "pipeline/recipe/recipe.h"

namespace sonar {

inline constexpr const char* kCalibrationHelp =
    "CSV channel and any of gain_db,sa_correction_db,extra_factor_db,psi_db,width_along_deg,width_athwart_deg, each "
    "with "
    "its error in a column *_se; taken into the recipe";

inline constexpr const char* kSoundSpeedHelp =
    "m/s, or a profile (CSV depth_m,sound_speed_mps, Sea-Bird .cnv, or .ctd of Time Step Data): stands for the files' "
    "sound speed; taken into the recipe";

inline constexpr const char* kCurrentsHelp =
    "netCDF of an ADCP (CF, CODAS/UHDAS or OceanSITES names): the water's velocity, for speeds through the water; "
    "taken "
    "into the recipe";

/// What a verb's options lay over a recipe; empty = nothing.
struct Measured {
  std::string calibration;
  std::string sound_speed;
  std::string currents = {};
  [[nodiscard]] bool empty() const { return calibration.empty() && sound_speed.empty() && currents.empty(); }
};
void add_measured_options(CLI::App& verb, Measured& measured);

/// The recipe of a file or preset (empty = default) with what was measured taken into it.
/// errors  as named_recipe(), take_calibration_file(), take_sound_speed(), take_currents(); format, too, where a file names a value out of
///         range
[[nodiscard]] Result<Recipe> chosen_recipe(const std::string& recipe, const Measured& measured);
/// errors  as take_calibration_file(), take_sound_speed(), take_currents()
[[nodiscard]] Result<Recipe> with_measured(Recipe recipe, const Measured& measured);

}  // namespace sonar
