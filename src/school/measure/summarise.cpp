// SPDX-License-Identifier: Apache-2.0
#include "school/measure/summarise.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/check.h"
#include "base/units.h"
#include "geo/geodesic.h"
#include "school/measure/centre_track.h"
#include "school/measure/line_fit.h"

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

/// Speed and its standard error out of the slopes' noise. The length of a noisy vector is longer than the vector: by half
/// the variance across it over the length, so that the square less that variance is free of it but where the speed is lost
/// in its error. There the length is 0.
/// source  Wardle & Kronberg 1974, ApJ 194, 249, for the length of a polarisation vector
void take_speed(const LineFit& line, SchoolRow& out) {
  const double length = std::hypot(line.slope_x, line.slope_y);
  const double x = length > 0.0 ? line.slope_x / length : std::sqrt(0.5);
  const double y = length > 0.0 ? line.slope_y / length : std::sqrt(0.5);
  const double cross = 2.0 * x * y * line.variance_xy;
  const double along = x * x * line.variance_xx + cross + y * y * line.variance_yy;
  const double across = y * y * line.variance_xx - cross + x * x * line.variance_yy;
  out.speed_mps = std::sqrt(std::max(length * length - across, 0.0));
  out.speed_se_mps = std::sqrt(std::max(along, 0.0));
  if (out.speed_mps > 0.0 && out.speed_mps >= 2.0 * out.speed_se_mps) {
    out.course_deg = wrap_360(deg_from_rad(std::atan2(line.slope_x, line.slope_y)));
  }
}

void summarise_motion(std::span<const SchoolPingRow> rows, const SummariseParams& params, SchoolRow& out) {
  const CentreTrack track = centre_track(rows);
  if (!track.tells_speed(params.min_speed_pings, params.min_speed_span_s)) return;
  take_speed(fit_line(track.t, track.east, track.north), out);
  out.vertical_speed_mps = fit_line(track.t, track.down, track.down).slope_x;  // positive down, as depth
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

SchoolRow summarise(std::span<const SchoolPingRow> rows, const SummariseParams& params) {
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
  out.volume_m3 = median_of(used, &SchoolPingRow::volume_m3);
  out.length_m = median_of(used, &SchoolPingRow::length_m);
  out.width_m = median_of(used, &SchoolPingRow::width_m);
  out.height_m = median_of(used, &SchoolPingRow::height_m);
  out.sv_mean_db = linear_mean_db(used, &SchoolPingRow::sv_mean_db);
  summarise_echo(used, out);
  summarise_total(used, out);
  summarise_motion(rows, params, out);
  return out;
}

}  // namespace sonar
