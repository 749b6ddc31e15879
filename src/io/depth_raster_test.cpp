// SPDX-License-Identifier: Apache-2.0
#include "io/depth_raster.h"

#include <cpl_string.h>
#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <thread>

#include "base/units.h"
#include "io/netcdf_file.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

/// Bilinear interpolation keeps it exactly, so that every right answer is known.
double depth_of(double latitude_deg, double longitude_deg) {
  return 1000.0 + 10.0 * (latitude_deg - 60.0) + 2.0 * wrap_180(longitude_deg - 5.0);
}

class Raster : public testing::Test {
 protected:
  Raster() : folder_(fs::temp_directory_path() / ("sonar_raster_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
    GDALAllRegister();
  }
  ~Raster() override { fs::remove_all(folder_); }
  Raster(const Raster&) = delete;
  Raster& operator=(const Raster&) = delete;

  struct Layout {
    double west_deg = 0.0;
    double north_deg = 0.0;
    double step_deg = 0.0;
    int width = 0;
    int height = 0;
    double sign = -1.0;  ///< -1 = elevations
    double none = -32767.0;
    int epsg = 4326;  ///< 0 = none
  };

  using Value = std::function<double(double x, double y)>;
  [[nodiscard]] fs::path tiff(const std::string& name, const Layout& l, const Value& value) const {
    fs::path path = folder_ / name;
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
    auto* out = driver->Create(path.c_str(), l.width, l.height, 1, GDT_Float32, nullptr);
    double g[6] = {l.west_deg, l.step_deg, 0.0, l.north_deg, 0.0, -l.step_deg};
    out->SetGeoTransform(g);
    if (l.epsg != 0) {
      OGRSpatialReference system;
      system.importFromEPSG(l.epsg);
      out->SetSpatialRef(&system);
    }
    out->GetRasterBand(1)->SetNoDataValue(l.none);
    std::vector<float> line(static_cast<std::size_t>(l.width));
    for (int row = 0; row < l.height; ++row) {
      for (int c = 0; c < l.width; ++c) {
        line[static_cast<std::size_t>(c)] =
            static_cast<float>(value(l.west_deg + (c + 0.5) * l.step_deg, l.north_deg - (row + 0.5) * l.step_deg));
      }
      EXPECT_EQ(out->GetRasterBand(1)->RasterIO(GF_Write, 0, row, l.width, 1, line.data(), l.width, 1, GDT_Float32, 0,
                                                0, nullptr),
                CE_None);
    }
    GDALClose(out);
    return path;
  }

  /// netCDF as GEBCO and EMODnet lay it out: lat rising, one two-dimensional variable among others.
  struct Grid {
    std::string variable = "elevation";
    std::string positive = {};
    double west_deg = 0.0;  ///< of the first node
    double sign = -1.0;
    std::string other = {};  ///< a second variable of the same shape
  };
  [[nodiscard]] fs::path netcdf_grid(const std::string& name, const Grid& g, double south, double step, int rows,
                                     int columns) const {
    fs::path path = folder_ / name;
    std::vector<double> lat;
    std::vector<double> lon;
    std::vector<float> z;
    for (int i = 0; i < rows; ++i) lat.push_back(south + i * step);
    for (int i = 0; i < columns; ++i) lon.push_back(g.west_deg + i * step);
    for (const double y : lat) {
      for (const double x : lon) z.push_back(static_cast<float>(g.sign * depth_of(y, x)));
    }
    netcdf::Writer w(name);
    const auto lats = w.dimension(w.root(), "lat", lat.size());
    const auto lons = w.dimension(w.root(), "lon", lon.size());
    const int vlat = w.variable(w.root(), "lat", "degrees_north", {lats}, lat);
    w.attribute(w.root(), vlat, "standard_name", "latitude");
    const int vlon = w.variable(w.root(), "lon", "degrees_east", {lons}, lon);
    w.attribute(w.root(), vlon, "standard_name", "longitude");
    if (!g.other.empty()) w.variable(w.root(), g.other, "1", {lats, lons}, std::vector<float>(z.size(), 7.0F));
    const int v = w.variable(w.root(), g.variable, "m", {lats, lons}, z);
    if (!g.positive.empty()) w.attribute(w.root(), v, "positive", g.positive);
    w.attribute(w.root(), netcdf::Writer::kGlobal, "Conventions", "CF-1.6");
    auto file = AtomicFile::create(path);
    EXPECT_TRUE(file && w.close_into(*file) && file->commit());
    return path;
  }

  static void expect_right(const DepthGrid& grid, const GeoExtent& e, double tolerance_m) {
    for (int i = 0; i <= 10; ++i) {
      for (int j = 0; j <= 10; ++j) {
        const Geographic p{e.south_deg + (e.north_deg - e.south_deg) * i / 10.0,
                           wrap_180(e.west_deg + (e.east_deg - e.west_deg) * j / 10.0)};
        EXPECT_NEAR(grid.depth_at(p), depth_of(p.latitude_deg, p.longitude_deg), tolerance_m)
            << p.latitude_deg << ' ' << p.longitude_deg;
      }
    }
  }

  fs::path folder_;
};

constexpr GeoExtent kSurvey{59.8, 60.3, 4.5, 5.6};

TEST_F(Raster, ReadsAGeoTiffOfElevations) {
  const auto path =
      tiff("emodnet.tif", {4.0, 61.0, 0.01, 200, 200}, [](double x, double y) { return -depth_of(y, x); });
  const auto grid = read_depth_raster(path, kSurvey);
  ASSERT_TRUE(grid) << to_line(grid.error());
  expect_right(*grid, kSurvey, 0.01);
  EXPECT_EQ(grid->source, "emodnet.tif: elevation, negative down (told by the signs of its values)");
}

TEST_F(Raster, ReadsDepthsPositiveDownAndAsAskedFor) {
  const auto path = tiff("down.tif", {4.0, 61.0, 0.01, 200, 200}, [](double x, double y) { return depth_of(y, x); });
  const auto grid = read_depth_raster(path, kSurvey);
  ASSERT_TRUE(grid);
  expect_right(*grid, kSurvey, 0.01);
  EXPECT_NE(grid->source.find("depth, positive down"), std::string::npos);
  const auto asked = read_depth_raster(path, kSurvey, {.sign = RasterSign::elevation, .most_nodes = 100});
  ASSERT_TRUE(asked);
  EXPECT_NEAR(asked->depth_at({60.0, 5.0}), -1000.0, 0.1);
}

TEST_F(Raster, ReadsGebcosAndEmodnetsNetcdf) {
  const auto gebco = netcdf_grid("gebco.nc", {.west_deg = 3.0}, 59.0, 0.02, 120, 200);
  auto grid = read_depth_raster(gebco, kSurvey);
  ASSERT_TRUE(grid) << to_line(grid.error());
  expect_right(*grid, kSurvey, 0.01);
  EXPECT_EQ(grid->source, "gebco.nc, elevation: elevation, negative down (told by its name)");

  const Grid down{.variable = "depth", .positive = {}, .west_deg = 3.0, .sign = 1.0, .other = "value_count"};
  grid = read_depth_raster(netcdf_grid("depth.nc", down, 59.0, 0.02, 120, 200), kSurvey);
  ASSERT_TRUE(grid) << to_line(grid.error());
  expect_right(*grid, kSurvey, 0.01);
  EXPECT_NE(grid->source.find("depth: depth, positive down (told by its name)"), std::string::npos) << grid->source;

  // A name that lies, put right by the attribute; and one put right by the values.
  const Grid attribute{.variable = "depth", .positive = "up", .west_deg = 3.0, .sign = -1.0, .other = {}};
  grid = read_depth_raster(netcdf_grid("up.nc", attribute, 59.0, 0.02, 120, 200), kSurvey);
  ASSERT_TRUE(grid);
  expect_right(*grid, kSurvey, 0.01);
  const Grid values{.variable = "depth", .positive = {}, .west_deg = 3.0, .sign = -1.0, .other = {}};
  grid = read_depth_raster(netcdf_grid("lies.nc", values, 59.0, 0.02, 120, 200), kSurvey);
  ASSERT_TRUE(grid);
  expect_right(*grid, kSurvey, 0.01);
}

TEST_F(Raster, LongitudesMayRunTo360AndTheSurveyOverTheSeam) {
  const Value elevation = [](double x, double y) { return -depth_of(y, wrap_180(x)); };
  const auto to360 = tiff("to360.tif", {0.0, 90.0, 0.5, 720, 360}, elevation);
  const auto to180 = tiff("to180.tif", {-180.0, 90.0, 0.5, 720, 360}, elevation);
  const GeoExtent greenwich{59.0, 61.0, -2.0, 2.0};
  const GeoExtent dateline{59.0, 61.0, 172.0, 184.0};
  for (const auto& [path, extent] : {std::pair(to360, greenwich), std::pair(to180, greenwich),
                                     std::pair(to360, dateline), std::pair(to180, dateline)}) {
    const auto grid = read_depth_raster(path, extent);
    ASSERT_TRUE(grid);
    // At a raster's seam the nearest pixel is kept: half a pixel of 1 m/degree.
    expect_right(*grid, extent, 0.6);
  }
  const auto netcdf = netcdf_grid("to360.nc", {.west_deg = 0.5}, 55.0, 1.0, 11, 360);
  const auto grid = read_depth_raster(netcdf, {58.0, 62.0, -10.0, -5.0});
  ASSERT_TRUE(grid) << to_line(grid.error());
  expect_right(*grid, {58.0, 62.0, -10.0, -5.0}, 0.01);
}

TEST_F(Raster, AProjectedRasterIsLookedUpThroughItsCoordinateSystem) {
  // UTM zone 32 N; the values are the analytic depth at each pixel's latitude and longitude.
  OGRSpatialReference utm;
  utm.importFromEPSG(32632);
  OGRSpatialReference wgs84;
  wgs84.importFromEPSG(4326);
  wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  utm.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  OGRCoordinateTransformation* to_degrees = OGRCreateCoordinateTransformation(&utm, &wgs84);
  ASSERT_NE(to_degrees, nullptr);
  const auto path =
      tiff("utm.tif", {230'000.0, 6'720'000.0, 250.0, 400, 400, -1.0, -32767.0, 32632}, [&](double x, double y) {
        to_degrees->Transform(1, &x, &y);
        return -depth_of(y, x);
      });
  OGRCoordinateTransformation::DestroyCT(to_degrees);
  const auto grid = read_depth_raster(path, kSurvey);
  ASSERT_TRUE(grid) << to_line(grid.error());
  expect_right(*grid, kSurvey, 0.01);
}

TEST_F(Raster, NoDataIsUnknownAndNothingElse) {
  const auto path = tiff("holes.tif", {4.0, 61.0, 0.01, 200, 200},
                         [](double x, double y) { return x > 5.2 ? -32767.0 : (x < 4.6 ? 0.0 : -depth_of(y, x)); });
  const auto grid = read_depth_raster(path, kSurvey);
  ASSERT_TRUE(grid);
  EXPECT_TRUE(std::isnan(grid->depth_at({60.0, 5.4})));
  EXPECT_EQ(grid->depth_at({60.0, 4.55}), 0.0);
  EXPECT_NEAR(grid->depth_at({60.0, 5.0}), 1000.0, 0.01);
}

TEST_F(Raster, AFineRasterIsAveraged) {
  const auto path =
      tiff("fine.tif", {4.0, 61.0, 0.001, 2000, 2000}, [](double x, double y) { return -depth_of(y, x); });
  const auto grid = read_depth_raster(path, kSurvey, {.most_nodes = 50});
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->rows, 50);
  expect_right(*grid, kSurvey, 0.1);
}

TEST_F(Raster, EveryRefusalIsOneLine) {
  const auto refusal = [&](const fs::path& path) {
    const auto grid = read_depth_raster(path, kSurvey);
    EXPECT_FALSE(grid);
    return grid ? std::string() : to_line(grid.error()).substr(folder_.string().size() + 1);
  };
  EXPECT_EQ(refusal(folder_ / "none.tif"), "none.tif: no such depth raster");
  std::ofstream(folder_ / "text.tif") << "no raster\n";
  EXPECT_EQ(refusal(folder_ / "text.tif"),
            "text.tif: not a raster that can be read (GeoTIFF, netCDF or Arc/Info ASCII grid)");
  fs::create_directories(folder_ / "folder");
  EXPECT_EQ(refusal(folder_ / "folder"), "folder: not a raster but a folder or device");
  const auto elsewhere = tiff("elsewhere.tif", {20.0, 61.0, 0.01, 200, 200}, [](double, double) { return -1.0; });
  EXPECT_EQ(
      refusal(elsewhere),
      "elsewhere.tif: the raster does not cover the survey (latitude 59.800 .. 60.300, longitude 4.500 .. 5.600)");
  const auto empty = tiff("empty.tif", {4.0, 61.0, 0.01, 200, 200}, [](double, double) { return -32767.0; });
  EXPECT_EQ(refusal(empty), "empty.tif: the raster has only NoData where the survey is");
  const auto nowhere =
      tiff("nowhere.tif", {4e5, 7e6, 100.0, 20, 20, -1.0, -32767.0, 0}, [](double, double) { return -1.0; });
  EXPECT_EQ(refusal(nowhere), "nowhere.tif: the raster has no coordinate system, and its corners are no degrees");
  const auto other =
      netcdf_grid("other.nc", {.variable = "chlorophyll", .west_deg = 3.0, .other = "sst"}, 59.0, 0.02, 120, 200);
  EXPECT_EQ(refusal(other), "other.nc: not a raster of depths: no variable named elevation, depth, bathymetry or z");
  const auto broken = netcdf_grid("broken.nc", {.west_deg = 3.0}, 59.0, 0.02, 120, 200);
  fs::resize_file(broken, fs::file_size(broken) / 3);
  EXPECT_NE(refusal(broken).find("broken.nc: "), std::string::npos);
}

TEST_F(Raster, WhatIsWrittenReadsBackAndHasEqualBytes) {
  DepthGrid grid{59.0, 179.0, 0.01, 0.02, 150, 120, {}, "made"};
  for (int r = 0; r < grid.rows; ++r) {
    for (int c = 0; c < grid.columns; ++c) {
      grid.depth_m.push_back(static_cast<float>(depth_of(59.0 + 0.01 * r, wrap_180(179.0 + 0.02 * c))));
    }
  }
  ASSERT_TRUE(write_depth_raster(folder_ / "a.tif", grid));
  ASSERT_TRUE(write_depth_raster(folder_ / "b.tif", grid));
  const auto bytes = [](const fs::path& p) {
    std::ifstream in(p, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_EQ(bytes(folder_ / "a.tif"), bytes(folder_ / "b.tif"));
  const GeoExtent inside{59.2, 60.2, 179.5, 181.0};
  const auto back = read_depth_raster(folder_ / "a.tif", inside);
  ASSERT_TRUE(back) << to_line(back.error());
  expect_right(*back, inside, 0.01);
}

TEST_F(Raster, ManyThreadsReadTheSameFiles) {
  const auto path = tiff("many.tif", {4.0, 61.0, 0.01, 200, 200}, [](double x, double y) { return -depth_of(y, x); });
  const auto netcdf = netcdf_grid("many.nc", {.west_deg = 3.0}, 59.0, 0.02, 120, 200);
  const auto expected = read_depth_raster(path, kSurvey);
  ASSERT_TRUE(expected);
  // Files of netCDF are first read in a child process, which must not inherit a lock that another thread holds.
  constexpr int kTimes = 20;
  std::vector<std::thread> threads;
  std::vector<int> equal(6, 0);
  for (std::size_t i = 0; i < equal.size(); ++i) {
    threads.emplace_back([&, i] {
      for (int time = 0; time < kTimes; ++time) {
        const auto grid = read_depth_raster(i % 2 == 0 ? path : netcdf, kSurvey);
        equal[i] += grid && (i % 2 != 0 || grid->depth_m == expected->depth_m) ? 1 : 0;
      }
    });
  }
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(equal, std::vector<int>(6, kTimes));
}

}  // namespace
}  // namespace sonar
