// SPDX-License-Identifier: Apache-2.0
#include "school/summarise.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/check.h"
#include "base/units.h"
#include "geo/geodesic.h"

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

/// Slope of a least-squares line and its standard error.
struct Slope {
  double value = kUnknown;
  double error = kUnknown;
};

Slope slope(const std::vector<double>& t, const std::vector<double>& x) {
  const auto n = static_cast<double>(t.size());
  double mean_t = 0.0;
  double mean_x = 0.0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    mean_t += t[i] / n;
    mean_x += x[i] / n;
  }
  double tt = 0.0;
  double tx = 0.0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    tt += (t[i] - mean_t) * (t[i] - mean_t);
    tx += (t[i] - mean_t) * (x[i] - mean_x);
  }
  if (!(tt > 0.0)) return {};
  Slope line{tx / tt, kUnknown};
  double rest = 0.0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double off = x[i] - mean_x - line.value * (t[i] - mean_t);
    rest += off * off;
  }
  line.error = std::sqrt(rest / (n - 2.0) / tt);
  return line;
}

void summarise_motion(std::span<const SchoolPingRow> rows, const SummariseParams& params, SchoolRow& out) {
  std::vector<double> t;
  std::vector<double> east;
  std::vector<double> north;
  std::vector<double> down;
  Geographic origin;
  TimeNs start = 0;
  for (const SchoolPingRow& row : rows) {
    if ((row.edge_flags & kCutsCentre) != 0) continue;
    if (!std::isfinite(row.latitude) || !std::isfinite(row.longitude) || !std::isfinite(row.depth_m)) continue;
    if (t.empty()) {
      origin = {row.latitude, row.longitude};
      start = row.time_utc;
    }
    const Point<Enu> place = to_enu(Geographic{row.latitude, row.longitude}, origin);
    t.push_back(static_cast<double>(row.time_utc - start) / static_cast<double>(kSecondNs));
    east.push_back(place.x);
    north.push_back(place.y);
    down.push_back(row.depth_m);
  }
  if (t.size() < static_cast<std::size_t>(std::max(params.min_speed_pings, 3))) return;
  if (t.back() - t.front() < params.min_speed_span_s) return;
  const Slope e = slope(t, east);
  const Slope n = slope(t, north);
  out.speed_mps = std::hypot(e.value, n.value);
  // error along the direction of movement; of both axes alike where there is none
  const double share_e = out.speed_mps > 0.0 ? e.value / out.speed_mps : std::sqrt(0.5);
  const double share_n = out.speed_mps > 0.0 ? n.value / out.speed_mps : std::sqrt(0.5);
  out.speed_se_mps = std::hypot(share_e * e.error, share_n * n.error);
  if (out.speed_mps > 0.0 && out.speed_mps >= 2.0 * out.speed_se_mps) {
    out.course_deg = wrap_360(deg_from_rad(std::atan2(e.value, n.value)));
  }
  out.vertical_speed_mps = slope(t, down).value;  // positive down, as depth
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
  out.volume_m3 = median_of(used, &SchoolPingRow::volume_m3);
  out.volume_corrected_m3 = median_of(used, &SchoolPingRow::volume_corrected_m3);
  out.length_m = median_of(used, &SchoolPingRow::length_m);
  out.width_m = median_of(used, &SchoolPingRow::width_m);
  out.height_m = median_of(used, &SchoolPingRow::height_m);
  out.sv_mean_db = linear_mean_db(used, &SchoolPingRow::sv_mean_db);
  out.sv_corrected_db = linear_mean_db(used, &SchoolPingRow::sv_corrected_db);
  out.backscatter_m2 = mean_of(used, &SchoolPingRow::backscatter_m2);
  summarise_motion(rows, params, out);
  return out;
}

}  // namespace sonar
