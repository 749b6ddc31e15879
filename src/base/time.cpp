// SPDX-License-Identifier: Apache-2.0
#include "base/time.h"

#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <cmath>
#include <cstddef>

namespace sonar {
namespace {

constexpr std::uint64_t kTicksTo1970 = 11'644'473'600ULL * 10'000'000ULL;
constexpr std::uint64_t kTicksTo2200 = kTicksTo1970 + 7'258'118'400ULL * 10'000'000ULL;

struct Calendar {
  int year, month, day, hour, minute, second;
  std::int64_t nanosecond;
};

Calendar calendar_of(TimeNs time) {
  using namespace std::chrono;
  const sys_time<nanoseconds> instant{nanoseconds{time}};
  const auto day = floor<days>(instant);
  const year_month_day date{day};
  const hh_mm_ss<nanoseconds> clock{instant - day};
  return {static_cast<int>(date.year()),
          static_cast<int>(static_cast<unsigned>(date.month())),
          static_cast<int>(static_cast<unsigned>(date.day())),
          static_cast<int>(clock.hours().count()),
          static_cast<int>(clock.minutes().count()),
          static_cast<int>(clock.seconds().count()),
          clock.subseconds().count()};
}

std::optional<int> digits(std::string_view text, std::size_t first, std::size_t count) {
  if (text.size() < first + count) return std::nullopt;
  int value = 0;
  const char* begin = text.data() + first;
  const auto [end, error] = std::from_chars(begin, begin + count, value);
  if (error != std::errc{} || end != begin + count || *begin == '-') return std::nullopt;
  return value;
}

}  // namespace

std::optional<TimeNs> time_from_filetime(std::uint64_t filetime) {
  if (filetime < kTicksTo1970 || filetime >= kTicksTo2200) return std::nullopt;
  return static_cast<TimeNs>((filetime - kTicksTo1970) * 100);
}

std::uint64_t filetime_from_time(TimeNs time) { return static_cast<std::uint64_t>(time) / 100 + kTicksTo1970; }

std::string iso_time(TimeNs time) {
  const Calendar c = calendar_of(time);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", c.year, c.month, c.day, c.hour, c.minute, c.second,
                     c.nanosecond / 1'000'000);
}

std::string time_text(TimeNs time) {
  std::string text = iso_time(time);
  text.replace(text.find('T'), 1, " ");
  text.replace(text.size() - 1, 1, " UTC");
  return text;
}

std::string raw_name_time(TimeNs time) {
  const Calendar c = calendar_of(time);
  return fmt::format("{:04}{:02}{:02}-T{:02}{:02}{:02}", c.year, c.month, c.day, c.hour, c.minute, c.second);
}

std::optional<TimeNs> time_from_iso(std::string_view text) {
  if (text.size() < 20 || text[4] != '-' || text[7] != '-' || text[10] != 'T' || text[13] != ':' || text[16] != ':' ||
      text.back() != 'Z') {
    return std::nullopt;
  }
  const auto year = digits(text, 0, 4), month = digits(text, 5, 2), day = digits(text, 8, 2);
  const auto hour = digits(text, 11, 2), minute = digits(text, 14, 2), second = digits(text, 17, 2);
  if (!year || !month || !day || !hour || !minute || !second) return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year{*year}, std::chrono::month{static_cast<unsigned>(*month)},
                                         std::chrono::day{static_cast<unsigned>(*day)}};
  // 64 bits of nanoseconds reach from 1678 to 2261.
  if (!date.ok() || *year < 1700 || *year > 2200 || *hour > 23 || *minute > 59 || *second > 60) return std::nullopt;
  std::int64_t fraction = 0;
  if (text.size() > 20) {
    if (text[19] != '.' || text.size() < 22 || text.size() > 30) return std::nullopt;
    std::int64_t scale = 100'000'000;
    for (const char c : text.substr(20, text.size() - 21)) {
      if (c < '0' || c > '9') return std::nullopt;
      fraction += (c - '0') * scale;
      scale /= 10;
    }
  }
  return time_from_calendar(*year, *month, *day, *hour * 3600.0 + *minute * 60.0 + *second) + fraction;
}

TimeNs time_from_calendar(int year, int month, int day, double second_of_day) {
  using namespace std::chrono;
  const year_month_day date{std::chrono::year{year}, std::chrono::month{static_cast<unsigned>(month)},
                            std::chrono::day{static_cast<unsigned>(day)}};
  const TimeNs midnight = duration_cast<nanoseconds>(sys_days{date}.time_since_epoch()).count();
  return midnight + static_cast<TimeNs>(std::llround(second_of_day * 1e9));
}

}  // namespace sonar
