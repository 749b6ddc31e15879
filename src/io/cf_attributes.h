// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/time.h"
#include "io/netcdf_file.h"
#include "model/product.h"

// What the CF conventions (1.11) ask of a file beside its numbers. Units are UDUNITS', but for those of decibels.
namespace sonar::cf {

inline constexpr std::string_view kConventions = "CF-1.11";
/// Standard name of Sv: 10 log10 of the volume backscattering coefficient against 1 m^-1.
inline constexpr std::string_view kVolumeBackscattering = "acoustic_volume_backscattering_strength_in_sea_water";
inline constexpr std::string_view kMicroseconds = "microseconds since 1970-01-01 00:00:00";

/// What a file is and whence: the attributes that products and what is made of them have in common.
void describe_file(netcdf::Writer& out, std::string_view title, const ObservationProduct& product);

/// Names a variable: long_name, and standard_name where there is one.
void name(netcdf::Writer& out, int group, int variable, std::string_view long_name,
          std::string_view standard_name = {});
/// Where a variable's values lie: names of variables in its group, apart by blanks.
void place(netcdf::Writer& out, int group, int variable, std::string_view coordinates);
/// A variable of bytes that is 0 or 1.
void flags(netcdf::Writer& out, int group, int variable, std::string_view meanings);

/// Times as int64 microseconds, which every reader takes for dates.
/// times  0 = unknown where `may_lack`: such variables have a _FillValue, by which some readers decode all of them through
///        doubles, off by a tenth of a microsecond; so those that are never unknown have none
int times(netcdf::Writer& out, int group, const std::string& name, std::string_view long_name,
          const netcdf::Dimension& dimension, std::span<const TimeNs> times, bool may_lack = false);
/// The pings' times: `time` as above, and `time_ns` to the last nanosecond, the key by which journals know a ping. That is a
/// number for its readers: UDUNITS takes "nanoseconds since" for no number at all ("nan"), and cftime knows none.
void ping_times(netcdf::Writer& out, int group, const netcdf::Dimension& ping, std::span<const TimeNs> times);

}  // namespace sonar::cf
