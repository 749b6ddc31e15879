// SPDX-License-Identifier: Apache-2.0
#include "io/depth_raster.h"

#include <cpl_string.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "io/child_process.h"
#include "io/gdal_drivers.h"
#include "io/geotiff.h"
#include "io/netcdf_file.h"
#include "io/raster_window.h"
#include "io/sandbox.h"
#include "io/wire.h"

namespace sonar {
namespace {

using Dataset = std::unique_ptr<GDALDataset, decltype([](GDALDataset* d) { GDALClose(d); })>;

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr std::array<const char*, 4> kDrivers{"GTiff", "netCDF", "AAIGrid", nullptr};
/// Two-dimensional variables that hold the seabed, best first.
constexpr std::array<std::string_view, 12> kNames{"elevation", "depth",      "deptho",        "bathymetry",
                                                  "bathy",     "z",          "topo",          "altitude",
                                                  "height",    "depth_mean", "depth_average", "band1"};

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
  return text;
}

Dataset open(const std::string& name) {
  return Dataset(static_cast<GDALDataset*>(
      GDALOpenEx(name.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, kDrivers.data(), nullptr, nullptr)));
}

/// A file of several variables: the one that holds the seabed.
Result<Dataset> open_variable(Dataset file, const std::string& named) {
  if (file->GetRasterCount() > 0) return file;
  char** list = file->GetMetadata("SUBDATASETS");
  std::string best;
  std::size_t rank = kNames.size();
  for (int i = 1; i <= 1000; ++i) {
    const char* name = CSLFetchNameValue(list, fmt::format("SUBDATASET_{}_NAME", i).c_str());
    if (name == nullptr) break;
    const std::string text = name;
    const std::string variable = lower(text.substr(text.rfind(':') + 1));
    const auto place = static_cast<std::size_t>(std::find(kNames.begin(), kNames.end(), variable) - kNames.begin());
    if (place < rank) {
      rank = place;
      best = text;
    }
  }
  if (best.empty()) {
    return fail(ErrorCode::format, "not a raster of depths: no variable named elevation, depth, bathymetry or z",
                {.file = named});
  }
  Dataset variable = open(best);
  if (!variable || variable->GetRasterCount() < 1) {
    return fail(ErrorCode::format, fmt::format("not a raster of depths: {}", CPLGetLastErrorMsg()), {.file = named});
  }
  return variable;
}

struct Words {
  std::string variable;  ///< as the file spells it; empty in GeoTIFF without a description
  std::string positive;  ///< attribute, lower case
  std::string names;     ///< variable, standard and long name, description, lower case
};

Words words_of(GDALRasterBand& band) {
  const auto item = [&](const char* key) {
    const char* value = band.GetMetadataItem(key);
    return std::string(value != nullptr ? value : "");
  };
  Words w;
  w.variable = item("NETCDF_VARNAME");
  if (w.variable.empty()) w.variable = band.GetDescription();
  w.positive = lower(item("positive"));
  w.names = lower(w.variable + " " + item("standard_name") + " " + item("long_name") + " " + band.GetDescription());
  return w;
}

struct Sign {
  bool elevation = true;
  std::string why;
};

Sign sign_of(const Words& words, RasterSign asked, const std::vector<RasterValues>& parts) {
  if (asked != RasterSign::automatic) return {asked == RasterSign::elevation, "as asked for"};
  if (words.positive == "up" || words.positive == "down") {
    return {words.positive == "up", "its attribute `positive`"};
  }
  std::size_t below = 0;
  std::size_t above = 0;
  for (const RasterValues& part : parts) {
    for (const float v : part.values) {
      below += v < 0.0F ? 1U : 0U;
      above += v > 0.0F ? 1U : 0U;
    }
  }
  const auto says = [&](std::string_view word) { return words.names.find(word) != std::string::npos; };
  if (says("elevation") || says("height") || says("altitude") || says("topo")) return {true, "its name"};
  // Some grids named depth hold elevations.
  if (says("depth") && above >= below) return {false, "its name"};
  return {below >= above, "the signs of its values"};
}

/// The grid that is filled, with where each node lies in the raster.
struct Target {
  DepthGrid grid;
  [[nodiscard]] Geographic node(int row, int column) const {
    return {grid.south_deg + row * grid.step_latitude_deg, wrap_180(grid.west_deg + column * grid.step_longitude_deg)};
  }
};

Target target_grid(const GeoExtent& extent, double step_deg, int most_nodes) {
  Target t;
  const double height = std::max(extent.north_deg - extent.south_deg, 1e-6);
  const double width = std::clamp(extent.east_deg - extent.west_deg, 1e-6, 360.0);
  const double narrow =
      std::max(0.05, std::cos((extent.south_deg + extent.north_deg) / 2.0 * (std::numbers::pi / 180.0)));
  const auto nodes = [&](double length, double step) {
    return std::clamp(static_cast<int>(std::min(std::ceil(length / step), 1e6)) + 1, 2, std::max(2, most_nodes));
  };
  t.grid.rows = nodes(height, step_deg);
  t.grid.columns = nodes(width, step_deg / narrow);
  t.grid.south_deg = extent.south_deg;
  t.grid.west_deg = wrap_180(extent.west_deg);
  t.grid.step_latitude_deg = height / (t.grid.rows - 1);
  t.grid.step_longitude_deg = width / (t.grid.columns - 1);
  t.grid.depth_m.assign(static_cast<std::size_t>(t.grid.rows) * static_cast<std::size_t>(t.grid.columns), kNone);
  return t;
}

/// Grid columns that lie side by side in the raster: a raster's own turn may end within the extent.
struct Stretch {
  int first = 0;
  int end = 0;
};

std::vector<Stretch> stretches(const Target& t, const RasterPlaces& places) {
  std::vector<Stretch> out{{0, t.grid.columns}};
  if (!places.geographic()) return out;
  double before = places.at(t.node(0, 0))->x;
  for (int c = 1; c < t.grid.columns; ++c) {
    const double x = places.at(t.node(0, c))->x;
    if (x < before) {
      out.back().end = c;
      out.push_back({c, t.grid.columns});
    }
    before = x;
  }
  return out;
}

/// Pixels that a stretch of the grid needs: found on a lattice of places, with a margin for what bends between them.
PixelWindow window_of(const Target& t, const Stretch& s, const RasterPlaces& places, int width, int height) {
  constexpr int kLattice = 48;
  double low_x = 1e300;
  double low_y = 1e300;
  double high_x = -1e300;
  double high_y = -1e300;
  const int rows = std::min(kLattice, t.grid.rows - 1);
  const int columns = std::min(kLattice, std::max(1, s.end - s.first - 1));
  for (int i = 0; i <= rows; ++i) {
    for (int j = 0; j <= columns; ++j) {
      const int row = static_cast<int>(std::lround(static_cast<double>(i) * (t.grid.rows - 1) / std::max(1, rows)));
      const int column =
          s.first + static_cast<int>(std::lround(static_cast<double>(j) * (s.end - 1 - s.first) / columns));
      const auto p = places.at(t.node(row, column));
      if (!p) continue;
      low_x = std::min(low_x, p->x);
      high_x = std::max(high_x, p->x);
      low_y = std::min(low_y, p->y);
      high_y = std::max(high_y, p->y);
    }
  }
  const double margin = places.geographic() ? 2.0 : 2.0 + 0.02 * std::max(high_x - low_x, high_y - low_y);
  const auto pixel = [](double v, int count) {
    return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(count)));
  };
  return {pixel(std::floor(low_x - margin), width), pixel(std::floor(low_y - margin), height),
          pixel(std::ceil(high_x + margin), width), pixel(std::ceil(high_y + margin), height)};
}

/// out  how many nodes lie in the window
std::int64_t fill(Target& t, const Stretch& s, const RasterPlaces& places, const RasterValues& values) {
  const PixelWindow& w = values.window;
  std::int64_t inside = 0;
  for (int row = 0; row < t.grid.rows; ++row) {
    for (int column = s.first; column < s.end; ++column) {
      const auto p = places.at(t.node(row, column));
      if (!p) continue;
      const std::size_t i =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(t.grid.columns) + static_cast<std::size_t>(column);
      t.grid.depth_m[i] = values.at(*p);
      inside += p->x >= w.first_x && p->x <= w.end_x && p->y >= w.first_y && p->y <= w.end_y ? 1 : 0;
    }
  }
  return inside;
}

Result<DepthGrid> read_opened(GDALDataset& dataset, const GeoExtent& extent, const DepthRasterOptions& options,
                              const std::filesystem::path& path) {
  const std::string named = path.string();
  auto places = RasterPlaces::of(dataset, named);
  if (!places) return pass_on(places);
  GDALRasterBand& band = *dataset.GetRasterBand(1);
  Target target = target_grid(extent, places->step_deg(), options.most_nodes);
  std::vector<RasterValues> parts;
  std::int64_t inside = 0;
  for (const Stretch& s : stretches(target, *places)) {
    const PixelWindow window = window_of(target, s, *places, dataset.GetRasterXSize(), dataset.GetRasterYSize());
    if (window.empty()) continue;
    auto values = read_window(band, window, 2 * options.most_nodes, named);
    if (!values) return pass_on(values);
    inside += fill(target, s, *places, *values);
    parts.push_back(std::move(*values));
  }
  if (inside == 0) {
    return fail(
        ErrorCode::mismatch,
        fmt::format("the raster does not cover the survey (latitude {:.3f} .. {:.3f}, longitude {:.3f} .. {:.3f})",
                    extent.south_deg, extent.north_deg, extent.west_deg, extent.east_deg),
        {.file = named});
  }
  DepthGrid& grid = target.grid;
  if (std::all_of(grid.depth_m.begin(), grid.depth_m.end(), [](float v) { return std::isnan(v); })) {
    return fail(ErrorCode::mismatch, "the raster has only NoData where the survey is", {.file = named});
  }
  const Words words = words_of(band);
  const Sign sign = sign_of(words, options.sign, parts);
  if (sign.elevation) {
    for (float& v : grid.depth_m) v = 0.0F - v;
  }
  grid.source =
      fmt::format("{}{}{}: {} (told by {})", path.filename().string(), words.variable.empty() ? "" : ", ",
                  words.variable, sign.elevation ? "elevation, negative down" : "depth, positive down", sign.why);
  return std::move(grid);
}

Result<DepthGrid> read_any(const std::filesystem::path& path, const GeoExtent& extent,
                           const DepthRasterOptions& options) {
  const SilentGdal silent;
  Dataset file = open(path.string());
  if (!file) {
    return fail(ErrorCode::format, "not a raster that can be read (GeoTIFF, netCDF or Arc/Info ASCII grid)",
                {.file = path.string()});
  }
  auto variable = open_variable(std::move(file), path.string());
  if (!variable) return pass_on(variable);
  return read_opened(**variable, extent, options, path);
}

constexpr std::uint64_t kMemory_bytes = 8ULL << 30U;
constexpr std::uint64_t kMostTold_bytes = 1ULL << 30U;

struct Layout {
  double south_deg = 0.0;
  double west_deg = 0.0;
  double step_latitude_deg = 0.0;
  double step_longitude_deg = 0.0;
  std::int32_t rows = 0;
  std::int32_t columns = 0;
};

/// Layout, depths, and where they are from.
wire::Bytes encoded(const DepthGrid& grid) {
  wire::Bytes out = wire::encoded(
      Layout{grid.south_deg, grid.west_deg, grid.step_latitude_deg, grid.step_longitude_deg, grid.rows, grid.columns});
  for (const wire::Bytes& part : {wire::encoded(grid.depth_m), wire::encoded(grid.source)}) {
    out.insert(out.end(), part.begin(), part.end());
  }
  return out;
}

std::optional<DepthGrid> decoded(std::span<const std::byte> bytes, int most_nodes) {
  const auto layout = bytes.size() < sizeof(Layout) ? std::nullopt : wire::decoded<Layout>(bytes.first(sizeof(Layout)));
  if (!layout || layout->rows < 2 || layout->columns < 2) return std::nullopt;
  if (layout->rows > std::max(2, most_nodes) || layout->columns > std::max(2, most_nodes)) return std::nullopt;
  bytes = bytes.subspan(sizeof(Layout));
  const std::size_t size =
      static_cast<std::size_t>(layout->rows) * static_cast<std::size_t>(layout->columns) * sizeof(float);
  if (bytes.size() < size) return std::nullopt;
  DepthGrid grid;
  grid.south_deg = layout->south_deg;
  grid.west_deg = layout->west_deg;
  grid.step_latitude_deg = layout->step_latitude_deg;
  grid.step_longitude_deg = layout->step_longitude_deg;
  grid.rows = layout->rows;
  grid.columns = layout->columns;
  grid.depth_m = *wire::decoded<std::vector<float>>(bytes.first(size));
  grid.source = *wire::decoded<std::string>(bytes.subspan(size));
  return grid;
}

}  // namespace

Result<DepthGrid> read_depth_raster(const std::filesystem::path& path, const GeoExtent& extent,
                                    const DepthRasterOptions& options) {
  std::error_code problem;
  if (!std::filesystem::exists(path, problem)) {
    return fail(ErrorCode::not_found, "no such depth raster", {.file = path.string()});
  }
  if (!std::filesystem::is_regular_file(path, problem)) {
    return fail(ErrorCode::format, "not a raster but a folder or device", {.file = path.string()});
  }
  begin_gdal();
  const auto make = [&] {
    // Held so that no other thread is inside HDF5 when the process is doubled.
    const auto held = netcdf::lock();
    return ChildProcess::start(
        [&](int stream) {
          if (!wire::greet(stream)) return;
          (void)enter_sandbox(stream, Reach::files_to_read, kMemory_bytes);
          const auto grid = read_any(path, extent, options);
          (void)wire::tell(stream, grid ? Result<void>{} : pass_on(grid), grid ? encoded(*grid) : wire::Bytes{});
        },
        path.string());
  };
  const auto begun = wire::begin(make, kMostTold_bytes);
  if (!begun) return fail(begun.error().code, begun.error().text, {.file = path.string()});
  auto grid = decoded(begun->said, options.most_nodes);
  if (!grid) return fail(ErrorCode::format, "is damaged: reading it breaks GDAL", {.file = path.string()});
  return std::move(*grid);
}

Result<void> write_depth_raster(const std::filesystem::path& target, const DepthGrid& grid,
                                const std::string& description) {
  GeoTiff raster;
  raster.west = grid.west_deg - grid.step_longitude_deg / 2.0;
  raster.north = grid.south_deg + (grid.rows - 0.5) * grid.step_latitude_deg;
  raster.step_x = grid.step_longitude_deg;
  raster.step_y = grid.step_latitude_deg;
  raster.columns = grid.columns;
  raster.rows = grid.rows;
  raster.description = description;
  raster.bands = {{"elevation", "m", [&grid](int row, std::span<float> line) {
                     for (int column = 0; column < grid.columns; ++column) {
                       line[static_cast<std::size_t>(column)] = 0.0F - grid.at(grid.rows - 1 - row, column);
                     }
                   }}};
  return write_geotiff(target, raster);
}

}  // namespace sonar
