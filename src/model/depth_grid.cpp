// SPDX-License-Identifier: Apache-2.0
#include "model/depth_grid.h"

#include <cmath>
#include <limits>

namespace sonar {

double DepthGrid::depth_at(const Geographic& place) const {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  constexpr double kEdge = 0.5;  // half a step beyond the outermost nodes still belongs to them
  if (rows < 1 || columns < 1 || !(step_latitude_deg > 0.0) || !(step_longitude_deg > 0.0)) return kNone;
  const double y = (place.latitude_deg - south_deg) / step_latitude_deg;
  double x = wrap_360(place.longitude_deg - west_deg) / step_longitude_deg;
  const double turn = 360.0 / step_longitude_deg;
  if (x > columns - 1 + kEdge && x - turn >= -kEdge) x -= turn;
  if (!(y >= -kEdge && y <= rows - 1 + kEdge && x >= -kEdge && x <= columns - 1 + kEdge)) return kNone;
  const auto cell = [](double v, int count) {
    const int low = static_cast<int>(std::floor(v));
    return low < 0 ? 0 : (low > count - 2 ? (count > 1 ? count - 2 : 0) : low);
  };
  const int row = cell(y, rows);
  const int column = cell(x, columns);
  const double fy = std::fmin(1.0, std::fmax(0.0, y - row));
  const double fx = std::fmin(1.0, std::fmax(0.0, x - column));
  double sum = 0.0;
  double nearest = kNone;
  double largest = 0.0;
  bool whole = true;
  for (int dy = 0; dy < (rows > 1 ? 2 : 1); ++dy) {
    for (int dx = 0; dx < (columns > 1 ? 2 : 1); ++dx) {
      const double wy = rows > 1 ? (dy == 1 ? fy : 1.0 - fy) : 1.0;
      const double wx = columns > 1 ? (dx == 1 ? fx : 1.0 - fx) : 1.0;
      const double weight = wy * wx;
      const double value = static_cast<double>(at(row + dy, column + dx));
      if (weight <= 0.0) continue;
      if (std::isnan(value)) {
        whole = false;
        continue;
      }
      sum += weight * value;
      if (weight > largest) {
        largest = weight;
        nearest = value;
      }
    }
  }
  return whole ? sum : nearest;
}

}  // namespace sonar
