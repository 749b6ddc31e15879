// SPDX-License-Identifier: Apache-2.0
#include "io/geotiff.h"

#include <cpl_string.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>

#include "base/library_gate.h"
#include "io/atomic_file.h"
#include "io/gdal_drivers.h"
#include "io/raster_window.h"

namespace sonar {
namespace {

using Dataset = std::unique_ptr<GDALDataset, decltype([](GDALDataset* d) { GDALClose(d); })>;

/// All bands of a row together: so they lie in the file, and a tile is compressed once. Whole tiles leave memory, where GDAL
/// would keep a twentieth of the machine's.
bool write_rows(GDALDataset& out, const GeoTiff& raster) {
  int tile_columns = 0;
  int tile_rows = 1;
  out.GetRasterBand(1)->GetBlockSize(&tile_columns, &tile_rows);
  std::vector<float> line(static_cast<std::size_t>(raster.columns));
  for (int row = 0; row < raster.rows; ++row) {
    for (std::size_t b = 0; b < raster.bands.size(); ++b) {
      std::ranges::fill(line, std::numeric_limits<float>::quiet_NaN());
      raster.bands[b].fill(row, line);
      std::ranges::replace_if(
          line, [](float value) { return std::isnan(value); }, kNoDataWritten);
      GDALRasterBand& band = *out.GetRasterBand(static_cast<int>(b) + 1);
      if (band.RasterIO(GF_Write, 0, row, raster.columns, 1, line.data(), raster.columns, 1, GDT_Float32, 0, 0,
                        nullptr) != CE_None) {
        return false;
      }
    }
    if ((row + 1) % tile_rows != 0) continue;
    for (int b = 1; b <= out.GetRasterCount(); ++b) {
      if (out.GetRasterBand(b)->FlushCache(false) != CE_None) return false;
    }
  }
  return true;
}

}  // namespace

Result<void> write_geotiff(const std::filesystem::path& target, const GeoTiff& raster) {
  begin_gdal();
  auto file = AtomicFile::create(target);
  if (!file) return pass_on(file);
  const auto inside = inside_library();
  const SilentGdal silent;
  const auto refused = [&](const char* what) {
    return fail(ErrorCode::io, fmt::format("{}: {}", what, CPLGetLastErrorMsg()), {.file = target.string()});
  };
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  if (driver == nullptr) return refused("GDAL has no GeoTIFF driver");
  CPLStringList how;
  how.SetNameValue("COMPRESS", "DEFLATE");
  how.SetNameValue("PREDICTOR", "3");
  how.SetNameValue("TILED", "YES");
  {
    const int bands = static_cast<int>(raster.bands.size());
    Dataset out(driver->Create(file->temporary().c_str(), raster.columns, raster.rows, bands, GDT_Float32, how.List()));
    if (!out) return refused("cannot make the raster");
    std::array<double, 6> g{raster.west, raster.step_x, 0.0, raster.north, 0.0, -raster.step_y};
    OGRSpatialReference system;
    if (system.importFromEPSG(raster.epsg) != OGRERR_NONE) return refused("PROJ does not know the raster's system");
    out->SetGeoTransform(g.data());
    out->SetSpatialRef(&system);
    if (!raster.description.empty()) {
      out->SetMetadataItem("TIFFTAG_IMAGEDESCRIPTION", raster.description.c_str());
    }
    for (int b = 0; b < bands; ++b) {
      const RasterBand& from = raster.bands[static_cast<std::size_t>(b)];
      GDALRasterBand& band = *out->GetRasterBand(b + 1);
      band.SetNoDataValue(static_cast<double>(kNoDataWritten));
      band.SetDescription(from.name.c_str());
      band.SetUnitType(from.unit.c_str());
    }
    if (!write_rows(*out, raster)) return refused("cannot write the raster");
    if (out->FlushCache(true); CPLGetLastErrorType() >= CE_Failure) return refused("cannot write the raster");
  }
  return file->commit();
}

}  // namespace sonar
