// SPDX-License-Identifier: Apache-2.0
#include "school/measure/summarise.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/check.h"
#include "base/units.h"
#include "geo/geodesic.h"
#include "school/measure/centre_track.h"
#include "school/measure/tortuosity.h"

namespace sonar {
namespace {

using Rows = std::vector<const SchoolPingRow*>;

double median_of(const Rows& rows, double SchoolPingRow::*column) {
  std::vector<double> values;
  for (const SchoolPingRow* row : rows) {
    if (std::isfinite(row->*column)) values.push_back(row->*column);
  }
  if (values.empty()) return kUnknown;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2.0;
}

double mean_of(const Rows& rows, double SchoolPingRow::*column) {
  double sum = 0.0;
  int n = 0;
  for (const SchoolPingRow* row : rows) {
    if (!std::isfinite(row->*column)) continue;
    sum += row->*column;
    ++n;
  }
  return n > 0 ? sum / n : kUnknown;
}

/// The pings' backscatter over what it would be under the other beam angle; unknown where any ping's is.
double psi_error_db(const Rows& rows) {
  double whole = 0.0;
  double other = 0.0;
  for (const SchoolPingRow* row : rows) {
    if (!std::isfinite(row->backscatter_m2)) continue;
    whole += row->backscatter_m2;
    other += row->backscatter_m2 * linear_from_db(-row->backscatter_psi_error_db);
  }
  return whole > 0.0 && other > 0.0 ? db_from_linear(whole / other) : kUnknown;
}

/// Mean of the pings' standard errors, weighted as backscatter is: the calibration is one, no mean makes it better.
double calibration_se_db(const Rows& rows) {
  double whole = 0.0;
  double error = 0.0;
  for (const SchoolPingRow* row : rows) {
    if (!std::isfinite(row->backscatter_m2)) continue;
    whole += row->backscatter_m2;
    error += row->backscatter_m2 * row->backscatter_calibration_se_db;
  }
  return whole > 0.0 && error >= 0.0 ? error / whole : kUnknown;
}

/// Mean of dB values in linear units.
double linear_mean_db(const Rows& rows, double SchoolPingRow::*column) {
  double sum = 0.0;
  int n = 0;
  for (const SchoolPingRow* row : rows) {
    if (!std::isfinite(row->*column)) continue;
    sum += linear_from_db(row->*column);
    ++n;
  }
  return n > 0 ? db_from_linear(sum / n) : kUnknown;
}

/// Through the water, over the whole track.
void summarise_water(const CentreTrack& track, std::span<const SchoolPingRow> rows, const LineFit& line,
                     const WaterCurrents& water, SchoolRow& out) {
  const auto drifted = drifted_water(track, rows, water);
  if (!drifted) return;
  const CurrentAlong current = drifted->along(0, track.size());
  const Speed speed = speed_through_water(line, current);
  out.speed_water_mps = speed.speed_mps;
  out.speed_water_se_mps = speed.speed_se_mps;
  out.course_water_deg = speed.course_deg;
  out.course_water_se_deg = speed.course_se_deg;
  out.current_east_mps = current.east_mps;
  out.current_north_mps = current.north_mps;
  out.current_se_mps = current.error_mps;
}

void summarise_motion(std::span<const SchoolPingRow> rows, const SummariseParams& params, const WaterCurrents* water,
                      SchoolRow& out) {
  const CentreTrack track = uncut_track(rows);
  if (!track.tells_speed(params.min_speed_pings, params.min_speed_span_s)) return;
  const LineFit line = fit_line(track.places.t, track.places.x, track.places.y);
  const Speed speed = speed_of(line);
  out.speed_mps = speed.speed_mps;
  out.speed_se_mps = speed.speed_se_mps;
  out.course_deg = speed.course_deg;
  out.course_se_deg = speed.course_se_deg;
  const LineFit down = fit_line(track.places.t, track.depth_m, track.depth_m);
  out.vertical_speed_mps = down.slope_x;  // positive down, as depth
  out.vertical_speed_se_mps = std::sqrt(std::max(down.variance_xx, 0.0));
  const Tortuosity winding = tortuosity(track, params.movement_window_s);
  out.tortuosity = winding.ratio;
  out.tortuosity_se = winding.se;
  if (water != nullptr) summarise_water(track, rows, line, *water, out);
}

/// Levels as linear means, sizes and all else as medians, as the other columns are.
void summarise_descriptors(const Rows& used, SchoolRow& out) {
  for (const DescriptorColumn& one : kDescriptorColumns) {
    const bool is_level = one.name.starts_with("sv_") && one.name.ends_with("_db");
    out.*one.value = is_level ? linear_mean_db(used, one.value) : median_of(used, one.value);
  }
  out.nasc_m2_nmi2 = mean_of(used, &SchoolPingRow::nasc_m2_nmi2);
}

/// Mean place of the rows; longitudes are averaged as distances, so that the date line does no harm.
void summarise_place(const Rows& rows, SchoolRow& out) {
  Geographic origin;
  Point<Enu> sum;
  int n = 0;
  for (const SchoolPingRow* row : rows) {
    if (!std::isfinite(row->latitude) || !std::isfinite(row->longitude)) continue;
    if (n == 0) origin = {row->latitude, row->longitude};
    sum = sum + to_enu(Geographic{row->latitude, row->longitude}, origin);
    ++n;
  }
  if (n == 0) return;
  const Geographic where = to_geographic(sum * (1.0 / n), origin);
  out.latitude = where.latitude_deg;
  out.longitude = where.longitude_deg;
}

/// Mean of the pings' total backscatter; fading differs from ping to ping, so that their errors do not add up.
void summarise_total(const Rows& used, SchoolRow& out) {
  double sum = 0.0;
  double variance = 0.0;
  int n = 0;
  for (const SchoolPingRow* row : used) {
    if (!std::isfinite(row->backscatter_total_m2)) continue;
    sum += row->backscatter_total_m2;
    variance += row->backscatter_total_se_m2 * row->backscatter_total_se_m2;
    ++n;
  }
  if (n == 0) return;
  out.backscatter_total_m2 = sum / n;
  out.backscatter_total_se_m2 = std::sqrt(variance) / n;
}

/// Backscatter, corrected volume and their ratio over the pings that know both, where there are any.
void summarise_echo(const Rows& used, SchoolRow& out) {
  Rows both;
  for (const SchoolPingRow* row : used) {
    if (std::isfinite(row->volume_corrected_m3) && std::isfinite(row->backscatter_m2)) both.push_back(row);
  }
  const Rows& rows = both.empty() ? used : both;
  out.backscatter_m2 = mean_of(rows, &SchoolPingRow::backscatter_m2);
  out.backscatter_psi_error_db = psi_error_db(rows);
  out.backscatter_calibration_se_db = calibration_se_db(rows);
  if (both.empty()) return;
  out.volume_corrected_m3 = mean_of(both, &SchoolPingRow::volume_corrected_m3);
  const double sv = out.backscatter_m2 / out.volume_corrected_m3;
  if (sv > 0.0) out.sv_corrected_db = db_from_linear(sv);
}

}  // namespace

SchoolRow summarise(std::span<const SchoolPingRow> rows, const SummariseParams& params, const WaterCurrents* water) {
  SONAR_CHECK(!rows.empty());
  Rows all;
  Rows whole;
  for (const SchoolPingRow& row : rows) {
    all.push_back(&row);
    if (row.touches_edge == 0) whole.push_back(&row);
  }
  SchoolRow out;
  out.observation = rows.front().observation;
  out.school_id = rows.front().school_id;
  out.first_time_utc = rows.front().time_utc;
  out.last_time_utc = rows.back().time_utc;
  out.n_pings = static_cast<std::int64_t>(all.size());
  out.n_pings_whole = static_cast<std::int64_t>(whole.size());
  out.touches_edge_fraction = 1.0 - static_cast<double>(whole.size()) / static_cast<double>(all.size());
  const Rows& used = whole.empty() ? all : whole;
  summarise_place(used, out);
  out.depth_m = mean_of(used, &SchoolPingRow::depth_m);
  out.depth_error_m = mean_of(used, &SchoolPingRow::depth_error_m);
  out.extinction_loss_db = mean_of(used, &SchoolPingRow::extinction_loss_db);
  out.extinction_share = mean_of(used, &SchoolPingRow::extinction_share);
  out.extinction_share_low = mean_of(used, &SchoolPingRow::extinction_share_low);
  out.extinction_share_high = mean_of(used, &SchoolPingRow::extinction_share_high);
  out.extinction_corrected = mean_of(used, &SchoolPingRow::extinction_corrected);
  out.volume_m3 = median_of(used, &SchoolPingRow::volume_m3);
  out.length_m = median_of(used, &SchoolPingRow::length_m);
  out.width_m = median_of(used, &SchoolPingRow::width_m);
  out.height_m = median_of(used, &SchoolPingRow::height_m);
  out.sv_mean_db = linear_mean_db(used, &SchoolPingRow::sv_mean_db);
  summarise_echo(used, out);
  summarise_total(used, out);
  summarise_descriptors(used, out);
  summarise_motion(rows, params, water, out);
  return out;
}

}  // namespace sonar
