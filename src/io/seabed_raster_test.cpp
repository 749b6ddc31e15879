// SPDX-License-Identifier: Apache-2.0
#include "io/seabed_raster.h"

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "geo/geodesic.h"
#include "io/depth_raster.h"
#include "io/sandbox.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using Dataset = std::unique_ptr<GDALDataset, decltype([](GDALDataset* d) { GDALClose(d); })>;

class SeabedRasterFile : public testing::Test {
 protected:
  SeabedRasterFile() : folder_(fs::temp_directory_path() / ("sonar_seabed_" + std::to_string(::getpid()))) {}
  ~SeabedRasterFile() override { fs::remove_all(folder_); }
  SeabedRasterFile(const SeabedRasterFile&) = delete;
  SeabedRasterFile& operator=(const SeabedRasterFile&) = delete;
  /// depth, standard_error, count at a pixel
  static std::array<float, 3> at(GDALDataset& file, int column, int row) {
    std::array<float, 3> values{};
    for (int band = 1; band <= 3; ++band) {
      EXPECT_EQ(
          file.GetRasterBand(band)->RasterIO(GF_Read, column, row, 1, 1, &values[static_cast<std::size_t>(band - 1)], 1,
                                             1, GDT_Float32, 0, 0, nullptr),
          CE_None);
    }
    return values;
  }
  fs::path folder_;
};

/// On the central meridian of zone 31, where easting is 500 km: one cell of three beams of two fans, one of a single beam
/// 40 m east of it. Weights 1, 1 and 1/4: (100 + 103 + 98/4) / 2.25; standard error sqrt(3 / 2.25 / 2).
TEST_F(SeabedRasterFile, CellsWorkedByHand) {
  const Geographic middle = destination(destination({60.0, 3.0}, 5.0, 0.0), 5.0, 90.0);
  SeabedRaster raster({20.0, false}, middle);
  raster.add({middle, 100.0, 1.0, 0});
  raster.add({middle, 103.0, 1.0, 0});
  raster.add({middle, 98.0, 2.0, 5});
  raster.add({destination(middle, 40.0, 90.0), 110.0, 3.0, 1});
  raster.add({{std::nan(""), 3.0}, 100.0, 1.0, 0});
  raster.add({middle, 100.0, std::nan(""), 0});
  ASSERT_TRUE(raster.write(folder_ / "utm.tif", "made by hand"));
  const Dataset file(GDALDataset::Open((folder_ / "utm.tif").c_str()));
  ASSERT_TRUE(file);
  ASSERT_EQ(file->GetRasterXSize(), 3);
  ASSERT_EQ(file->GetRasterYSize(), 1);
  EXPECT_EQ(file->GetSpatialRef()->GetUTMZone(), 31);
  std::array<double, 6> g{};
  file->GetGeoTransform(g.data());
  EXPECT_EQ(g[0], 500'000.0);
  EXPECT_EQ(g[1], 20.0);
  EXPECT_EQ(g[5], -20.0);
  const auto first = at(*file, 0, 0);
  EXPECT_NEAR(first[0], 227.5 / 2.25, 1e-4);
  EXPECT_NEAR(first[1], std::sqrt(3.0 / 2.25 / 2.0), 1e-6);
  EXPECT_EQ(first[2], 3.0F);
  EXPECT_EQ(at(*file, 1, 0), (std::array<float, 3>{-32767.0F, -32767.0F, -32767.0F}));
  EXPECT_EQ(at(*file, 2, 0), (std::array<float, 3>{110.0F, 3.0F, 1.0F}));
  EXPECT_EQ(file->GetRasterBand(1)->GetNoDataValue(), -32767.0);
}

/// Across the date line the raster is narrow, and our own reader takes it for depths, not heights.
TEST_F(SeabedRasterFile, IsReadAsDepthsAcrossTheDateLine) {
  SeabedRaster raster({1000.0, true}, {-45.0, 179.99});
  for (const double east_deg : {179.96, 179.98, -180.0, -179.98, -179.96}) {
    for (const double north_deg : {-45.02, -45.01, -45.0, -44.99}) raster.add({{north_deg, east_deg}, 80.0, 1.0, 0});
  }
  ASSERT_TRUE(raster.write(folder_ / "geographic.tif", ""));
  const auto grid = read_depth_raster(folder_ / "geographic.tif", {-45.01, -44.99, 179.97, 180.02});
  ASSERT_TRUE(grid) << to_line(grid.error());
  EXPECT_NEAR(grid->depth_at({-45.0, 179.98}), 80.0, 1e-3);
}

/// Rows and tiles of a large raster that hardly any beam hits: every beam in its own cell, nothing between.
TEST_F(SeabedRasterFile, BeamsFarApartLieWhereTheyWere) {
  SeabedRaster raster({1000.0, true}, {0.0, 0.0});
  const double step_deg = 1000.0 / 111'320.0;
  const int size = 700;
  for (int i = 0; i < size; i += 3) {
    raster.add({{(i + 0.5) * step_deg, ((7 * i) % size + 0.5) * step_deg}, 50.0 + i, 1.0, 0});
  }
  ASSERT_TRUE(raster.write(folder_ / "wide.tif", ""));
  const Dataset file(GDALDataset::Open((folder_ / "wide.tif").c_str()));
  ASSERT_TRUE(file);
  const int columns = file->GetRasterXSize();
  const int rows = file->GetRasterYSize();
  EXPECT_EQ(rows, (size - 1) / 3 * 3 + 1);
  std::vector<float> depth(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  ASSERT_EQ(file->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, columns, rows, depth.data(), columns, rows, GDT_Float32, 0,
                                             0, nullptr),
            CE_None);
  std::ptrdiff_t hit = 0;
  for (int i = 0; i < size; i += 3) {
    const auto at = static_cast<std::size_t>(rows - 1 - i) * static_cast<std::size_t>(columns) +
                    static_cast<std::size_t>((7 * i) % size);
    EXPECT_EQ(depth[at], static_cast<float>(50.0 + i)) << i;
    ++hit;
  }
  EXPECT_EQ(std::ssize(depth) - std::count(depth.begin(), depth.end(), -32767.0F), hit);
}

/// Three bands of 6 million cells are 72 MB; a row of tiles of them is 12 MB.
TEST_F(SeabedRasterFile, ALargeOneIsNeverInMemory) {
  if (kSanitized) GTEST_SKIP() << "its memory is the sanitizer's";
  const auto most_kb = [] {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    return used.ru_maxrss;
  };
  const double step_deg = 1000.0 / 111'320.0;
  SeabedRaster raster({1000.0, true}, {0.0, 0.0});
  raster.add({{0.5 * step_deg, 0.5 * step_deg}, 80.0, 1.0, 0});
  raster.add({{1499.5 * step_deg, 3999.5 * step_deg}, 80.0, 1.0, 0});
  const long before_kb = most_kb();
  ASSERT_TRUE(raster.write(folder_ / "large.tif", ""));
  EXPECT_LT(most_kb() - before_kb, 40'000);
}

TEST_F(SeabedRasterFile, TooManyCellsAreRefused) {
  SeabedRaster raster({0.5, true}, {0.0, 0.0});
  raster.add({{0.0, 0.0}, 80.0, 1.0, 0});
  raster.add({{60.0, 90.0}, 80.0, 1.0, 0});
  EXPECT_FALSE(raster.write(folder_ / "large.tif", ""));
  EXPECT_FALSE(fs::exists(folder_ / "large.tif"));
}

}  // namespace
}  // namespace sonar
