// SPDX-License-Identifier: Apache-2.0
#include "io/geotiff.h"

#include <cpl_string.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>

#include "base/check.h"
#include "base/library_gate.h"
#include "io/atomic_file.h"
#include "io/gdal_drivers.h"
#include "io/raster_window.h"

namespace sonar {
namespace {

using Dataset = std::unique_ptr<GDALDataset, decltype([](GDALDataset* d) { GDALClose(d); })>;

/// Row by row.
bool write_band(GDALRasterBand& band, const RasterBand& from, const GeoTiff& raster) {
  band.SetNoDataValue(static_cast<double>(kNoDataWritten));
  band.SetDescription(from.name.c_str());
  band.SetUnitType(from.unit.c_str());
  std::vector<float> line(static_cast<std::size_t>(raster.columns));
  for (int row = 0; row < raster.rows; ++row) {
    const std::size_t first = static_cast<std::size_t>(row) * line.size();
    for (std::size_t c = 0; c < line.size(); ++c) {
      line[c] = std::isnan(from.values[first + c]) ? kNoDataWritten : from.values[first + c];
    }
    if (band.RasterIO(GF_Write, 0, row, raster.columns, 1, line.data(), raster.columns, 1, GDT_Float32, 0, 0,
                      nullptr) != CE_None) {
      return false;
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
      const RasterBand& band = raster.bands[static_cast<std::size_t>(b)];
      SONAR_CHECK(band.values.size() ==
                  static_cast<std::size_t>(raster.columns) * static_cast<std::size_t>(raster.rows));
      if (!write_band(*out->GetRasterBand(b + 1), band, raster)) return refused("cannot write the raster");
    }
    if (out->FlushCache(true); CPLGetLastErrorType() >= CE_Failure) return refused("cannot write the raster");
  }
  return file->commit();
}

}  // namespace sonar
