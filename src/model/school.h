// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/time.h"
#include "model/school_descriptors.h"
#include "model/school_errors.h"

namespace sonar {

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
struct SchoolPingRow : SchoolDescriptors {
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
  // beside the descriptors
  double box_bearing_deg = kUnknown;
  double box_tilt_deg = kUnknown;
  double mass_latitude = kUnknown;
  double mass_longitude = kUnknown;
  double mass_depth_m = kUnknown;
  // Movement, of a line through the centres of a window about the ping, and against the ship (school/measure/movement.h).
  double speed_smoothed_mps = kUnknown;
  double speed_smoothed_se_mps = kUnknown;
  double course_smoothed_deg = kUnknown;
  double vertical_speed_smoothed_mps = kUnknown;
  double speed_water_smoothed_mps = kUnknown;
  double course_water_smoothed_deg = kUnknown;
  double relative_bearing_deg = kUnknown;
  double ship_speed_mps = kUnknown;
  double course_away_deg = kUnknown;
  double speed_away_mps = kUnknown;
  double speed_away_se_mps = kUnknown;
  double speed_away_water_mps = kUnknown;
  double time_to_cpa_s = kUnknown;
  double cpa_m = kUnknown;
  double wake_distance_m = kUnknown;
  // Refraction: known with a sound speed profile only.
  double depth_error_m = kUnknown;
  // Extinction (school/measure/extinction.h).
  double extinction_loss_db = kUnknown;
  double extinction_share = kUnknown;
  double extinction_share_low = kUnknown;
  double extinction_share_high = kUnknown;
  double extinction_corrected = kUnknown;
  // Standard errors of movement at the ping (school/measure/movement.h).
  double course_smoothed_se_deg = kUnknown;
  double vertical_speed_smoothed_se_mps = kUnknown;
  double speed_water_smoothed_se_mps = kUnknown;
  double course_water_smoothed_se_deg = kUnknown;
  double course_away_se_deg = kUnknown;
  double speed_away_water_se_mps = kUnknown;
  double time_to_cpa_se_s = kUnknown;
  double cpa_se_m = kUnknown;
};

/// SchoolRow::ended_at_reach: neither end, its first ping, its last, or both.
inline constexpr std::array<std::string_view, 4> kEndNames{"", "first", "last", "both"};
[[nodiscard]] constexpr bool ends_first(std::string_view ends) { return ends == kEndNames[1] || ends == kEndNames[3]; }
[[nodiscard]] constexpr bool ends_last(std::string_view ends) { return ends == kEndNames[2] || ends == kEndNames[3]; }

/// One school track: a row of schools.csv.
struct SchoolRow : SchoolDescriptors {
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
  // Movement beside speed and course over ground (school/measure/summarise.h).
  double course_se_deg = kUnknown;
  double vertical_speed_se_mps = kUnknown;
  double tortuosity = kUnknown;
  double tortuosity_se = kUnknown;
  double speed_water_mps = kUnknown;
  double speed_water_se_mps = kUnknown;
  double course_water_deg = kUnknown;
  double course_water_se_deg = kUnknown;
  double current_east_mps = kUnknown;
  double current_north_mps = kUnknown;
  double current_se_mps = kUnknown;
  // Refraction: known with a sound speed profile only.
  double depth_error_m = kUnknown;
  // Extinction (school/measure/extinction.h).
  double extinction_loss_db = kUnknown;
  double extinction_share = kUnknown;
  double extinction_share_low = kUnknown;
  double extinction_share_high = kUnknown;
  double extinction_corrected = kUnknown;
  /// Standard errors, in the order of kErrorColumns.
  FigureValues se = unknown_figures();
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
  // form, echo, place and resolution
  for (const DescriptorColumn& d : kDescriptorColumns) v(d.name, d.unit, r.*d.value);
  v("box_bearing_deg", "degrees", r.box_bearing_deg);
  v("box_tilt_deg", "degrees", r.box_tilt_deg);
  v("mass_latitude", "degrees_north", DegreesColumn{r.mass_latitude});
  v("mass_longitude", "degrees_east", DegreesColumn{r.mass_longitude});
  v("mass_depth_m", "m", r.mass_depth_m);
  v("speed_smoothed_mps", "m s-1", r.speed_smoothed_mps);
  v("speed_smoothed_se_mps", "m s-1", r.speed_smoothed_se_mps);
  v("course_smoothed_deg", "degrees", r.course_smoothed_deg);
  v("vertical_speed_smoothed_mps", "m s-1", r.vertical_speed_smoothed_mps);
  v("speed_water_smoothed_mps", "m s-1", r.speed_water_smoothed_mps);
  v("course_water_smoothed_deg", "degrees", r.course_water_smoothed_deg);
  v("relative_bearing_deg", "degrees", r.relative_bearing_deg);
  v("ship_speed_mps", "m s-1", r.ship_speed_mps);
  v("course_away_deg", "degrees", r.course_away_deg);
  v("speed_away_mps", "m s-1", r.speed_away_mps);
  v("speed_away_se_mps", "m s-1", r.speed_away_se_mps);
  v("speed_away_water_mps", "m s-1", r.speed_away_water_mps);
  v("time_to_cpa_s", "s", r.time_to_cpa_s);
  v("cpa_m", "m", r.cpa_m);
  v("wake_distance_m", "m", r.wake_distance_m);
  // Refraction.
  v("depth_error_m", "m", r.depth_error_m);
  // Extinction.
  v("extinction_loss_db", "dB", r.extinction_loss_db);
  v("extinction_share", "1", r.extinction_share);
  v("extinction_share_low", "1", r.extinction_share_low);
  v("extinction_share_high", "1", r.extinction_share_high);
  v("extinction_corrected", "1", r.extinction_corrected);
  // Standard errors of movement at the ping.
  v("course_smoothed_se_deg", "degrees", r.course_smoothed_se_deg);
  v("vertical_speed_smoothed_se_mps", "m s-1", r.vertical_speed_smoothed_se_mps);
  v("speed_water_smoothed_se_mps", "m s-1", r.speed_water_smoothed_se_mps);
  v("course_water_smoothed_se_deg", "degrees", r.course_water_smoothed_se_deg);
  v("course_away_se_deg", "degrees", r.course_away_se_deg);
  v("speed_away_water_se_mps", "m s-1", r.speed_away_water_se_mps);
  v("time_to_cpa_se_s", "s", r.time_to_cpa_se_s);
  v("cpa_se_m", "m", r.cpa_se_m);
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
  // form, echo, place and resolution
  for (const DescriptorColumn& d : kDescriptorColumns) v(d.name, d.unit, r.*d.value);
  v("course_se_deg", "degrees", r.course_se_deg);
  v("vertical_speed_se_mps", "m s-1", r.vertical_speed_se_mps);
  v("tortuosity", "1", r.tortuosity);
  v("tortuosity_se", "1", r.tortuosity_se);
  v("speed_water_mps", "m s-1", r.speed_water_mps);
  v("speed_water_se_mps", "m s-1", r.speed_water_se_mps);
  v("course_water_deg", "degrees", r.course_water_deg);
  v("course_water_se_deg", "degrees", r.course_water_se_deg);
  v("current_east_mps", "m s-1", r.current_east_mps);
  v("current_north_mps", "m s-1", r.current_north_mps);
  v("current_se_mps", "m s-1", r.current_se_mps);
  // Refraction.
  v("depth_error_m", "m", r.depth_error_m);
  // Extinction.
  v("extinction_loss_db", "dB", r.extinction_loss_db);
  v("extinction_share", "1", r.extinction_share);
  v("extinction_share_low", "1", r.extinction_share_low);
  v("extinction_share_high", "1", r.extinction_share_high);
  v("extinction_corrected", "1", r.extinction_corrected);
  // Standard errors of the figures above.
  for (std::size_t i = 0; i < kErrorCount; ++i) v(kErrorColumns[i].name, kErrorColumns[i].unit, r.se[i]);
}

}  // namespace sonar
