// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "geo/frames.h"

namespace sonar {

/// Depth of the seabed on a regular grid of WGS 84 latitudes and longitudes; nodes, not cells.
struct DepthGrid {
  double south_deg = 0.0;  ///< of row 0
  double west_deg = 0.0;   ///< of column 0, in [-180, 180)
  double step_latitude_deg = 0.0;
  double step_longitude_deg = 0.0;
  int rows = 0;
  int columns = 0;             ///< eastwards, on over 180 degrees
  std::vector<float> depth_m;  ///< [row][column], positive down; land is negative; NaN = unknown
  std::string source;          ///< file and layout, for the legend: "gebco.nc, elevation (negative down)"

  [[nodiscard]] float at(int row, int column) const {
    return depth_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                   static_cast<std::size_t>(column)];
  }

  /// Bilinear; beside unknown nodes the nearest known one within a step; NaN outside the grid.
  [[nodiscard]] double depth_at(const Geographic& place) const;
};

}  // namespace sonar
