// SPDX-License-Identifier: Apache-2.0
#include "io/nmea.h"

#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/units.h"
#include "geo/frames.h"

namespace sonar {
namespace {

constexpr std::int64_t kDayNs = 86'400 * kSecondNs;
constexpr std::size_t kMaxFields = 64;

std::optional<int> hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return std::nullopt;
}

/// Cuts a trailing "*hh" off; tells whether it was there and wrong.
bool take_checksum(std::string_view& body) {
  const std::size_t star = body.rfind('*');
  if (star == std::string_view::npos) return false;
  const std::string_view text = body.substr(star + 1);
  const std::string_view covered = body.substr(0, star);
  body = covered;
  if (text.size() < 2) return !text.empty();
  const auto high = hex_digit(text[0]);
  const auto low = hex_digit(text[1]);
  if (!high || !low) return true;
  unsigned sum = 0;
  for (const char c : covered) sum ^= static_cast<unsigned char>(c);
  return sum != static_cast<unsigned>(*high * 16 + *low);
}

/// Degrees of "dddmm.mmm" with `limit` as the largest.
std::optional<double> angle(std::string_view field, double limit) {
  const auto value = nmea_number(field);
  if (!value || *value < 0.0 || *value > limit * 100.0) return std::nullopt;
  const double degrees = std::floor(*value / 100.0);
  const double minutes = *value - degrees * 100.0;
  if (minutes >= 60.0) return std::nullopt;
  const double result = degrees + minutes / 60.0;
  return result <= limit ? std::optional(result) : std::nullopt;
}

std::optional<double> signed_by(std::optional<double> value, std::string_view letter, char plus, char minus) {
  if (!value || letter.size() != 1) return std::nullopt;
  if (letter[0] == plus) return value;
  if (letter[0] == minus) return -*value;
  return std::nullopt;
}

/// Seconds of the day of "hhmmss.ss".
std::optional<double> time_of_day(std::string_view field) {
  const auto value = nmea_number(field);
  if (!value || field.size() < 6 || *value < 0.0 || *value >= 240000.0) return std::nullopt;
  const double hours = std::floor(*value / 10000.0);
  const double minutes = std::floor((*value - hours * 10000.0) / 100.0);
  const double seconds = *value - hours * 10000.0 - minutes * 100.0;
  if (minutes >= 60.0 || seconds >= 61.0) return std::nullopt;
  return hours * 3600.0 + minutes * 60.0 + seconds;
}

std::optional<TimeNs> instant(std::optional<double> second_of_day, int year, int month, int day) {
  const std::chrono::year_month_day date{std::chrono::year{year}, std::chrono::month{static_cast<unsigned>(month)},
                                         std::chrono::day{static_cast<unsigned>(day)}};
  if (!second_of_day || year < 1970 || year > 2199 || !date.ok()) return std::nullopt;
  return time_from_calendar(year, month, day, *second_of_day);
}

std::optional<int> whole(std::string_view field, int low, int high) {
  int value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc{} || end != field.data() + field.size() || value < low || value > high) return std::nullopt;
  return value;
}

std::optional<TimeNs> dated(const NmeaSentence& s) {
  if (s.type == "ZDA") {
    const auto day = whole(s.field(2), 1, 31), month = whole(s.field(3), 1, 12), year = whole(s.field(4), 1970, 2199);
    if (!day || !month || !year) return std::nullopt;
    return instant(time_of_day(s.field(1)), *year, *month, *day);
  }
  const std::string_view date = s.field(9);
  if (date.size() != 6 || s.field(2) == "V") return std::nullopt;
  const auto day = whole(date.substr(0, 2), 1, 31), month = whole(date.substr(2, 2), 1, 12),
             year = whole(date.substr(4, 2), 0, 99);
  if (!day || !month || !year) return std::nullopt;
  return instant(time_of_day(s.field(1)), *year < 80 ? 2000 + *year : 1900 + *year, *month, *day);
}

/// The instant of this time of day within half a day of `near`.
TimeNs nearest_day(double second_of_day, TimeNs near) {
  const TimeNs of_day = static_cast<TimeNs>(std::llround(second_of_day * 1e9));
  const TimeNs midnight = near - near % kDayNs;
  TimeNs best = midnight + of_day;
  if (best - near > kDayNs / 2) best -= kDayNs;
  if (near - best > kDayNs / 2) best += kDayNs;
  return best;
}

}  // namespace

std::optional<NmeaSentence> parse_nmea(std::string_view text) {
  const std::size_t start = text.find_first_of("$!@");
  if (start == std::string_view::npos) return std::nullopt;
  std::string_view body = text.substr(start + 1);
  body = body.substr(0, body.find_first_of(std::string_view("\r\n\0", 3)));
  NmeaSentence sentence;
  sentence.checksum_wrong = take_checksum(body);
  const std::string_view id = body.substr(0, body.find(','));
  if (id.size() < 3 || id.size() > 16) return std::nullopt;
  const bool standard = id.size() == 5 && id[0] != 'P';
  sentence.talker = standard ? id.substr(0, 2) : std::string_view{};
  sentence.type = standard ? id.substr(2) : id;
  std::size_t comma = id.size();
  while (comma < body.size() && sentence.fields.size() < kMaxFields) {
    const std::size_t next = std::min(body.find(',', comma + 1), body.size());
    sentence.fields.push_back(body.substr(comma + 1, next - comma - 1));
    comma = next;
  }
  return sentence;
}

std::optional<double> nmea_number(std::string_view field) {
  while (!field.empty() && field.front() == ' ') field.remove_prefix(1);
  while (!field.empty() && field.back() == ' ') field.remove_suffix(1);
  if (field.empty() || field.size() > 32) return std::nullopt;
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value, std::chars_format::fixed);
  if (error != std::errc{} || end != field.data() + field.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<NmeaPosition> nmea_position(std::string_view latitude, std::string_view north_south,
                                          std::string_view longitude, std::string_view east_west) {
  const auto lat = signed_by(angle(latitude, 90.0), north_south, 'N', 'S');
  const auto lon = signed_by(angle(longitude, 180.0), east_west, 'E', 'W');
  if (!lat || !lon) return std::nullopt;
  return NmeaPosition{*lat, wrap_180(*lon)};
}

std::optional<NmeaPosition> nmea_fix(const NmeaSentence& s) {
  if (s.type == "GGA") {
    if (s.field(6).empty() || s.field(6) == "0") return std::nullopt;
    return nmea_position(s.field(2), s.field(3), s.field(4), s.field(5));
  }
  if (s.type == "GLL") {
    if (s.field(6) == "V") return std::nullopt;
    return nmea_position(s.field(1), s.field(2), s.field(3), s.field(4));
  }
  if (s.type == "RMC" && s.field(2) != "V") {
    return nmea_position(s.field(3), s.field(4), s.field(5), s.field(6));
  }
  return std::nullopt;
}

std::optional<double> nmea_heading(const NmeaSentence& s) {
  const auto value = nmea_number(s.field(1));
  if (!value || *value < 0.0 || *value > 360.0) return std::nullopt;
  if (s.type == "HDT") return wrap_360(*value);
  if (s.type == "THS" && s.field(2) != "V") return wrap_360(*value);
  if (s.type != "HDG") return std::nullopt;
  const double deviation = signed_by(nmea_number(s.field(2)), s.field(3), 'E', 'W').value_or(0.0);
  const double variation = signed_by(nmea_number(s.field(4)), s.field(5), 'E', 'W').value_or(0.0);
  if (std::abs(deviation) > 180.0 || std::abs(variation) > 180.0) return std::nullopt;
  return wrap_360(*value + deviation + variation);
}

std::optional<NmeaVelocity> nmea_velocity(const NmeaSentence& s) {
  const bool vtg = s.type == "VTG";
  if (!vtg && (s.type != "RMC" || s.field(2) == "V")) return std::nullopt;
  auto speed = nmea_number(s.field(vtg ? 5 : 7));
  if (speed) {
    *speed *= kKnot_mps;
  } else if (vtg && nmea_number(s.field(7))) {
    speed = *nmea_number(s.field(7)) / 3.6;
  }
  // No ship on which a sonar records goes beyond 50 m/s.
  if (!speed || *speed < 0.0 || *speed > 50.0) return std::nullopt;
  const auto course = nmea_number(s.field(vtg ? 1 : 8));
  const bool known = course && *course >= 0.0 && *course <= 360.0;
  return NmeaVelocity{*speed, known ? wrap_360(*course) : std::numeric_limits<double>::quiet_NaN()};
}

std::optional<double> nmea_log(const NmeaSentence& s) {
  if (s.type != "VLW") return std::nullopt;
  const auto distance = nmea_number(s.field(1));
  return distance && *distance >= 0.0 ? distance : std::nullopt;
}

std::optional<TimeNs> nmea_time(const NmeaSentence& s, TimeNs near) {
  if (s.type == "ZDA" || s.type == "RMC") return dated(s);
  if (s.type != "GGA" && s.type != "GLL") return std::nullopt;
  const auto second = time_of_day(s.field(s.type == "GGA" ? 1 : 5));
  if (!second) return std::nullopt;
  return nearest_day(*second, near);
}

}  // namespace sonar
