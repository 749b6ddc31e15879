// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "base/result.h"
#include "geo/sound_ray.h"
#include "io/csv_table.h"

namespace sonar {

/// Speed at which sound travels from one depth to another: harmonic mean of the profile, linear between its lines, the
/// first and the last holding beyond. The value there where both depths are one.
/// profile  not empty, sound
/// depths   m, positive down, either order
[[nodiscard]] double harmonic_mean_mps(const SoundProfile& profile, double from_depth_m, double to_depth_m);

/// One speed that a user gives for all depths; 0 = none given.
/// errors  bad_parameter: a speed that no water has (1000 to 2000 m/s)
[[nodiscard]] Result<void> check_sound_speed(double sound_speed_mps);
/// errors  bad_parameter: depths that do not rise, a speed that no water has (1000 to 2000 m/s)
[[nodiscard]] Result<void> check_profile(const SoundProfile& profile);
/// A table with columns depth_m and sound_speed_mps.
/// errors  format, bad_parameter; naming the file
[[nodiscard]] Result<SoundProfile> profile_from_table(const CsvTable& table);

/// [[depth_m, sound_speed_mps], ...]
[[nodiscard]] nlohmann::json to_json(const SoundProfile& profile);
/// errors  format, bad_parameter
[[nodiscard]] Result<SoundProfile> profile_from_json(const nlohmann::json& json);

}  // namespace sonar
