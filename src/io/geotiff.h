// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"

namespace sonar {

/// What a written raster holds where a band knows nothing.
inline constexpr float kNoDataWritten = -32767.0F;

struct RasterBand {
  std::string name;
  std::string unit;
  /// A row from the north, which holds NaN = unknown in every column before. Asked row by row: a raster need not be in memory.
  std::function<void(int row, std::span<float> line)> fill;
};

/// A raster with its north up, to be written.
struct GeoTiff {
  int epsg = 4326;
  double west = 0.0;   ///< outer edge of the first column, in the system's units
  double north = 0.0;  ///< outer edge of the first row
  double step_x = 0.0;
  double step_y = 0.0;
  int columns = 0;
  int rows = 0;
  std::vector<RasterBand> bands;
  std::string description;  ///< the file's own words of where it is from; empty = none
};

/// Writes 32-bit floats, deflated, NoData kNoDataWritten; whole or not at all. Equal rasters give equal bytes.
/// errors  io, no_space
[[nodiscard]] Result<void> write_geotiff(const std::filesystem::path& target, const GeoTiff& raster);

}  // namespace sonar
