// SPDX-License-Identifier: Apache-2.0
#include "io/raster_window.h"

#include <cpl_error.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sonar {
namespace {

constexpr double kMetresPerDegree = 111'195.0;
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
/// Deeper than the deepest trench, or higher than any mountain: no value, whatever the file calls it.
constexpr double kImpossible_m = 12'500.0;
/// Of a block, GiB: GDAL takes memory for a whole one before it looks whether the file has it.
constexpr double kMostOfBlock_GiB = 1.0;

bool sound(const std::array<double, 6>& g) {
  return std::all_of(g.begin(), g.end(), [](double v) { return std::isfinite(v); });
}

/// A raster without a coordinate system is taken as geographic where its corners can be latitudes and longitudes.
bool looks_geographic(const std::array<double, 6>& g, int width, int height) {
  const double x1 = g[0] + g[1] * width;
  const double y1 = g[3] + g[5] * height;
  return g[2] == 0.0 && g[4] == 0.0 && std::min(g[0], x1) >= -361.0 && std::max(g[0], x1) <= 541.0 &&
         std::min(g[3], y1) >= -91.0 && std::max(g[3], y1) <= 91.0;
}

/// errors  format: more memory for one block than any raster of depths needs
Result<void> check_blocks(GDALRasterBand& band, const std::string& named) {
  int wide = 0;
  int high = 0;
  band.GetBlockSize(&wide, &high);
  const double gib = static_cast<double>(wide) * high * GDALGetDataTypeSizeBytes(band.GetRasterDataType()) / 0x1p30;
  if (gib <= kMostOfBlock_GiB) return {};
  return fail(
      ErrorCode::format,
      fmt::format("the raster is stored in blocks of {} x {} values, {:.1f} GiB each; expected {:g} GiB or less", wide,
                  high, gib, kMostOfBlock_GiB),
      {.file = named});
}

}  // namespace

SilentGdal::SilentGdal() { CPLPushErrorHandler(CPLQuietErrorHandler); }
SilentGdal::~SilentGdal() { CPLPopErrorHandler(); }

Result<RasterPlaces> RasterPlaces::of(GDALDataset& dataset, const std::string& named) {
  std::array<double, 6> g{};
  RasterPlaces places;
  if (dataset.GetGeoTransform(g.data()) != CE_None || !sound(g) ||
      GDALInvGeoTransform(g.data(), places.inverse_.data()) == 0) {
    return fail(ErrorCode::format, "the raster does not say where its pixels lie (no geotransform)", {.file = named});
  }
  const OGRSpatialReference* system = dataset.GetSpatialRef();
  const bool known = system != nullptr && !system->IsEmpty();
  if (!known && !looks_geographic(g, dataset.GetRasterXSize(), dataset.GetRasterYSize())) {
    return fail(ErrorCode::format, "the raster has no coordinate system, and its corners are no degrees",
                {.file = named});
  }
  OGRSpatialReference wgs84;
  wgs84.SetWellKnownGeogCS("WGS84");
  wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  places.geographic_ = !known || (system->IsGeographic() != 0 && g[2] == 0.0 && g[4] == 0.0);
  if (places.geographic_) {
    // Another datum is some metres off at most: less than a pixel of any grid of depths.
    places.west_deg_ = std::min(g[0], g[0] + g[1] * dataset.GetRasterXSize());
    places.step_deg_ = std::max(std::abs(g[1]), std::abs(g[5]));
    return places;
  }
  OGRSpatialReference own(*system);
  own.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  places.transform_.reset(OGRCreateCoordinateTransformation(&wgs84, &own));
  if (!places.transform_) {
    return fail(ErrorCode::format, "no way from the raster's coordinate system to WGS 84", {.file = named});
  }
  const double metres = own.IsGeographic() != 0 ? kMetresPerDegree : std::max(1e-9, own.GetLinearUnits());
  places.step_deg_ = std::max(std::hypot(g[1], g[4]), std::hypot(g[2], g[5])) * metres / kMetresPerDegree;
  return places;
}

RasterPoint RasterPlaces::pixel(double x, double y) const {
  return {inverse_[0] + inverse_[1] * x + inverse_[2] * y, inverse_[3] + inverse_[4] * x + inverse_[5] * y};
}

std::optional<RasterPoint> RasterPlaces::at(const Geographic& place) const {
  if (geographic_) {
    // A hair west of the raster's edge is its first column, not its last.
    constexpr double kHair_deg = 1e-9;
    return pixel(west_deg_ + wrap_360(place.longitude_deg - west_deg_ + kHair_deg) - kHair_deg, place.latitude_deg);
  }
  double x = place.longitude_deg;
  double y = place.latitude_deg;
  if (transform_->Transform(1, &x, &y) == 0 || !std::isfinite(x) || !std::isfinite(y)) return std::nullopt;
  return pixel(x, y);
}

float RasterValues::at(const RasterPoint& p) const {
  if (values.empty() || p.x < window.first_x || p.x > window.end_x || p.y < window.first_y || p.y > window.end_y) {
    return kNone;
  }
  const double x = (p.x - window.first_x) * width / (window.end_x - window.first_x) - 0.5;
  const double y = (p.y - window.first_y) * height / (window.end_y - window.first_y) - 0.5;
  const int x0 = std::clamp(static_cast<int>(std::floor(x)), 0, std::max(0, width - 2));
  const int y0 = std::clamp(static_cast<int>(std::floor(y)), 0, std::max(0, height - 2));
  const double fx = std::clamp(x - x0, 0.0, 1.0);
  const double fy = std::clamp(y - y0, 0.0, 1.0);
  double sum = 0.0;
  bool whole = true;
  double largest = 0.0;
  float nearest = kNone;
  for (int dy = 0; dy < std::min(2, height); ++dy) {
    for (int dx = 0; dx < std::min(2, width); ++dx) {
      const double wx = width < 2 ? 1.0 : (dx == 1 ? fx : 1.0 - fx);
      const double wy = height < 2 ? 1.0 : (dy == 1 ? fy : 1.0 - fy);
      if (wx * wy <= 0.0) continue;
      const float v = values[static_cast<std::size_t>(y0 + dy) * static_cast<std::size_t>(width) +
                             static_cast<std::size_t>(x0 + dx)];
      whole = whole && !std::isnan(v);
      sum += wx * wy * static_cast<double>(v);
      if (wx * wy > largest) {
        largest = wx * wy;
        nearest = v;
      }
    }
  }
  return whole ? static_cast<float>(sum) : nearest;
}

Result<RasterValues> read_window(GDALRasterBand& band, const PixelWindow& window, int most_side,
                                 const std::string& named) {
  if (auto ok = check_blocks(band, named); !ok) return pass_on(ok);
  RasterValues out;
  out.window = window;
  const int wide = window.end_x - window.first_x;
  const int high = window.end_y - window.first_y;
  out.width = std::min(wide, most_side);
  out.height = std::min(high, most_side);
  out.values.assign(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height), kNone);
  GDALRasterIOExtraArg how;
  INIT_RASTERIO_EXTRA_ARG(how);
  how.eResampleAlg = out.width < wide || out.height < high ? GRIORA_Average : GRIORA_NearestNeighbour;
  if (band.RasterIO(GF_Read, window.first_x, window.first_y, wide, high, out.values.data(), out.width, out.height,
                    GDT_Float32, 0, 0, &how) != CE_None) {
    return fail(ErrorCode::format, fmt::format("the raster cannot be read: {}", CPLGetLastErrorMsg()), {.file = named});
  }
  int has_none = 0;
  const double none = band.GetNoDataValue(&has_none);
  const double scale = band.GetScale();
  const double offset = band.GetOffset();
  for (float& v : out.values) {
    const auto stored = static_cast<double>(v);
    const bool missing = has_none != 0 && static_cast<float>(none) == v;
    const double value = stored * scale + offset;
    v = missing || !std::isfinite(value) || std::abs(value) > kImpossible_m ? kNone : static_cast<float>(value);
  }
  return out;
}

}  // namespace sonar
