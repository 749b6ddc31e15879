// SPDX-License-Identifier: Apache-2.0
#include "pipeline/join_tracks.h"

#include <cmath>

#include "geo/geodesic.h"

namespace sonar {
namespace {

double known(double value, double otherwise) { return std::isfinite(value) ? value : otherwise; }

}  // namespace

const SchoolPingRow* end_row(const ObservationProduct& product, std::int64_t school_id, bool last) {
  const SchoolPingRow* found = nullptr;
  for (const SchoolPingRow& row : product.school_pings) {
    if (row.school_id != school_id) continue;
    found = &row;
    if (!last) break;
  }
  return found;
}

double miss(const SchoolRow& school, const SchoolPingRow& end, const SchoolRow& next, const SchoolPingRow& begin,
            const MergeParams& params) {
  const Geographic from{end.latitude, end.longitude};
  const Geographic to{begin.latitude, begin.longitude};
  if (!std::isfinite(from.latitude_deg) || !std::isfinite(to.latitude_deg)) return -1.0;
  const double seconds = static_cast<double>(begin.time_utc - end.time_utc) / 1e9;
  const bool moves = std::isfinite(school.speed_mps) && std::isfinite(school.course_deg);
  const Geographic predicted = moves ? destination(from, school.speed_mps * seconds, school.course_deg) : from;
  const double gate_m = params.gate_m + params.length_share * (known(school.length_m, 0.0) + known(next.length_m, 0.0));
  const double depth_m = std::abs(known(end.depth_m, 0.0) - known(begin.depth_m, 0.0));
  const double distance_m = geodesic(predicted, to).distance_m;
  return distance_m <= gate_m && depth_m <= params.depth_gate_m ? distance_m : -1.0;
}

}  // namespace sonar
