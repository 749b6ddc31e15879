// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "base/result.h"
#include "model/current.h"

namespace sonar {

/// Reads water velocities of an acoustic Doppler current profiler from netCDF: variables are known by their CF standard
/// name (eastward_sea_water_velocity, northward_sea_water_velocity, time, depth, latitude, longitude), else by the names
/// of CODAS/UHDAS (u, v, time, depth, lat, lon, pflag) or OceanSITES (UCUR, VCUR, EWCT, NSCT, TIME, DEPTH, ...). Depth is
/// one axis for all times, or as the velocities are. Values that are filled, above 20 m/s, flagged (pflag not 0) or of no time
/// from 1970 to 2199 are left out.
/// Velocities are kept to 0.1 mm/s, depths to 1 cm.
/// out     by rising time, of a time told twice the first; profiles without values are left out
/// errors  one line each. not_found, io: no such file. format: no netCDF, no such variable, a unit or a shape that is none
///         of those above, more than 400 000 values; no value at all. Naming the file and what was expected.
/// The file may be anything: it is read in a process that reaches nothing else.
[[nodiscard]] Result<CurrentProfiles> read_currents(const std::filesystem::path& path);

}  // namespace sonar
