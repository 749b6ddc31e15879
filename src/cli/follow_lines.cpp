// SPDX-License-Identifier: Apache-2.0
#include "cli/follow_lines.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace sonar {
namespace {

using nlohmann::json;

json number(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

/// Visitor: a row's columns as members.
struct Members {
  json made = json::object();
  void operator()(std::string_view name, std::string_view, double value) { made[std::string(name)] = number(value); }
  void operator()(std::string_view name, std::string_view, std::int64_t value) { made[std::string(name)] = value; }
  void operator()(std::string_view name, std::string_view, const std::string& value) {
    made[std::string(name)] = value;
  }
  void operator()(std::string_view name, std::string_view, DegreesColumn value) {
    made[std::string(name)] = number(value.value);
  }
  void operator()(std::string_view name, std::string_view, TimeColumn value) {
    made[std::string(name)] = value.value == 0 ? json(nullptr) : json(iso_time(value.value));
  }
};

}  // namespace

json school_json(const LiveSchool& school) {
  Members members;
  SchoolPingRow row = school.newest;
  columns(members, row);
  members.made["speed_mps"] = number(school.school.speed_mps);
  members.made["course_deg"] = number(school.school.course_deg);
  return members.made;
}

json status_json(const LiveStatus& status) {
  return {{"observation", status.observation},
          {"pings", status.pings},
          {"newest_utc", iso_time(status.newest)},
          {"pings_per_minute", number(status.pings_per_minute)},
          {"behind_s", number(status.behind_s)},
          {"position_age_s", number(status.position_age_s)},
          {"heading_age_s", number(status.heading_age_s)},
          {"gps_minus_clock_s", number(status.gps_minus_clock_s)},
          {"lost_channels", status.missing_channels},
          {"disk_left_gb", number(status.disk_left_gb)}};
}

}  // namespace sonar
