// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "base/time.h"

namespace sonar {

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Bits of SchoolPingRow::edge_flags (INTERFACES section 3).
enum EdgeFlags : std::int32_t {
  kEdgeFore = 1,
  kEdgeAft = 2,
  kEdgeTopFan = 4,
  kEdgeBottomFan = 8,
  kEdgeNear = 16,
  kEdgeFar = 32,
  kEdgeSeabed = 64,
  kEdgeSurface = 128,
  kEdgeFlagged = 256,
};
/// touches_edge = (edge_flags & kTouchesEdge) != 0.
inline constexpr std::int32_t kTouchesEdge = 255;
/// The centre of a mask cut here is not the school's centre along the ship or along range.
inline constexpr std::int32_t kCutsCentre = kEdgeFore | kEdgeAft | kEdgeNear | kEdgeFar;

/// One school in one ping: a row of school_pings.csv. NaN = unknown.
struct SchoolPingRow {
  std::string observation;
  std::int64_t school_id = 0;
  std::int64_t ping_index = 0;
  TimeNs time_utc = 0;
  double latitude = kUnknown;
  double longitude = kUnknown;
  double depth_m = kUnknown;
  double range_m = kUnknown;
  double bearing_deg = kUnknown;
  std::int64_t n_voxels = 0;
  std::int64_t n_beams = 0;
  std::int64_t n_fans = 0;
  double volume_m3 = kUnknown;
  double length_m = kUnknown;
  double width_m = kUnknown;
  double height_m = kUnknown;
  double axis_deg = kUnknown;
  double depth_min_m = kUnknown;
  double depth_max_m = kUnknown;
  double sv_mean_db = kUnknown;
  double sv_p95_db = kUnknown;
  double sv_max_db = kUnknown;
  double backscatter_m2 = kUnknown;
  double valid_fraction = kUnknown;
  double volume_corrected_m3 = kUnknown;
  double length_corrected_m = kUnknown;
  double width_corrected_m = kUnknown;
  double height_corrected_m = kUnknown;
  double sv_corrected_db = kUnknown;
  double snr_db = kUnknown;
  double threshold_db = kUnknown;
  std::int64_t edge_flags = 0;
  double edge_fraction = kUnknown;
  std::int64_t touches_edge = 0;
  double bottom_depth_m = kUnknown;
  std::int64_t provisional = 0;
  double backscatter_psi_error_db = kUnknown;
  double backscatter_calibration_se_db = kUnknown;
  double backscatter_total_m2 = kUnknown;
  double backscatter_total_se_m2 = kUnknown;
  std::int64_t survey_school = 0;  ///< number of the school in the survey, 1..; 0 = not merged yet
  // Refraction: known with a sound speed profile only.
  double depth_error_m = kUnknown;
};

/// SchoolRow::ended_at_reach: neither end, its first ping, its last, or both.
inline constexpr std::array<std::string_view, 4> kEndNames{"", "first", "last", "both"};
[[nodiscard]] constexpr bool ends_first(std::string_view ends) { return ends == kEndNames[1] || ends == kEndNames[3]; }
[[nodiscard]] constexpr bool ends_last(std::string_view ends) { return ends == kEndNames[2] || ends == kEndNames[3]; }

/// One school track: a row of schools.csv.
struct SchoolRow {
  std::string observation;
  std::int64_t school_id = 0;
  std::string continues;
  TimeNs first_time_utc = 0;
  TimeNs last_time_utc = 0;
  std::int64_t n_pings = 0;
  std::int64_t n_pings_whole = 0;
  double latitude = kUnknown;
  double longitude = kUnknown;
  double depth_m = kUnknown;
  double volume_m3 = kUnknown;
  double volume_corrected_m3 = kUnknown;
  double length_m = kUnknown;
  double width_m = kUnknown;
  double height_m = kUnknown;
  double sv_mean_db = kUnknown;
  double sv_corrected_db = kUnknown;
  double backscatter_m2 = kUnknown;
  double speed_mps = kUnknown;
  double speed_se_mps = kUnknown;
  double course_deg = kUnknown;
  double vertical_speed_mps = kUnknown;
  double touches_edge_fraction = kUnknown;
  std::string origin = "automatic";
  std::string status = "unreviewed";
  std::string operator_name;  ///< column `operator`
  TimeNs decided_utc = 0;     ///< 0 = not decided
  std::string species;
  std::string comment;
  std::string name;  ///< that a human gave it
  double backscatter_psi_error_db = kUnknown;
  double backscatter_calibration_se_db = kUnknown;
  double backscatter_total_m2 = kUnknown;
  double backscatter_total_se_m2 = kUnknown;
  /// kEndNames: ends of the track that a propagation by hand left only because it was asked no farther.
  std::string ended_at_reach;
  std::int64_t survey_school = 0;  ///< number of the school in the survey, 1..; 0 = not merged yet
  // Refraction: known with a sound speed profile only.
  double depth_error_m = kUnknown;
};

/// Time column: ISO 8601 in text, empty for 0.
struct TimeColumn {
  TimeNs& value;
};
/// Latitude or longitude column: eight decimals in text.
struct DegreesColumn {
  double& value;
};

/// Visits the columns of a row in their fixed order: v(name, unit, member) with member std::string&, std::int64_t&,
/// double&, TimeColumn or DegreesColumn. CSV, netCDF and map layers are visitors of this one list.
template <class Visitor>
void columns(Visitor& v, SchoolPingRow& r) {
  v("observation", "", r.observation);
  v("school_id", "1", r.school_id);
  v("ping_index", "1", r.ping_index);
  v("time_utc", "", TimeColumn{r.time_utc});
  v("latitude", "degrees_north", DegreesColumn{r.latitude});
  v("longitude", "degrees_east", DegreesColumn{r.longitude});
  v("depth_m", "m", r.depth_m);
  v("range_m", "m", r.range_m);
  v("bearing_deg", "degrees", r.bearing_deg);
  v("n_voxels", "1", r.n_voxels);
  v("n_beams", "1", r.n_beams);
  v("n_fans", "1", r.n_fans);
  v("volume_m3", "m3", r.volume_m3);
  v("length_m", "m", r.length_m);
  v("width_m", "m", r.width_m);
  v("height_m", "m", r.height_m);
  v("axis_deg", "degrees", r.axis_deg);
  v("depth_min_m", "m", r.depth_min_m);
  v("depth_max_m", "m", r.depth_max_m);
  v("sv_mean_db", "dB re 1 m-1", r.sv_mean_db);
  v("sv_p95_db", "dB re 1 m-1", r.sv_p95_db);
  v("sv_max_db", "dB re 1 m-1", r.sv_max_db);
  v("backscatter_m2", "m2", r.backscatter_m2);
  v("valid_fraction", "1", r.valid_fraction);
  v("volume_corrected_m3", "m3", r.volume_corrected_m3);
  v("length_corrected_m", "m", r.length_corrected_m);
  v("width_corrected_m", "m", r.width_corrected_m);
  v("height_corrected_m", "m", r.height_corrected_m);
  v("sv_corrected_db", "dB re 1 m-1", r.sv_corrected_db);
  v("snr_db", "dB", r.snr_db);
  v("threshold_db", "dB re 1 m-1", r.threshold_db);
  v("edge_flags", "1", r.edge_flags);
  v("edge_fraction", "1", r.edge_fraction);
  v("touches_edge", "1", r.touches_edge);
  v("bottom_depth_m", "m", r.bottom_depth_m);
  v("provisional", "1", r.provisional);
  v("backscatter_psi_error_db", "dB", r.backscatter_psi_error_db);
  v("backscatter_calibration_se_db", "dB", r.backscatter_calibration_se_db);
  v("backscatter_total_m2", "m2", r.backscatter_total_m2);
  v("backscatter_total_se_m2", "m2", r.backscatter_total_se_m2);
  v("survey_school", "1", r.survey_school);
  // Refraction.
  v("depth_error_m", "m", r.depth_error_m);
}

template <class Visitor>
void columns(Visitor& v, SchoolRow& r) {
  v("observation", "", r.observation);
  v("school_id", "1", r.school_id);
  v("continues", "", r.continues);
  v("first_time_utc", "", TimeColumn{r.first_time_utc});
  v("last_time_utc", "", TimeColumn{r.last_time_utc});
  v("n_pings", "1", r.n_pings);
  v("n_pings_whole", "1", r.n_pings_whole);
  v("latitude", "degrees_north", DegreesColumn{r.latitude});
  v("longitude", "degrees_east", DegreesColumn{r.longitude});
  v("depth_m", "m", r.depth_m);
  v("volume_m3", "m3", r.volume_m3);
  v("volume_corrected_m3", "m3", r.volume_corrected_m3);
  v("length_m", "m", r.length_m);
  v("width_m", "m", r.width_m);
  v("height_m", "m", r.height_m);
  v("sv_mean_db", "dB re 1 m-1", r.sv_mean_db);
  v("sv_corrected_db", "dB re 1 m-1", r.sv_corrected_db);
  v("backscatter_m2", "m2", r.backscatter_m2);
  v("speed_mps", "m s-1", r.speed_mps);
  v("speed_se_mps", "m s-1", r.speed_se_mps);
  v("course_deg", "degrees", r.course_deg);
  v("vertical_speed_mps", "m s-1", r.vertical_speed_mps);
  v("touches_edge_fraction", "1", r.touches_edge_fraction);
  v("origin", "", r.origin);
  v("status", "", r.status);
  v("operator", "", r.operator_name);
  v("decided_utc", "", TimeColumn{r.decided_utc});
  v("species", "", r.species);
  v("comment", "", r.comment);
  v("name", "", r.name);
  v("backscatter_psi_error_db", "dB", r.backscatter_psi_error_db);
  v("backscatter_calibration_se_db", "dB", r.backscatter_calibration_se_db);
  v("backscatter_total_m2", "m2", r.backscatter_total_m2);
  v("backscatter_total_se_m2", "m2", r.backscatter_total_se_m2);
  v("ended_at_reach", "", r.ended_at_reach);
  v("survey_school", "1", r.survey_school);
  // Refraction.
  v("depth_error_m", "m", r.depth_error_m);
}

/// Columns that came after the first published tables: a file without them is whole, and has none of it.
[[nodiscard]] constexpr bool is_later_column(std::string_view column) {
  return column == "name" || column == "backscatter_psi_error_db" || column == "backscatter_calibration_se_db" ||
         column == "backscatter_total_m2" || column == "backscatter_total_se_m2" || column == "ended_at_reach" ||
         column == "survey_school" || column == "depth_error_m";
}

}  // namespace sonar
