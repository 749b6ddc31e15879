// SPDX-License-Identifier: Apache-2.0
#include "io/cf_time.h"

#include <array>
#include <charconv>
#include <chrono>
#include <cstddef>
#include <utility>

namespace sonar::cf {
namespace {

struct Unit {
  std::string_view name;
  double seconds;
};
constexpr std::array<Unit, 20> kUnits{
    {{"days", 86400.0}, {"day", 86400.0}, {"d", 86400.0},         {"hours", 3600.0},
     {"hour", 3600.0},  {"hr", 3600.0},   {"h", 3600.0},          {"minutes", 60.0},
     {"minute", 60.0},  {"min", 60.0},    {"seconds", 1.0},       {"second", 1.0},
     {"sec", 1.0},      {"s", 1.0},       {"milliseconds", 1e-3}, {"millisecond", 1e-3},
     {"msec", 1e-3},    {"ms", 1e-3},     {"microseconds", 1e-6}, {"microsecond", 1e-6}}};

/// A number at the beginning, which it takes off.
std::optional<double> take_number(std::string_view& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  if (error != std::errc{} || value < 0.0) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

bool take(std::string_view& text, char wanted) {
  if (text.empty() || text.front() != wanted) return false;
  text.remove_prefix(1);
  return true;
}

void take_blanks(std::string_view& text) {
  while (take(text, ' ')) {
  }
}

/// Year, month, day: whole numbers.
std::optional<std::array<int, 3>> take_date(std::string_view& text) {
  std::array<int, 3> date{};
  for (std::size_t i = 0; i < date.size(); ++i) {
    if (i > 0 && !take(text, '-')) return std::nullopt;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), date[i]);
    if (error != std::errc{}) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
  const auto [year, month, day] = date;
  if (year < 1800 || year > 2200 || month < 1 || day < 1) return std::nullopt;
  const std::chrono::year_month_day named{std::chrono::year{year}, std::chrono::month{static_cast<unsigned>(month)},
                                          std::chrono::day{static_cast<unsigned>(day)}};
  return named.ok() ? std::optional(date) : std::nullopt;
}

/// Hours, and minutes and seconds where they are told.
std::optional<double> take_clock_s(std::string_view& text) {
  double sum = 0.0;
  double unit = 3600.0;
  for (int i = 0; i < 3; ++i) {
    if (i > 0 && !take(text, ':')) break;
    const auto number = take_number(text);
    if (!number || *number > (i == 0 ? 24.0 : 60.0)) return std::nullopt;
    sum += *number * unit;
    unit /= 60.0;
  }
  return sum;
}

}  // namespace

std::optional<TimeAxis> time_axis(std::string_view units) {
  constexpr std::string_view kSince = " since ";
  const std::size_t at = units.find(kSince);
  if (at == std::string_view::npos) return std::nullopt;
  TimeAxis axis{0, 0.0};
  for (const Unit& one : kUnits) {
    if (units.substr(0, at) == one.name) axis.unit_s = one.seconds;
  }
  std::string_view rest = units.substr(at + kSince.size());
  take_blanks(rest);
  const auto date = take_date(rest);
  if (axis.unit_s == 0.0 || !date) return std::nullopt;
  double clock_s = 0.0;
  if (!take(rest, 'T')) take_blanks(rest);
  if (!rest.empty() && rest.front() >= '0' && rest.front() <= '9') {
    const auto told = take_clock_s(rest);
    if (!told) return std::nullopt;
    clock_s = *told;
  }
  take_blanks(rest);
  // A zone that is not UTC would shift the currents by hours: it is refused, not guessed at.
  constexpr std::array<std::string_view, 6> kUtc{"", "Z", "UTC", "+00:00", "+0:00", "0:00"};
  bool utc = false;
  for (const std::string_view zone : kUtc) utc = utc || rest == zone;
  if (!utc) return std::nullopt;
  axis.origin = time_from_calendar((*date)[0], (*date)[1], (*date)[2], clock_s);
  return axis;
}

}  // namespace sonar::cf
