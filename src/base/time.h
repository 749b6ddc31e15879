// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sonar {

/// UTC in nanoseconds since 1970-01-01.
using TimeNs = std::int64_t;

inline constexpr TimeNs kSecondNs = 1'000'000'000;

/// From Simrad's time stamp: 100 ns ticks since 1601-01-01. Empty outside 1970..2200.
[[nodiscard]] std::optional<TimeNs> time_from_filetime(std::uint64_t filetime);
[[nodiscard]] std::uint64_t filetime_from_time(TimeNs time);

/// "2026-11-21T19:57:26.123Z", rounded down to the millisecond.
[[nodiscard]] std::string iso_time(TimeNs time);
/// "2020-01-02 08:00:20.350 UTC", the same as people read it.
[[nodiscard]] std::string time_text(TimeNs time);
/// Reads what iso_time() writes; fraction of 0 to 9 digits.
[[nodiscard]] std::optional<TimeNs> time_from_iso(std::string_view text);

/// "20261121-T195726" as in raw file names ("D20261121-T195726").
[[nodiscard]] std::string raw_name_time(TimeNs time);

/// UTC from a calendar date and time of day. No leap seconds.
[[nodiscard]] TimeNs time_from_calendar(int year, int month, int day, double second_of_day);

}  // namespace sonar
