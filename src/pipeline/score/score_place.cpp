// SPDX-License-Identifier: Apache-2.0
#include "pipeline/score/score_place.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/units.h"

namespace sonar {

double median_known(std::vector<double> values) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  if (values.empty()) return kUnknown;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

double mean_elevation_deg(const PingMask& mask, const BeamGrid& grid, const std::vector<int>& row_of_channel) {
  double sum = 0.0;
  double voxels = 0.0;
  for (const Run& run : mask.runs) {
    const int row = row_of_channel[static_cast<std::size_t>(run.row)];
    sum += run.count * grid.elevation_deg[static_cast<std::size_t>(row / grid.beams())];
    voxels += run.count;
  }
  return voxels > 0.0 ? sum / voxels : kUnknown;
}

ScoreSpan span_of(const ScoreSide& truth) {
  ScoreSpan span;
  for (const ObservationProduct& product : truth.observations) {
    if (!product.grid || product.grid->grid.fans() == 0) continue;
    const RangeAxis& range = product.grid->range;
    const Sector sector = product.grid->grid.sector(range);
    span.range_from_m = std::fmin(span.range_from_m, std::max(0.0, range.first_m));
    span.range_to_m = std::fmax(span.range_to_m, range.range_m(range.count));
    span.elevation_from_deg = std::fmin(span.elevation_from_deg, deg_from_rad(sector.elevation_bounds(0).lower));
    span.elevation_to_deg =
        std::fmax(span.elevation_to_deg, deg_from_rad(sector.elevation_bounds(sector.fans() - 1).upper));
  }
  return span;
}

int third_of(double value, double from, double to) {
  const double share = (value - from) / (to - from);
  if (!std::isfinite(share) || !(to > from)) return -1;
  return static_cast<int>(std::clamp(std::floor(3.0 * share), 0.0, 2.0));
}

}  // namespace sonar
