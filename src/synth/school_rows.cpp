// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>

#include "base/units.h"
#include "synth/truth.h"

namespace sonar::synth {
namespace {

using Rows = std::vector<const SchoolPingRow*>;

double mean(const Rows& rows, double SchoolPingRow::*member) {
  double sum = 0.0;
  for (const SchoolPingRow* row : rows) sum += row->*member;
  return sum / static_cast<double>(rows.size());
}

double mean_db(const Rows& rows, double SchoolPingRow::*member) {
  double sum = 0.0;
  for (const SchoolPingRow* row : rows) sum += linear_from_db(row->*member);
  return db_from_linear(sum / static_cast<double>(rows.size()));
}

double median(const Rows& rows, double SchoolPingRow::*member) {
  std::vector<double> values;
  for (const SchoolPingRow* row : rows) values.push_back(row->*member);
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2.0;
}

void fill_motion(SchoolRow& school, const std::vector<BodyTruth>& bodies, const Rows& rows) {
  double east = 0.0;
  double north = 0.0;
  double down = 0.0;
  int n = 0;
  for (const BodyTruth& body : bodies) {
    if (body.school_id != school.school_id) continue;
    const bool seen = std::any_of(rows.begin(), rows.end(),
                                  [&](const SchoolPingRow* row) { return row->ping_index == body.ping_index; });
    if (!seen) continue;
    east += body.east_mps;
    north += body.north_mps;
    down += body.down_mps;
    ++n;
  }
  if (n == 0) return;
  school.speed_mps = std::hypot(east, north) / n;
  school.speed_se_mps = 0.0;
  school.course_deg = wrap_360(deg_from_rad(std::atan2(east, north)));
  school.vertical_speed_mps = down / n;
}

SchoolRow school_row(std::int64_t id, const Rows& all) {
  Rows used;
  for (const SchoolPingRow* row : all) {
    if (row->touches_edge == 0) used.push_back(row);
  }
  SchoolRow school;
  school.observation = all.front()->observation;
  school.school_id = id;
  school.first_time_utc = all.front()->time_utc;
  school.last_time_utc = all.back()->time_utc;
  school.n_pings = static_cast<std::int64_t>(all.size());
  school.n_pings_whole = static_cast<std::int64_t>(used.size());
  school.touches_edge_fraction = 1.0 - static_cast<double>(used.size()) / static_cast<double>(all.size());
  const Rows& rows = used.empty() ? all : used;
  school.latitude = mean(rows, &SchoolPingRow::latitude);
  school.longitude = mean(rows, &SchoolPingRow::longitude);
  school.depth_m = mean(rows, &SchoolPingRow::depth_m);
  school.volume_m3 = median(rows, &SchoolPingRow::volume_m3);
  school.volume_corrected_m3 = mean(rows, &SchoolPingRow::volume_corrected_m3);
  school.length_m = median(rows, &SchoolPingRow::length_m);
  school.width_m = median(rows, &SchoolPingRow::width_m);
  school.height_m = median(rows, &SchoolPingRow::height_m);
  school.sv_mean_db = mean_db(rows, &SchoolPingRow::sv_mean_db);
  school.backscatter_m2 = mean(rows, &SchoolPingRow::backscatter_m2);
  school.sv_corrected_db = mean_db(rows, &SchoolPingRow::sv_corrected_db);
  return school;
}

}  // namespace

std::vector<SchoolRow> school_rows(const std::vector<SchoolPingRow>& rows, const std::vector<BodyTruth>& bodies) {
  std::map<std::int64_t, Rows> by_school;
  for (const SchoolPingRow& row : rows) by_school[row.school_id].push_back(&row);
  std::vector<SchoolRow> schools;
  for (const auto& [id, pings] : by_school) {
    schools.push_back(school_row(id, pings));
    fill_motion(schools.back(), bodies, pings);
  }
  return schools;
}

}  // namespace sonar::synth
