// SPDX-License-Identifier: Apache-2.0
#include "pipeline/live/live_schools.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace sonar {
namespace {

std::string place(const SchoolPingRow& row) {
  return std::isfinite(row.latitude) ? fmt::format("{:.5f} {:.5f}", row.latitude, row.longitude) : "place unknown";
}

std::string motion(const SchoolRow& school) {
  if (!std::isfinite(school.speed_mps)) return "motion unknown";
  if (!std::isfinite(school.course_deg)) return fmt::format("{:.1f} m/s", school.speed_mps);
  return fmt::format("course {:.0f} deg, {:.1f} m/s", school.course_deg, school.speed_mps);
}

}  // namespace

std::vector<LiveSchool> live_schools(const ObservationProduct& product, const ObservationProduct* before) {
  std::vector<LiveSchool> schools;
  const std::int64_t fresh = before == nullptr ? 0 : std::ssize(before->pings);
  for (const SchoolRow& school : product.schools) {
    if (school.status == "rejected") continue;
    LiveSchool live;
    for (const SchoolPingRow& row : product.school_pings) {
      if (row.school_id != school.school_id) continue;
      live.newest = row;
      if (row.ping_index >= fresh) live.since.push_back(row);
    }
    live.is_new =
        before == nullptr || std::none_of(before->schools.begin(), before->schools.end(),
                                          [&](const SchoolRow& row) { return row.school_id == school.school_id; });
    if (live.since.empty() && !live.is_new) continue;
    live.school = school;
    live.ship = product.pings[static_cast<std::size_t>(live.newest.ping_index)];
    schools.push_back(std::move(live));
  }
  return schools;
}

std::string name_of(const LiveSchool& school) {
  return fmt::format("{}/{}", school.newest.observation, school.newest.school_id);
}

std::string school_line(const LiveSchool& school) {
  const SchoolPingRow& row = school.newest;
  const std::string bearing =
      std::isfinite(row.bearing_deg) ? fmt::format(" at {:.0f} deg", row.bearing_deg) : std::string{};
  return fmt::format("{} {}: {:.0f} m off{}, {:.0f} m deep; {}; {}; {:.0f} x {:.0f} x {:.0f} m, {:.1f} dB",
                     iso_time(row.time_utc), name_of(school), row.range_m, bearing, row.depth_m, place(row),
                     motion(school.school), row.length_m, row.width_m, row.height_m, row.sv_mean_db);
}

}  // namespace sonar
