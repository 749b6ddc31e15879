// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "base/result.h"
#include "geo/map_projection.h"
#include "model/depth_grid.h"

namespace sonar {

/// What the raster's numbers mean.
enum class RasterSign : std::uint8_t {
  automatic,  ///< told by the variable's attribute `positive`, its names, and the signs of the values, in this order
  elevation,  ///< negative below the sea
  depth,      ///< positive below the sea
};

struct DepthRasterOptions {
  RasterSign sign = RasterSign::automatic;
  int most_nodes = 1500;  ///< along each side; a finer raster is averaged
};

/// Reads the depths of an extent from a raster (GeoTIFF, netCDF or Arc/Info ASCII grid, through GDAL): GEBCO's and
/// EMODnet's layouts among them. Any coordinate system; longitudes 0 .. 360 or -180 .. 180. Only the window that is
/// needed is read, at the resolution that is needed.
/// out     a grid that covers the extent; unknown where the raster has no value or ends; `source` says which variable,
///         and which sign was taken and why
/// errors  one line each. not_found: no such raster. format: not a raster of depths. mismatch: it does not cover the
///         extent; nothing but unknown values there
/// The file may be anything: it is read in a process that reaches no network and writes nothing.
/// threads any that is not inside_library()
[[nodiscard]] Result<DepthGrid> read_depth_raster(const std::filesystem::path& path, const GeoExtent& extent,
                                                  const DepthRasterOptions& options = {});

/// Writes a grid as GeoTIFF, EPSG:4326, elevation in metres (negative below the sea), NoData -32767, deflated; whole or
/// not at all. Equal grids give equal bytes.
/// description  the file's own words of where the depths are from; empty = none
/// errors  io, no_space
[[nodiscard]] Result<void> write_depth_raster(const std::filesystem::path& target, const DepthGrid& grid,
                                              const std::string& description = {});

}  // namespace sonar
