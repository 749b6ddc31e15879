// SPDX-License-Identifier: Apache-2.0
#include "pipeline/live/alarm.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "io/nmea.h"

namespace sonar {
namespace {

/// Visitor: the numeric column of a name.
struct NumberOf {
  std::string_view wanted;
  std::optional<double> found;

  void operator()(std::string_view name, std::string_view, double value) { take(name, value); }
  void operator()(std::string_view name, std::string_view, std::int64_t value) {
    take(name, static_cast<double>(value));
  }
  void operator()(std::string_view name, std::string_view, DegreesColumn value) { take(name, value.value); }
  void operator()(std::string_view, std::string_view, TimeColumn) {}
  void operator()(std::string_view, std::string_view, const std::string&) {}

 private:
  void take(std::string_view name, double value) {
    if (name == wanted) found = value;
  }
};

std::optional<double> number_of(const SchoolPingRow& row, std::string_view column) {
  NumberOf number{column, {}};
  SchoolPingRow copy = row;
  columns(number, copy);
  return number.found;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

}  // namespace

Result<Alarm> Alarm::parse(std::string_view rule) {
  Alarm alarm;
  alarm.text_ = rule;
  while (true) {
    const std::string_view one = trimmed(rule.substr(0, rule.find(',')));
    const auto sign = one.find_first_of("<>");
    const std::string_view column = trimmed(one.substr(0, sign));
    const auto limit = sign == std::string_view::npos ? std::nullopt : nmea_number(trimmed(one.substr(sign + 1)));
    if (!limit || !number_of({}, column)) {
      return fail(ErrorCode::usage,
                  fmt::format("'{}': expected a numeric column of school_pings.csv, < or >, and a number, as in "
                              "\"volume_m3 > 20000, range_m < 150\"",
                              one));
    }
    alarm.comparisons_.push_back({std::string(column), one[sign] == '>', *limit});
    if (rule.find(',') == std::string_view::npos) return alarm;
    rule.remove_prefix(rule.find(',') + 1);
  }
}

bool Alarm::holds(const SchoolPingRow& row) const {
  return std::all_of(comparisons_.begin(), comparisons_.end(), [&](const Comparison& comparison) {
    const double value = number_of(row, comparison.column).value_or(kUnknown);
    return comparison.above ? value > comparison.limit : value < comparison.limit;
  });
}

std::vector<Alarms::Ringing> Alarms::ring(std::span<const LiveSchool> schools) {
  std::vector<Ringing> ringing;
  for (const LiveSchool& school : schools) {
    for (const Alarm& alarm : alarms_) {
      const std::pair told(name_of(school), alarm.text());
      const auto at = std::find_if(school.since.begin(), school.since.end(),
                                   [&](const SchoolPingRow& row) { return alarm.holds(row); });
      if (at == school.since.end()) {
        rung_.erase(told);
      } else if (rung_.insert(told).second) {
        ringing.push_back({alarm.text(), school});
        ringing.back().school.newest = *at;
      }
    }
  }
  return ringing;
}

}  // namespace sonar
