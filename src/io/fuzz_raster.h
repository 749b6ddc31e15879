// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the fuzz target of depth rasters does with its input: any bytes, read as a GeoTIFF, netCDF or ASCII grid.

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <span>

#include "base/check.h"
#include "io/depth_raster.h"

namespace sonar::fuzz {

/// GDAL reads files, so there is one, written anew for each input.
class RasterFuzz {
 public:
  /// folder  to write into; ought to be in memory
  explicit RasterFuzz(const std::filesystem::path& folder) : file_(folder / "raster") {}

  /// A grid that is taken is whole, no larger than asked for, and has depths of this planet or none.
  void operator()(std::span<const std::byte> bytes) const {
    {
      std::ofstream out(file_, std::ios::binary | std::ios::trunc);
      out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
      SONAR_CHECK(out.good());
    }
    constexpr int kMost = 40;
    for (const GeoExtent& extent : {GeoExtent{59.0, 61.0, 4.0, 6.0}, GeoExtent{-5.0, 5.0, 170.0, 190.0}}) {
      for (const RasterSign sign : {RasterSign::automatic, RasterSign::depth}) {
        const auto grid = read_depth_raster(file_, extent, {sign, kMost});
        if (!grid) {
          SONAR_CHECK(grid.error().code == ErrorCode::format || grid.error().code == ErrorCode::mismatch);
          continue;
        }
        SONAR_CHECK(grid->rows >= 2 && grid->rows <= kMost && grid->columns >= 2 && grid->columns <= kMost);
        SONAR_CHECK(grid->depth_m.size() ==
                    static_cast<std::size_t>(grid->rows) * static_cast<std::size_t>(grid->columns));
        SONAR_CHECK(grid->step_latitude_deg > 0.0 && grid->step_longitude_deg > 0.0 && !grid->source.empty());
        bool known = false;
        for (const float depth : grid->depth_m) {
          SONAR_CHECK(std::isnan(depth) || std::abs(depth) <= 12'500.0F);
          known = known || !std::isnan(depth);
        }
        SONAR_CHECK(known);
      }
    }
  }

 private:
  std::filesystem::path file_;
};

}  // namespace sonar::fuzz
