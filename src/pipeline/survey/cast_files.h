// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/result.h"
#include "geo/sound_ray.h"

namespace sonar {

/// A sound speed profile out of any file that holds one, known by its content: a table depth_m,sound_speed_mps (CSV),
/// Sea-Bird's converted CTD cast (.cnv), or a CTD cast as Time Step Data (%TSD, .ctd). Of a cast the measured sound speed is
/// taken where there is one, else Mackenzie's of temperature and salinity; depth, else that of the pressure. Of a cast that
/// goes down and up, lines that are no deeper than one before are left out; of one that only goes up, the same from its end.
/// errors  format, bad_parameter; naming the file
/// source  depth of pressure: Saunders 1981, J. Phys. Oceanogr. 11, 573; formats: Sea-Bird SBE Data Processing manual,
///         appendix on .cnv; R package TSD (arnejohannesholmin)
[[nodiscard]] Result<SoundProfile> profile_from_bytes(std::string_view bytes, const std::string& file);
/// errors  also not_found, io
[[nodiscard]] Result<SoundProfile> read_sound_profile(const std::filesystem::path& path);

}  // namespace sonar
