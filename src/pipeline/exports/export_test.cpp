// SPDX-License-Identifier: Apache-2.0
#include "pipeline/exports/export.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "base/units.h"
#include "geo/geodesic.h"
#include "io/atomic_file.h"
#include "io/csv.h"
#include "io/product_example.h"
#include "io/product_file.h"
#include "pipeline/exports/export_meshes.h"
#include "pipeline/recipe/recipe.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Export : public testing::Test {
 protected:
  Export() : folder_(fs::temp_directory_path() / ("sonar_export_" + std::to_string(::getpid()))) {
    ObservationProduct p = example::empty("obs-0001", 5);
    example::add_school(p, 1, 0, 3, example::block(1, 1, 2, 20, 8));
    EXPECT_TRUE(write_product(p, folder_ / "out" / "products" / "obs-0001.nc"));
  }
  ~Export() override { fs::remove_all(folder_); }
  Export(const Export&) = delete;
  Export& operator=(const Export&) = delete;
  Result<Exported> run(const std::string& format) {
    ExportOptions options;
    options.out = folder_ / "out";
    options.format = format;
    options.dest = folder_ / format;
    return export_products(options, work_);
  }
  fs::path folder_;
  Work work_{1};
};

TEST_F(Export, tables_maps_and_masks) {
  const auto csv = run("csv");
  ASSERT_TRUE(csv) << to_line(csv.error());
  EXPECT_EQ(read_csv_rows<SchoolPingRow>(csv->files.at(1))->size(), 4U);
  for (const char* format : {"gpkg", "geojson", "netcdf-mask", "ply", "gltf", "vtu", "echoview", "lsss"}) {
    const auto files = run(format);
    ASSERT_TRUE(files) << to_line(files.error());
    EXPECT_FALSE(fs::is_empty(folder_ / format)) << format;
  }
}

// The recipe may have moved the times of pings; other programs know those of the raw files.
TEST_F(Export, lsss_has_the_times_of_the_datagrams) {
  ObservationProduct p = example::empty("obs-0001", 5);
  p.recipe_json = R"({"recipe_version":1,"navigation":{"time_offset_s":-2.5}})";
  example::add_school(p, 1, 0, 3, example::block(1, 1, 2, 20, 8));
  ASSERT_TRUE(write_product(p, folder_ / "out" / "products" / "obs-0001.nc"));
  const auto written = run("lsss");
  ASSERT_TRUE(written) << to_line(written.error());
  const auto text = read_file(folder_ / "lsss" / "obs-0001.work");
  ASSERT_TRUE(text) << to_line(text.error());
  const auto schools = parse_lsss_work(*text, "obs-0001.work", LsssNumbering::from_one);
  ASSERT_TRUE(schools) << to_line(schools.error());
  EXPECT_EQ(schools->at(0).pings.at(0).time, example::kStart + 2'500'000'000);
}

TEST_F(Export, schools_have_the_numbers_of_the_tables) {
  const auto number = [this] {
    const auto csv = run("csv");
    return csv ? read_csv_rows<SchoolRow>(csv->files.at(0))->at(0).survey_school : -1;
  };
  EXPECT_EQ(number(), 1) << "not merged yet";
  ASSERT_TRUE(write_file(folder_ / "out" / "survey.json", R"({"survey_schools":[]})"));
  EXPECT_EQ(number(), 0) << "merged while observations were missing";
}

TEST_F(Export, refuses_in_one_line) {
  const auto unknown = run("shapefile");
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, ErrorCode::usage);
  EXPECT_THAT(to_line(unknown.error()), HasSubstr("csv, netcdf-mask, gpkg, geojson, ply, gltf, vtu, vts, ices, "
                                                  "echoview, lsss, sv, avoidance, seabed, raw-reduced"));
  EXPECT_EQ(run("raw-reduced").error().code, ErrorCode::usage);
  EXPECT_EQ(run("vts").error().code, ErrorCode::usage);
  EXPECT_THAT(to_line(run("ices").error()), HasSubstr("sonarx integrate"));
  fs::remove_all(folder_ / "out");
  EXPECT_EQ(run("csv").error().code, ErrorCode::not_found);
}

TEST_F(Export, sv_of_a_survey_without_a_grid_is_refused) {
  ObservationProduct p = example::empty("obs-0001", 5);
  p.grid.reset();
  p.recipe_json = recipe_text(Recipe{});
  ASSERT_TRUE(write_product(p, folder_ / "single beam" / "products" / "obs-0001.nc"));
  ASSERT_TRUE(write_file(folder_ / "raw" / "a.raw", "of another format, and of no matter here"));
  const ExportOptions options{
      .out = folder_ / "single beam", .format = "sv", .dest = folder_ / "sv", .survey = folder_ / "raw", .reduce = {}};
  const auto refused = export_products(options, work_);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::unsupported);
  EXPECT_THAT(to_line(refused.error()), HasSubstr("raw: no observation has a grid of fans and beams"));
  EXPECT_FALSE(fs::exists(options.dest));
}

TEST_F(Export, nothing_is_written_where_raw_files_lie) {
  const fs::path raw = folder_ / "raw";
  ASSERT_TRUE(write_file(raw / "a file.raw", std::string(12345, 'x')));  // as the product remembers it
  ExportOptions options{.out = folder_ / "out", .format = "csv", .dest = raw, .survey = {}, .reduce = {}};
  const auto copied = export_products(options, work_);
  ASSERT_FALSE(copied);
  EXPECT_EQ(copied.error().code, ErrorCode::usage);
  options.survey = folder_ / "elsewhere";
  options.dest = options.survey / "inside";
  EXPECT_EQ(export_products(options, work_).error().code, ErrorCode::usage);
  options.survey.clear();
  EXPECT_TRUE(export_products(options, work_));
  options.dest = folder_ / "fresh";
  ASSERT_TRUE(write_file(folder_ / "out" / "plan.json", R"({"plan_version":99})"));
  EXPECT_EQ(export_products(options, work_).error().code, ErrorCode::newer_version);
}

/// Corners of a binary mesh.
std::vector<std::array<float, 3>> corners_of(const fs::path& ply) {
  std::ifstream in(ply, std::ios::binary);
  std::size_t count = 0;
  for (std::string line; std::getline(in, line) && line != "end_header";) {
    if (line.starts_with("element vertex ")) count = std::stoul(line.substr(15));
  }
  std::vector<std::array<float, 3>> out(count);
  in.read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(count * sizeof(out[0])));
  return out;
}

// Speed falls by 2 m/s each metre from 1490 at the transducer: with u = artanh of the dip's sine, which changes by 2 a second,
// the level way on an arc is c / (2 cos dip) times the change of tanh u, and the speed is c cosh u0 / cosh u (by hand).
// Products' ranges are counted at 1490 m/s, and the transducer lies 7 m deep.
TEST_F(Export, surfaces_lie_where_sound_comes_from) {
  ObservationProduct p = example::empty("obs-0001", 1);
  example::add_school(p, 1, 0, 0, example::block(1, 1, 2, 20, 8));
  const auto surface = [&](bool bends, double roll_deg) {
    Recipe recipe;
    recipe.survey.sound_speed_profile = {{0.0, 1504.0}, {100.0, 1304.0}};
    recipe.survey.bend_rays = bends;
    recipe.navigation.beams_stabilised = false;
    p.recipe_json = recipe_text(recipe);
    p.pings[0].roll_deg = roll_deg;
    const auto files = export_ply(p, folder_ / (bends ? "bent" : "straight"), work_);
    EXPECT_TRUE(files && files->size() == 1);
    return corners_of(files->at(0));
  };
  const auto straight = surface(false, 0.0);
  const auto bent = surface(true, 0.0);
  ASSERT_GT(straight.size(), 20U);
  ASSERT_EQ(bent.size(), straight.size());
  double most_m = 0.0;
  for (std::size_t i = 0; i < straight.size(); ++i) {
    const double level_m = std::hypot(straight[i][0], straight[i][1]);
    const double down_m = -7.0 - static_cast<double>(straight[i][2]);
    const double range_m = std::hypot(level_m, down_m);
    const double dip = std::asin(down_m / range_m);
    const double u0 = std::atanh(std::sin(dip));
    const double u = u0 + 2.0 * range_m / 1490.0;
    const double arc_level_m = 1490.0 / (2.0 * std::cos(dip)) * (std::tanh(u) - std::tanh(u0));
    const double arc_down_m = (1490.0 - 1490.0 * std::cosh(u0) / std::cosh(u)) / 2.0;
    EXPECT_NEAR(-7.0 - static_cast<double>(bent[i][2]), arc_down_m, 0.05);
    EXPECT_NEAR(std::hypot(bent[i][0], bent[i][1]), arc_level_m, 0.05);
    most_m = std::max(most_m, std::abs(arc_down_m - down_m));
  }
  EXPECT_GT(most_m, 0.7) << "bending is to be seen";
  // Port up by 5 degrees, of beams that are not stabilised: what lies 45 m to port is lifted by 45 sin 5 = 4 m.
  const auto rolled = surface(false, 5.0);
  EXPECT_NEAR(rolled[0][2] - straight[0][2], 45.0 * std::sin(rad_from_deg(5.0)), 0.7);
}

/// Of numbers in brackets, "[lon, lat], [lon, lat] ...", as metres about a place: least and largest x, least and largest y.
std::array<double, 4> box_of(const std::string& geojson, const Geographic& origin) {
  std::array<double, 4> box{1e9, -1e9, 1e9, -1e9};
  std::istringstream in(geojson.substr(geojson.find("\"coordinates\"") + 14));
  for (char c = 0; in.get(c) && c != '}';) {
    if (c != '[' || (in >> std::ws).peek() == '[') continue;
    double lon = 0.0;
    double lat = 0.0;
    in >> lon >> c >> lat;
    const Point<Enu> at = to_enu(Geographic{lat, lon}, origin);
    box = {std::min(box[0], at.x), std::max(box[1], at.x), std::min(box[2], at.y), std::max(box[3], at.y)};
  }
  return box;
}

// Beams of a hull that leans 30 degrees to port, where they look: 15 degrees down become 45. The surface of the school, which
// is turned corner by corner, and its outline on maps lie over the same place.
TEST_F(Export, outlines_on_maps_turn_with_a_ship_that_rolls) {
  ObservationProduct p = example::empty("obs-0001", 1);
  example::add_school(p, 1, 0, 0, example::block(1, 1, 2, 20, 8));
  p.pings[0].roll_deg = -30.0;
  Recipe recipe;
  recipe.navigation.beams_stabilised = false;
  p.recipe_json = recipe_text(recipe);
  ASSERT_TRUE(write_product(p, folder_ / "out" / "products" / "obs-0001.nc"));
  ASSERT_TRUE(run("geojson"));
  const auto ply = run("ply");
  ASSERT_TRUE(ply) << to_line(ply.error());
  std::array<double, 4> surface{1e9, -1e9, 1e9, -1e9};
  for (const auto& [x, y, z] : corners_of(ply->files.at(0))) {
    const double e = static_cast<double>(x);
    const double n = static_cast<double>(y);
    surface = {std::min(surface[0], e), std::max(surface[1], e), std::min(surface[2], n), std::max(surface[3], n)};
  }
  for (const char* layer : {"school_outlines.geojson", "schools.geojson"}) {
    const auto text = read_file(folder_ / "geojson" / layer);
    ASSERT_TRUE(text) << to_line(text.error());
    const auto outline = box_of(*text, p.pings[0].transducer);
    for (std::size_t i = 0; i < outline.size(); ++i) EXPECT_NEAR(outline[i], surface[i], 0.2) << layer << " " << i;
  }
  EXPECT_NEAR(surface[0], -54.0 * std::cos(rad_from_deg(40.0)), 0.1) << "samples 20 .. 27 end at 54 m";
}

}  // namespace
}  // namespace sonar
