// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "base/time.h"

namespace sonar {

/// One NMEA 0183 sentence, cut into fields; views into the text given.
struct NmeaSentence {
  std::string_view talker;               ///< two letters, "GP"; empty for proprietary sentences
  std::string_view type;                 ///< three letters, "GGA"; the whole id for proprietary ones
  std::vector<std::string_view> fields;  ///< after the id, the checksum left out; empty where a field is
  bool checksum_wrong = false;           ///< a checksum stood there and did not match

  /// Field i counted from 1 as in the tables; empty where there is none.
  [[nodiscard]] std::string_view field(std::size_t i) const { return i <= fields.size() ? fields[i - 1] : ""; }
};

/// Reads the text from `$` (or `!`, `@`) to the first CR, LF or NUL. Sentences without checksum are taken.
/// Empty where there is no such beginning or no id.
[[nodiscard]] std::optional<NmeaSentence> parse_nmea(std::string_view text);

/// A plain decimal number; empty for an empty field, for text, and for what is not finite.
[[nodiscard]] std::optional<double> nmea_number(std::string_view field);

struct NmeaPosition {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
};
/// From "ddmm.mmmm","N","dddmm.mmmm","E"; empty where a field is missing or impossible.
[[nodiscard]] std::optional<NmeaPosition> nmea_position(std::string_view latitude, std::string_view north_south,
                                                        std::string_view longitude, std::string_view east_west);

/// Valid position of a GGA, GLL or RMC.
[[nodiscard]] std::optional<NmeaPosition> nmea_fix(const NmeaSentence& sentence);

/// True heading of an HDT or THS, degrees [0, 360); of an HDG, the magnetic one with its deviation and variation.
[[nodiscard]] std::optional<double> nmea_heading(const NmeaSentence& sentence);

struct NmeaVelocity {
  double speed_mps = 0.0;
  double course_deg = 0.0;  ///< NaN where the field is empty (a ship at rest)
};
/// Over ground, from VTG or RMC.
[[nodiscard]] std::optional<NmeaVelocity> nmea_velocity(const NmeaSentence& sentence);

/// The vessel's log from VLW, nautical miles.
[[nodiscard]] std::optional<double> nmea_log(const NmeaSentence& sentence);

/// GPS time of a ZDA or RMC; of a GGA or GLL, the instant of that time of day nearest to `near`.
[[nodiscard]] std::optional<TimeNs> nmea_time(const NmeaSentence& sentence, TimeNs near);

}  // namespace sonar
