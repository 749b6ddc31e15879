// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "model/school.h"

namespace sonar {

/// How schools behaved at one distance, direction or time from the ship: a row of avoidance.csv. Means over schools, of
/// each school's own mean in the bin; NaN = unknown.
struct AvoidanceRow {
  std::string against;  ///< the column of school_pings.csv that is divided into bins
  double from = kUnknown;
  double to = kUnknown;
  std::int64_t n_schools = 0;
  std::int64_t n_pings = 0;
  double speed_smoothed_mps = kUnknown;
  double speed_smoothed_se_mps = kUnknown;
  double speed_away_mps = kUnknown;
  double speed_away_se_mps = kUnknown;
  double speed_away_water_mps = kUnknown;
  double speed_away_water_se_mps = kUnknown;
  double course_away_deg = kUnknown;
  double course_away_se_deg = kUnknown;
  double depth_m = kUnknown;
  double depth_se_m = kUnknown;
  double vertical_speed_smoothed_mps = kUnknown;
  double vertical_speed_smoothed_se_mps = kUnknown;
  double sv_mean_db = kUnknown;  ///< of means of sv
  double sv_mean_se_db = kUnknown;
  // Quartiles of the schools' own means, each school once.
  double speed_smoothed_p25_mps = kUnknown;
  double speed_smoothed_p50_mps = kUnknown;
  double speed_smoothed_p75_mps = kUnknown;
  double speed_away_p25_mps = kUnknown;
  double speed_away_p50_mps = kUnknown;
  double speed_away_p75_mps = kUnknown;
  double speed_away_water_p25_mps = kUnknown;
  double speed_away_water_p50_mps = kUnknown;
  double speed_away_water_p75_mps = kUnknown;
  double course_away_p25_deg = kUnknown;
  double course_away_p50_deg = kUnknown;
  double course_away_p75_deg = kUnknown;
  double depth_p25_m = kUnknown;
  double depth_p50_m = kUnknown;
  double depth_p75_m = kUnknown;
  double vertical_speed_smoothed_p25_mps = kUnknown;
  double vertical_speed_smoothed_p50_mps = kUnknown;
  double vertical_speed_smoothed_p75_mps = kUnknown;
  double sv_mean_p25_db = kUnknown;
  double sv_mean_p50_db = kUnknown;
  double sv_mean_p75_db = kUnknown;
};

template <class Visitor>
void columns(Visitor& v, AvoidanceRow& r) {
  v("against", "", r.against);
  v("from", "1", r.from);
  v("to", "1", r.to);
  v("n_schools", "1", r.n_schools);
  v("n_pings", "1", r.n_pings);
  v("speed_smoothed_mps", "m s-1", r.speed_smoothed_mps);
  v("speed_smoothed_se_mps", "m s-1", r.speed_smoothed_se_mps);
  v("speed_away_mps", "m s-1", r.speed_away_mps);
  v("speed_away_se_mps", "m s-1", r.speed_away_se_mps);
  v("speed_away_water_mps", "m s-1", r.speed_away_water_mps);
  v("speed_away_water_se_mps", "m s-1", r.speed_away_water_se_mps);
  v("course_away_deg", "degrees", r.course_away_deg);
  v("course_away_se_deg", "degrees", r.course_away_se_deg);
  v("depth_m", "m", r.depth_m);
  v("depth_se_m", "m", r.depth_se_m);
  v("vertical_speed_smoothed_mps", "m s-1", r.vertical_speed_smoothed_mps);
  v("vertical_speed_smoothed_se_mps", "m s-1", r.vertical_speed_smoothed_se_mps);
  v("sv_mean_db", "dB re 1 m-1", r.sv_mean_db);
  v("sv_mean_se_db", "dB", r.sv_mean_se_db);
  // Quartiles of the schools' own means.
  v("speed_smoothed_p25_mps", "m s-1", r.speed_smoothed_p25_mps);
  v("speed_smoothed_p50_mps", "m s-1", r.speed_smoothed_p50_mps);
  v("speed_smoothed_p75_mps", "m s-1", r.speed_smoothed_p75_mps);
  v("speed_away_p25_mps", "m s-1", r.speed_away_p25_mps);
  v("speed_away_p50_mps", "m s-1", r.speed_away_p50_mps);
  v("speed_away_p75_mps", "m s-1", r.speed_away_p75_mps);
  v("speed_away_water_p25_mps", "m s-1", r.speed_away_water_p25_mps);
  v("speed_away_water_p50_mps", "m s-1", r.speed_away_water_p50_mps);
  v("speed_away_water_p75_mps", "m s-1", r.speed_away_water_p75_mps);
  v("course_away_p25_deg", "degrees", r.course_away_p25_deg);
  v("course_away_p50_deg", "degrees", r.course_away_p50_deg);
  v("course_away_p75_deg", "degrees", r.course_away_p75_deg);
  v("depth_p25_m", "m", r.depth_p25_m);
  v("depth_p50_m", "m", r.depth_p50_m);
  v("depth_p75_m", "m", r.depth_p75_m);
  v("vertical_speed_smoothed_p25_mps", "m s-1", r.vertical_speed_smoothed_p25_mps);
  v("vertical_speed_smoothed_p50_mps", "m s-1", r.vertical_speed_smoothed_p50_mps);
  v("vertical_speed_smoothed_p75_mps", "m s-1", r.vertical_speed_smoothed_p75_mps);
  v("sv_mean_p25_db", "dB re 1 m-1", r.sv_mean_p25_db);
  v("sv_mean_p50_db", "dB re 1 m-1", r.sv_mean_p50_db);
  v("sv_mean_p75_db", "dB re 1 m-1", r.sv_mean_p75_db);
}

}  // namespace sonar
