// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace sonar {

/// One count of stored power or Sv: 10 log10(2) / 256 dB (Simrad's compressed power).
inline constexpr double kDbPerCount = 3.0102999566398119521 / 256.0;

/// The count that says "no data".
inline constexpr std::int16_t kNoData = -32768;

/// Smallest and largest count that data may hold; the two values beyond them are the masked median's plus and minus
/// infinity.
inline constexpr std::int16_t kMinCount = -32766;
inline constexpr std::int16_t kMaxCount = 32766;

inline constexpr double kMetresPerNauticalMile = 1852.0;
inline constexpr double kKnot_mps = kMetresPerNauticalMile / 3600.0;

[[nodiscard]] inline double db_from_linear(double linear) { return 10.0 * std::log10(linear); }
[[nodiscard]] inline double linear_from_db(double db) { return std::pow(10.0, db / 10.0); }
[[nodiscard]] constexpr double db_from_counts(double counts) { return counts * kDbPerCount; }
[[nodiscard]] constexpr double counts_from_db(double db) { return db / kDbPerCount; }
[[nodiscard]] constexpr double rad_from_deg(double deg) { return deg * (std::numbers::pi / 180.0); }
[[nodiscard]] constexpr double deg_from_rad(double rad) { return rad * (180.0 / std::numbers::pi); }

/// Linear value of a count (10^(dB/10)) by a table made once; thread-safe, 65536 entries, 0 for "no data".
[[nodiscard]] double linear_from_count(std::int16_t count);

}  // namespace sonar
