// SPDX-License-Identifier: Apache-2.0
#include "school/measure/centre_track.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "geo/geodesic.h"

namespace sonar {
namespace {

std::vector<double> part_of(const std::vector<double>& values, std::size_t first, std::size_t last) {
  return {values.begin() + static_cast<std::ptrdiff_t>(first), values.begin() + static_cast<std::ptrdiff_t>(last)};
}

}  // namespace

TimedPlaces CentreTrack::part(std::size_t first, std::size_t last) const {
  return {part_of(places.t, first, last), part_of(places.x, first, last), part_of(places.y, first, last)};
}

bool CentreTrack::tells_speed(int min_pings, double min_span_s) const {
  if (size() < static_cast<std::size_t>(std::max(min_pings, 3))) return false;
  return span_s() >= min_span_s && span_s() > 0.0;
}

bool CentreTrack::tells_line(std::size_t first, std::size_t last) const {
  return last >= first + 3 && places.t[last - 1] > places.t[first];
}

CentreTrack uncut_track(std::span<const SchoolPingRow> rows) {
  CentreTrack track;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const SchoolPingRow& row = rows[i];
    if ((row.edge_flags & kCutsCentre) != 0) continue;
    if (!std::isfinite(row.latitude) || !std::isfinite(row.longitude) || !std::isfinite(row.depth_m)) continue;
    if (track.rows.empty()) {
      track.origin = {row.latitude, row.longitude};
      track.start = row.time_utc;
    }
    const Point<Enu> place = to_enu(Geographic{row.latitude, row.longitude}, track.origin);
    track.places.t.push_back(static_cast<double>(row.time_utc - track.start) / static_cast<double>(kSecondNs));
    track.places.x.push_back(place.x);
    track.places.y.push_back(place.y);
    track.depth_m.push_back(row.depth_m);
    track.rows.push_back(i);
  }
  return track;
}

std::vector<std::pair<std::size_t, std::size_t>> stretches(const CentreTrack& track, double window_s) {
  const double span_s = track.span_s();
  const double count = std::max(std::floor(span_s / window_s), 1.0);
  std::vector<std::pair<std::size_t, std::size_t>> out;
  const std::vector<double>& t = track.places.t;
  std::size_t first = 0;
  for (double k = 1.0; k <= count; ++k) {
    std::size_t last = t.size();
    if (k < count) {
      const auto end = std::lower_bound(t.begin(), t.end(), t.front() + span_s * k / count);
      last = static_cast<std::size_t>(end - t.begin());
    }
    out.emplace_back(first, last);
    first = last;
  }
  return out;
}

Speed speed_of(const LineFit& line) {
  const double length = std::hypot(line.slope_x, line.slope_y);
  const double x = length > 0.0 ? line.slope_x / length : std::sqrt(0.5);
  const double y = length > 0.0 ? line.slope_y / length : std::sqrt(0.5);
  const double cross = 2.0 * x * y * line.variance_xy;
  const double along = x * x * line.variance_xx + cross + y * y * line.variance_yy;
  const double across = y * y * line.variance_xx - cross + x * x * line.variance_yy;
  Speed out;
  out.speed_mps = std::sqrt(std::max(length * length - across, 0.0));
  out.speed_se_mps = std::sqrt(std::max(along, 0.0));
  if (out.speed_mps > 0.0 && out.speed_mps >= 2.0 * out.speed_se_mps) {
    out.course_deg = wrap_360(deg_from_rad(std::atan2(line.slope_x, line.slope_y)));
    out.course_se_deg = deg_from_rad(std::sqrt(std::max(across, 0.0)) / out.speed_mps);
  }
  return out;
}

}  // namespace sonar
