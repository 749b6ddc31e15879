// SPDX-License-Identifier: Apache-2.0
#include "io/nmea_targets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/units.h"
#include "io/raw_datagrams.h"

namespace sonar {
namespace {

/// "ddmm.mmmm,N"; of a longitude three digits of degrees. Both fields empty where it is not known.
std::string angle_fields(double degrees, int digits, std::string_view sides) {
  if (!std::isfinite(degrees)) return ",";
  constexpr double kPerDegree = 600'000.0;  // ten-thousandths of a minute
  const auto units = static_cast<std::int64_t>(std::llround(std::abs(degrees) * kPerDegree));
  return fmt::format("{:0{}}{:02}.{:04},{}", units / 600'000, digits, units % 600'000 / 10'000, units % 10'000,
                     sides[std::signbit(degrees) ? 1 : 0]);
}

/// 0.0 to 359.9
std::string direction_field(double degrees) {
  if (!std::isfinite(degrees)) return {};
  const auto tenths = ((std::llround(degrees * 10.0) % 3600) + 3600) % 3600;
  return fmt::format("{}.{}", tenths / 10, tenths % 10);
}

std::string number_field(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : std::string{};
}

/// Without what a sentence is told apart by.
std::string name_field(std::string name) {
  std::replace_if(
      name.begin(), name.end(),
      [](char c) { return c < ' ' || c > '}' || std::string_view(",*$!\\^").find(c) != std::string_view::npos; }, ' ');
  return name;
}

/// "hhmmss.ss"
std::string time_field(TimeNs time) {
  constexpr TimeNs kHundredth = kSecondNs / 100;
  constexpr TimeNs kDay = 24 * 60 * 60 * 100;
  const TimeNs of_day = ((time / kHundredth) % kDay + kDay) % kDay;
  return fmt::format("{:02}{:02}{:02}.{:02}", of_day / 360'000, of_day / 6'000 % 60, of_day / 100 % 60, of_day % 100);
}

std::string sentence(const std::string& body) { return nmea_sentence(body) + "\r\n"; }

}  // namespace

std::string tll_sentence(const NmeaTarget& target) {
  return sentence(fmt::format("SSTLL,{:02},{},{},{},{},{},", target.number % 100,
                              angle_fields(target.latitude_deg, 2, "NS"), angle_fields(target.longitude_deg, 3, "EW"),
                              name_field(target.name), time_field(target.time), target.lost ? 'L' : 'T'));
}

std::string ttm_sentence(const NmeaTarget& target) {
  // Closest approach is not told: fish keep no course.
  return sentence(fmt::format("SSTTM,{:02},{},{},T,{},{},T,,,N,{},{},,{},A", target.number % 100,
                              number_field(target.distance_m / kMetresPerNauticalMile, 3),
                              direction_field(target.bearing_deg), number_field(target.speed_mps / kKnot_mps, 1),
                              direction_field(target.course_deg), name_field(target.name), target.lost ? 'L' : 'T',
                              time_field(target.time)));
}

}  // namespace sonar
