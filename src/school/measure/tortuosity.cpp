// SPDX-License-Identifier: Apache-2.0
#include "school/measure/tortuosity.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sonar {

Tortuosity tortuosity(const CentreTrack& track, double window_s) {
  std::vector<TimedPlaces> pieces;
  for (const auto& [first, last] : stretches(track, window_s)) {
    if (!track.tells_line(first, last)) return {};
    pieces.push_back(track.part(first, last));
  }
  if (pieces.size() < 2) return {};
  const Scatter scatter = common_scatter(pieces);
  // Stretches last equally long: lengths are in units of that time, and so is their mean.
  std::vector<LineFit> lines;
  LineFit whole;
  double path = 0.0;
  for (const TimedPlaces& piece : pieces) {
    const LineFit line = fit_line(piece, scatter);
    whole.slope_x += line.slope_x;
    whole.slope_y += line.slope_y;
    whole.variance_xx += line.variance_xx;
    whole.variance_xy += line.variance_xy;
    whole.variance_yy += line.variance_yy;
    path += speed_of(line).speed_mps;
    lines.push_back(line);
  }
  const Speed distance = speed_of(whole);
  if (!(distance.speed_mps > 0.0) || distance.speed_mps < 2.0 * distance.speed_se_mps) return {};
  Tortuosity out;
  out.ratio = std::max(path / distance.speed_mps, 1.0);
  const double length = std::hypot(whole.slope_x, whole.slope_y);
  double variance = 0.0;
  for (const LineFit& line : lines) {
    const double own = std::hypot(line.slope_x, line.slope_y);
    const double x = (own > 0.0 ? line.slope_x / own : 0.0) - out.ratio * whole.slope_x / length;
    const double y = (own > 0.0 ? line.slope_y / own : 0.0) - out.ratio * whole.slope_y / length;
    variance += x * x * line.variance_xx + 2.0 * x * y * line.variance_xy + y * y * line.variance_yy;
  }
  out.se = std::sqrt(std::max(variance, 0.0)) / distance.speed_mps;
  return out;
}

}  // namespace sonar
