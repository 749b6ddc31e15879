// SPDX-License-Identifier: Apache-2.0
#include "school/measure/centre_track.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "geo/geodesic.h"

namespace sonar {

bool CentreTrack::tells_speed(int min_pings, double min_span_s) const {
  if (t.size() < static_cast<std::size_t>(std::max(min_pings, 3))) return false;
  const double span_s = t.back() - t.front();
  return span_s >= min_span_s && span_s > 0.0;
}

CentreTrack centre_track(std::span<const SchoolPingRow> rows) {
  CentreTrack track;
  TimeNs start = 0;
  for (const SchoolPingRow& row : rows) {
    if ((row.edge_flags & kCutsCentre) != 0) continue;
    if (!std::isfinite(row.latitude) || !std::isfinite(row.longitude) || !std::isfinite(row.depth_m)) continue;
    if (track.t.empty()) {
      track.origin = {row.latitude, row.longitude};
      start = row.time_utc;
    }
    const Point<Enu> place = to_enu(Geographic{row.latitude, row.longitude}, track.origin);
    track.t.push_back(static_cast<double>(row.time_utc - start) / static_cast<double>(kSecondNs));
    track.east.push_back(place.x);
    track.north.push_back(place.y);
    track.down.push_back(row.depth_m);
    track.ping_index.push_back(row.ping_index);
  }
  return track;
}

}  // namespace sonar
