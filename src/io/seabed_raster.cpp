// SPDX-License-Identifier: Apache-2.0
#include "io/seabed_raster.h"

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include "base/library_gate.h"
#include "base/units.h"
#include "io/gdal_drivers.h"
#include "io/geotiff.h"

namespace sonar {
namespace {

constexpr double kMetresPerDegree = 111'320.0;  ///< along a meridian, nearly: cells need not be square to the metre
constexpr std::int64_t kMostCells = 200'000'000;

int utm_zone(const Geographic& near) {
  return std::clamp(static_cast<int>(std::floor((wrap_180(near.longitude_deg) + 180.0) / 6.0)) + 1, 1, 60);
}

}  // namespace

struct SeabedRaster::Projection {
  std::unique_ptr<OGRCoordinateTransformation,
                  decltype([](OGRCoordinateTransformation* t) { OGRCoordinateTransformation::DestroyCT(t); })>
      forward;
};

SeabedRaster::SeabedRaster(const SeabedRasterParams& params, const Geographic& near)
    : step_x_(params.cell_m), step_y_(params.cell_m), near_(near) {
  if (params.geographic) {
    step_y_ = params.cell_m / kMetresPerDegree;
    step_x_ = step_y_ / std::max(0.01, std::cos(rad_from_deg(near.latitude_deg)));
    return;
  }
  epsg_ = (near.latitude_deg < 0.0 ? 32700 : 32600) + utm_zone(near);
  begin_gdal();
  const auto inside = inside_library();
  OGRSpatialReference wgs84;
  OGRSpatialReference utm;
  wgs84.importFromEPSG(4326);
  wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  utm.importFromEPSG(epsg_);
  projection_ = std::make_unique<Projection>();
  projection_->forward.reset(OGRCreateCoordinateTransformation(&wgs84, &utm));
}

SeabedRaster::~SeabedRaster() = default;

void SeabedRaster::add(const SeabedDepth& depth) {
  double x = near_.longitude_deg + wrap_180(depth.place.longitude_deg - near_.longitude_deg);
  double y = depth.place.latitude_deg;
  if (projection_) {
    const auto inside = inside_library();
    if (!projection_->forward || !std::isfinite(x + y) || !projection_->forward->Transform(1, &x, &y)) return;
  }
  if (!std::isfinite(x + y + depth.depth_m) || !(depth.se_m > 0.0)) return;
  Cell& cell =
      cells_[{static_cast<std::int64_t>(std::floor(y / step_y_)), static_cast<std::int64_t>(std::floor(x / step_x_))}];
  const double weight = 1.0 / (depth.se_m * depth.se_m);
  cell.weight += weight;
  cell.weighted_m += weight * depth.depth_m;
  ++cell.beams;
  cell.fans |= std::uint64_t{1} << static_cast<unsigned>(depth.fan % 64);
}

Result<void> SeabedRaster::write(const std::filesystem::path& target, const std::string& description) const {
  std::int64_t south = std::numeric_limits<std::int64_t>::max();
  std::int64_t west = south;
  std::int64_t north = std::numeric_limits<std::int64_t>::min();
  std::int64_t east = north;
  for (const auto& [at, cell] : cells_) {
    south = std::min(south, at.first);
    north = std::max(north, at.first);
    west = std::min(west, at.second);
    east = std::max(east, at.second);
  }
  if (cells_.empty() || (north - south + 1) > kMostCells / (east - west + 1)) {
    return fail(ErrorCode::unsupported,
                cells_.empty() ? "no depth lies anywhere"
                               : fmt::format("would have more than {} cells; expected larger ones", kMostCells),
                {.file = target.string()});
  }
  GeoTiff raster;
  raster.epsg = epsg_;
  raster.step_x = step_x_;
  raster.step_y = step_y_;
  raster.west = static_cast<double>(west) * step_x_;
  raster.north = static_cast<double>(north + 1) * step_y_;
  raster.columns = static_cast<int>(east - west + 1);
  raster.rows = static_cast<int>(north - south + 1);
  raster.description = description;
  const auto band = [&](const char* name, const char* unit, float (*value)(const Cell&)) {
    return RasterBand{
        name, unit, [this, north, west, value](int row, std::span<float> line) {
          const std::int64_t of = north - row;
          for (auto at = cells_.lower_bound({of, west}); at != cells_.end() && at->first.first == of; ++at) {
            line[static_cast<std::size_t>(at->first.second - west)] = value(at->second);
          }
        }};
  };
  raster.bands = {
      band("depth", "m", [](const Cell& cell) { return static_cast<float>(cell.weighted_m / cell.weight); }),
      // Weighted mean of the beams' variances, by the fans.
      band("standard_error", "m",
           [](const Cell& cell) {
             const auto fans = static_cast<double>(std::popcount(cell.fans));
             return static_cast<float>(std::sqrt(static_cast<double>(cell.beams) / cell.weight / fans));
           }),
      band("count", "1", [](const Cell& cell) { return static_cast<float>(cell.beams); })};
  return write_geotiff(target, raster);
}

}  // namespace sonar
