// SPDX-License-Identifier: Apache-2.0
#include "school/seabed/seabed_hits.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "model/school.h"

namespace sonar {

std::vector<SeabedHit> seabed_hits(const Seabed& seabed, const SeabedWater& water) {
  std::vector<SeabedHit> hits;
  if (!seabed.found) return hits;
  for (const SeabedEcho& echo : seabed_echoes(water, long_echoes(water))) {
    if (echo.cut) continue;
    const Point<Sonar>& p = echo.place;
    const double below_m = p.z - (seabed.offset_m + seabed.slope_x * p.x + seabed.slope_y * p.y);
    if (std::abs(below_m) > std::max(water.params.inlier_m, water.params.inlier_share * echo.range_m)) continue;
    const SeabedHit hit{echo.row, echo.range_m, p, below_m};
    if (hits.empty() || hits.back().row != echo.row) {
      hits.push_back(hit);
    } else if (std::abs(below_m) < std::abs(hits.back().below_m)) {
      hits.back() = hit;
    }
  }
  return hits;
}

double depth_se_m(const std::vector<SeabedHit>& hits, const SeabedParams& params) {
  if (hits.empty() || std::ssize(hits) < params.min_inliers) return kUnknown;
  constexpr double kOneSigma = 0.6827;
  std::vector<double> off_m;
  for (const SeabedHit& hit : hits) off_m.push_back(std::abs(hit.below_m));
  const auto rank = off_m.begin() + static_cast<std::ptrdiff_t>(kOneSigma * static_cast<double>(off_m.size() - 1));
  std::nth_element(off_m.begin(), rank, off_m.end());
  return *rank;
}

}  // namespace sonar
