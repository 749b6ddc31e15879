// SPDX-License-Identifier: Apache-2.0
#include "io/survey_layers.h"

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <numbers>

#include "base/test_full_disk.h"
#include "base/units.h"
#include "geo/refraction.h"
#include "io/atomic_file.h"
#include "io/product_example.h"
#include "io/table_columns.h"
#include "model/outline.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

class Map : public testing::Test {
 protected:
  Map() : folder_(fs::temp_directory_path() / ("sonar_map_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
    GDALAllRegister();
  }
  ~Map() override { fs::remove_all(folder_); }
  Map(const Map&) = delete;
  Map& operator=(const Map&) = delete;

  static ObservationProduct sample(Geographic start = {60.0, 5.0}) {
    ObservationProduct p = example::empty("obs-0001", 10, start);
    example::add_school(p, 1, 2, 5, example::block(2, 1, 2, 20, 10));
    // Two pieces with a beam between them.
    PingMask two = example::block(1, 0, 1, 30, 4);
    const PingMask other = example::block(1, 2, 1, 40, 4);
    two.runs.insert(two.runs.end(), other.runs.begin(), other.runs.end());
    two.confidence.insert(two.confidence.end(), other.confidence.begin(), other.confidence.end());
    example::add_school(p, 2, 6, 6, two);
    return p;
  }

  [[nodiscard]] fs::path write(const ObservationProduct& p, const std::string& name,
                               MapFormat format = MapFormat::geopackage) const {
    auto writer = SurveyMapWriter::create(folder_ / name, format, {&p, 1});
    EXPECT_TRUE(writer);
    EXPECT_TRUE(writer->add(p));
    EXPECT_TRUE(writer->finish());
    return folder_ / name;
  }

  using Dataset = std::unique_ptr<GDALDataset, decltype([](GDALDataset* d) { GDALClose(d); })>;
  static Dataset open(const fs::path& path) {
    return Dataset(static_cast<GDALDataset*>(GDALOpenEx(path.c_str(), GDAL_OF_VECTOR, nullptr, nullptr, nullptr)));
  }

  fs::path folder_;
};

OGRFeatureUniquePtr first_of(OGRLayer* layer) {
  layer->ResetReading();
  return OGRFeatureUniquePtr(layer->GetNextFeature());
}

/// Area of a small figure in degrees at 60 N, by the lengths of a degree there (WGS 84: 111412.9 and 55800.0 m).
double square_metres(const OGRGeometry* g) {
  const OGRwkbGeometryType type = wkbFlatten(g->getGeometryType());
  const double deg2 = type == wkbPolygon ? g->toPolygon()->get_Area() : g->toMultiPolygon()->get_Area();
  return deg2 * 111412.9 * 55800.0;
}

TEST_F(Map, layers_types_and_counts) {
  const auto data = open(write(sample(), "survey.gpkg"));
  ASSERT_TRUE(data);
  const std::vector<std::tuple<const char*, OGRwkbGeometryType, int>> wanted = {
      {"vessel_track", wkbLineString, 1},  {"observations", wkbPolygon, 1}, {"swept", wkbMultiPolygon, 1},
      {"observation_starts", wkbPoint, 1}, {"schools", wkbMultiPolygon, 2}, {"school_outlines", wkbPolygon, 5},
      {"school_centres", wkbPoint, 5}};
  EXPECT_EQ(data->GetLayerCount(), 8) << "the styles are a table too";
  for (const auto& [name, type, count] : wanted) {
    OGRLayer* layer = data->GetLayerByName(name);
    ASSERT_NE(layer, nullptr) << name;
    EXPECT_EQ(layer->GetGeomType(), type) << name;
    EXPECT_EQ(layer->GetFeatureCount(), count) << name;
    EXPECT_STREQ(layer->GetSpatialRef()->GetAuthorityCode(nullptr), "4326");
    for (const auto& feature : *layer) {
      ASSERT_NE(feature->GetGeometryRef(), nullptr) << name;
      EXPECT_EQ(feature->GetGeometryRef()->getGeometryType(), type) << name;
      EXPECT_TRUE(feature->GetGeometryRef()->IsValid()) << name;
    }
  }
  OGRLayer* schools = data->GetLayerByName("schools");
  EXPECT_EQ(schools->GetLayerDefn()->GetFieldCount(), std::ssize(columns_of(std::vector<SchoolRow>{})));
  const auto first = first_of(schools);
  EXPECT_EQ(first->GetFieldAsInteger64("school_id"), 1);
  EXPECT_EQ(first->GetFieldAsDouble("sv_mean_db"), -45.0);
  EXPECT_FALSE(first->IsFieldSetAndNotNull(schools->GetLayerDefn()->GetFieldIndex("speed_mps")));
  EXPECT_STREQ(first->GetFieldAsString("first_time_utc"), "2023/11/14 22:13:24.123+00");
}

TEST_F(Map, areas_worked_by_hand) {
  const auto data = open(write(sample(), "survey.gpkg"));
  // The sector looks from 260 to 280 degrees. Fan 1 reaches farthest from above: 118 m under 10 degrees (fan 2 has two
  // samples less). Nine steps of 6 m north; the sweep leaves out the triangles between the pings' places.
  const double reach = 118.0 * std::cos(rad_from_deg(10.0));
  const double sector = 0.5 * reach * reach * rad_from_deg(20.0);
  const double triangles = 9 * 3.0 * 3.0 * std::tan(rad_from_deg(80.0));
  const double swept = square_metres(first_of(data->GetLayerByName("swept"))->GetGeometryRef());
  const double hull = square_metres(first_of(data->GetLayerByName("observations"))->GetGeometryRef());
  EXPECT_NEAR(hull, sector + 9 * 6.0 * reach, 0.001 * hull);
  EXPECT_NEAR(swept, hull - triangles, 0.001 * hull);
  // Fan 2 spans -10 to 0 degrees, samples 20 to 29 lie in 38 to 58 m: from above 38 cos(10) to 58 m, over 10 degrees.
  const double near = 38.0 * std::cos(rad_from_deg(10.0));
  const double block = 0.5 * (58.0 * 58.0 - near * near) * rad_from_deg(10.0);
  const auto outline = first_of(data->GetLayerByName("school_outlines"));
  EXPECT_NEAR(square_metres(outline->GetGeometryRef()), block, 0.005 * block);
  OGREnvelope box;
  outline->GetGeometryRef()->getEnvelope(&box);
  // Ping 2 is 12 m north; the block's beams lie between 265 and 275 degrees.
  EXPECT_NEAR((box.MinX - 5.0) * 55800.0, -58.0, 0.1);
  EXPECT_NEAR((box.MaxY - 60.0) * 111412.9, 12.0 + 58.0 * std::sin(rad_from_deg(5.0)), 0.1);
}

TEST_F(Map, equal_products_give_equal_bytes) {
  const auto a = read_file(write(sample(), "a.gpkg"));
  const auto b = read_file(write(sample(), "b.gpkg"));
  ASSERT_TRUE(a && b);
  EXPECT_EQ(*a, *b);
}

/// Every feature's geometry of a layer, one by one.
template <class F>
void each_geometry(OGRLayer* layer, const F& f) {
  for (const auto& feature : *layer) {
    if (feature->GetGeometryRef() != nullptr) f(*feature->GetGeometryRef());
  }
}

const std::vector<const char*> kLayers = {"vessel_track", "observations",    "swept",         "observation_starts",
                                          "schools",      "school_outlines", "school_centres"};

// Law: a survey at the date line is the same survey as elsewhere, in as many features and of the same areas; where it
// crosses the line, its parts end there.
TEST_F(Map, is_cut_where_it_crosses_the_date_line) {
  const auto elsewhere = open(write(sample(), "elsewhere.gpkg"));
  for (const double longitude : {-179.9995, -179.9999, 179.9999}) {
    // Ten pings to the north; the sonar looks 118 m to the west, over the line from the first two places.
    ObservationProduct p = sample({60.0, longitude});
    // The ship's way crosses as well.
    p.pings.back().transducer.longitude_deg = longitude > 0 ? -179.9999 : 179.9999;
    const auto data = open(write(p, "survey.gpkg"));
    const fs::path json = write(p, "json", MapFormat::geojson);
    for (const char* name : kLayers) {
      const auto as_json = open(json / (std::string(name) + ".geojson"));
      OGRLayer* layer = data->GetLayerByName(name);
      EXPECT_EQ(layer->GetFeatureCount(), elsewhere->GetLayerByName(name)->GetFeatureCount()) << name;
      const OGRwkbGeometryType declared = layer->GetGeomType();
      const auto inside = [&](const OGRGeometry& g) {
        OGREnvelope box;
        g.getEnvelope(&box);
        EXPECT_GE(box.MinX, -180.0) << name;
        EXPECT_LE(box.MaxX, 180.0) << name;
        EXPECT_TRUE(g.IsValid()) << name;
        if (OGR_GT_IsSubClassOf(g.getGeometryType(), wkbGeometryCollection) == 0) return;
        for (const OGRGeometry* part : *g.toGeometryCollection()) {
          part->getEnvelope(&box);
          EXPECT_LT(box.MaxX - box.MinX, 0.01) << name;
        }
      };
      each_geometry(layer, [&](const OGRGeometry& g) {
        inside(g);
        EXPECT_TRUE(declared == wkbUnknown || declared == g.getGeometryType()) << name;
      });
      each_geometry(as_json->GetLayer(0), inside);
    }
    const auto track = first_of(data->GetLayerByName("vessel_track"));
    EXPECT_EQ(track->GetGeometryRef()->getGeometryType(), wkbMultiLineString);
  }
  const auto data = open(write(sample({60.0, -179.9995}), "survey.gpkg"));
  for (const char* name : {"observations", "schools", "school_outlines"}) {
    EXPECT_NEAR(square_metres(first_of(data->GetLayerByName(name))->GetGeometryRef()),
                square_metres(first_of(elsewhere->GetLayerByName(name))->GetGeometryRef()), 0.5)
        << name;
  }
  EXPECT_EQ(first_of(data->GetLayerByName("observations"))->GetGeometryRef()->getGeometryType(), wkbMultiPolygon);
  // The ship itself stays on one side, and away from the line nothing is cut.
  EXPECT_EQ(first_of(data->GetLayerByName("vessel_track"))->GetGeometryRef()->getGeometryType(), wkbLineString);
  const auto away = open(write(sample({60.0, -179.99}), "away.gpkg"));
  EXPECT_EQ(first_of(away->GetLayerByName("observations"))->GetGeometryRef()->getGeometryType(), wkbPolygon);
}

TEST_F(Map, schools_without_place_keep_their_row) {
  ObservationProduct p = sample();
  for (PingNavigation& ping : p.pings) ping.transducer = PingNavigation{}.transducer;
  for (SchoolPingRow& row : p.school_pings) row.latitude = kUnknown;
  const auto data = open(write(p, "survey.gpkg"));
  EXPECT_EQ(data->GetLayerByName("schools")->GetFeatureCount(), 2);
  EXPECT_EQ(first_of(data->GetLayerByName("schools"))->GetGeometryRef(), nullptr);
  ObservationProduct none = example::empty("obs-0001", 2);
  none.grid.reset();
  EXPECT_EQ(open(write(none, "none.gpkg"))->GetLayerByName("vessel_track")->GetFeatureCount(), 1);
}

TEST_F(Map, geojson_has_a_file_for_each_layer) {
  const fs::path folder = write(sample(), "geojson", MapFormat::geojson);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator{}), 7);
  const auto data = open(folder / "schools.geojson");
  ASSERT_TRUE(data);
  EXPECT_EQ(data->GetLayer(0)->GetFeatureCount(), 2);
  EXPECT_EQ(first_of(data->GetLayer(0))->GetFieldAsString("first_time_utc"), std::string("2023/11/14 22:13:24.123+00"));
}

/// RFC 7946: longitudes and latitudes of WGS 84 without saying so, and rings to the right hand.
TEST_F(Map, geojson_keeps_to_its_standard) {
  const fs::path folder = write(sample(), "geojson", MapFormat::geojson);
  int rings = 0;
  for (const char* name : kLayers) {
    const fs::path file = folder / (std::string(name) + ".geojson");
    EXPECT_EQ(read_file(file)->find("\"crs\""), std::string::npos) << name;
    const auto data = open(file);
    ASSERT_TRUE(data) << name;
    for (const auto& feature : *data->GetLayer(0)) {
      const OGRGeometry* geometry = feature->GetGeometryRef();
      if (geometry == nullptr || wkbFlatten(geometry->getGeometryType()) != wkbPolygon) continue;
      bool exterior = true;
      for (const OGRLinearRing* ring : *geometry->toPolygon()) {
        EXPECT_EQ(ring->isClockwise() == 0, exterior) << name;
        exterior = false;
        ++rings;
      }
    }
  }
  EXPECT_GT(rings, 3);
}

TEST_F(Map, geojson_says_null_and_iso_times) {
  ObservationProduct p = sample();
  p.schools[0].comment = "a \"b\"\\\n";
  p.schools[0].first_time_utc = 1'578'470'400'350'000'000;  // 2020-01-08 08:00:00.350
  p.schools[1].first_time_utc = 0;
  const fs::path folder = write(p, "geojson", MapFormat::geojson);
  const std::string schools = *read_file(folder / "schools.geojson");
  EXPECT_NE(schools.find(R"("first_time_utc": "2020-01-08T08:00:00.350Z")"), std::string::npos) << schools;
  EXPECT_NE(schools.find(R"("first_time_utc": null)"), std::string::npos) << schools;
  EXPECT_NE(schools.find(R"("speed_mps": null)"), std::string::npos) << schools;
  EXPECT_NE(schools.find(R"("comment": "a \"b\"\\\u000a")"), std::string::npos) << schools;
  // Every feature has every property, and another program reads the same from it.
  for (const char* name : kLayers) {
    const std::string text = *read_file(folder / (std::string(name) + ".geojson"));
    std::size_t features = 0;
    std::size_t named = 0;
    for (std::size_t at = text.find("\"Feature\""); at != std::string::npos; at = text.find("\"Feature\"", at + 1)) {
      ++features;
    }
    for (std::size_t at = text.find("\"observation\":"); at != std::string::npos;
         at = text.find("\"observation\":", at + 1)) {
      ++named;
    }
    EXPECT_EQ(named, features) << name;
    const auto data = open(folder / (std::string(name) + ".geojson"));
    ASSERT_TRUE(data) << name;
    EXPECT_EQ(static_cast<std::size_t>(data->GetLayer(0)->GetFeatureCount()), features) << name;
  }
  const auto packed = open(write(p, "survey.gpkg"));
  OGRLayer* layer = packed->GetLayerByName("schools");
  const int time = layer->GetLayerDefn()->GetFieldIndex("first_time_utc");
  EXPECT_EQ(layer->GetLayerDefn()->GetFieldDefn(time)->GetType(), OFTDateTime);
  const auto first = first_of(layer);
  EXPECT_STREQ(first->GetFieldAsString(time), "2020/01/08 08:00:00.350+00");
  const OGRFeatureUniquePtr second(layer->GetNextFeature());
  EXPECT_FALSE(second->IsFieldSetAndNotNull(time));
}

// Whatever part of the files the disk has no room for: one line, the old files stay, nothing else lies there.
TEST_F(Map, a_full_disk_leaves_the_files_that_were_there) {
  for (const MapFormat format : {MapFormat::geojson, MapFormat::geopackage}) {
    const std::string name = format == MapFormat::geojson ? "geojson" : "survey.gpkg";
    ObservationProduct p = sample();
    const fs::path target = write(p, name, format);
    const auto contents = [&] {
      std::map<fs::path, std::string> files;
      for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
        if (entry.is_regular_file()) files[entry.path()] = *read_file(entry.path());
      }
      return files;
    };
    const auto before = contents();
    std::size_t largest = 0;
    for (const auto& [path, text] : before) largest = std::max(largest, text.size());
    p.observation = "obs-0002";
    for (std::size_t room = 0; room < largest; room += largest / 17) {
      const auto written = [&]() -> Result<void> {
        const FullDisk disk(room);
        auto writer = SurveyMapWriter::create(target, format, {&p, 1});
        if (!writer) return pass_on(writer);
        if (auto added = writer->add(p); !added) return added;
        return writer->finish();
      }();
      ASSERT_FALSE(written) << name << " " << room;
      EXPECT_EQ(to_line(written.error()).find('\n'), std::string::npos);
      EXPECT_TRUE(contents() == before) << name << " " << room;
    }
    fs::remove_all(target);
  }
}

TEST_F(Map, nothing_appears_before_finish) {
  const ObservationProduct p = sample();
  {
    auto writer = SurveyMapWriter::create(folder_ / "survey.gpkg", MapFormat::geopackage, {&p, 1});
    ASSERT_TRUE(writer);
    ASSERT_TRUE(writer->add(p));
  }
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST(Outline, beam_of_several_fans_is_one_ring) {
  const GridRecord record = example::grid();
  const Sector sector = record.grid.sector(record.range);
  PingMask mask = example::block(0, 1, 1, 20, 10);
  const PingMask above = example::block(1, 1, 1, 20, 10);
  mask.runs.insert(mask.runs.end(), above.runs.begin(), above.runs.end());
  EXPECT_EQ(mask_rings(sector, mask, Placement{}).size(), 1U);
  EXPECT_TRUE(mask_rings(sector, PingMask{}, Placement{}).empty());
}

// Speed falls by 2 m/s each metre from 1490 m/s at the transducer: with u = artanh of the dip's sine, which changes by 2 a
// second, the level way on an arc is c / (2 cos dip) times the change of tanh u. The fan reaches from 10 to 20 degrees down,
// samples 20 to 29 from 38 to 58 m.
TEST(Outline, lies_where_sound_comes_from) {
  const GridRecord record = example::grid();
  const Sector sector = record.grid.sector(record.range);
  const auto rays =
      std::make_shared<const Refraction>(SoundProfile{{0.0, 1504.0}, {100.0, 1304.0}}, 7.0, 1490.0, 120.0);
  double near_m = 1e9;
  double far_m = 0.0;
  for (const double dip_deg : {10.0, 20.0}) {
    for (const double range_m : {38.0, 58.0}) {
      const double u = std::atanh(std::sin(rad_from_deg(dip_deg)));
      const double then = u + 2.0 * range_m / 1490.0;
      const double level_m = 1490.0 / (2.0 * std::cos(rad_from_deg(dip_deg))) * (std::tanh(then) - std::tanh(u));
      near_m = std::min(near_m, level_m);
      far_m = std::max(far_m, level_m);
    }
  }
  const auto reach = [&](const std::shared_ptr<const Refraction>& along) {
    Placement placement;
    placement.heading_rad = 0.3;
    placement.rays = along;
    const std::vector<Ring> rings = mask_rings(sector, example::block(1, 1, 1, 20, 10), placement);
    EXPECT_EQ(rings.size(), 1U);
    std::pair<double, double> out{1e9, 0.0};
    for (const PlanePoint& p : rings.at(0)) {
      out.first = std::min(out.first, std::hypot(p.x, p.y));
      out.second = std::max(out.second, std::hypot(p.x, p.y));
    }
    return out;
  };
  EXPECT_NEAR(reach(rays).first, near_m, 0.05);
  EXPECT_NEAR(reach(rays).second, far_m, 0.05);
  EXPECT_NEAR(reach(nullptr).first, 38.0 * std::cos(rad_from_deg(20.0)), 1e-6);
  EXPECT_NEAR(reach(nullptr).second, 58.0 * std::cos(rad_from_deg(10.0)), 1e-6);
  EXPECT_GT(std::abs(reach(rays).second - reach(nullptr).second), 0.2) << "bending is to be seen";
}

TEST(Outline, plane_shift_agrees_with_the_geodesic) {
  const Geographic origin{70.0, 20.0};
  const Geographic ping = destination(origin, 5000.0, 80.0);
  const PlanePoint p{-300.0, 200.0};
  const PlanePoint shifted = PlaneShift(ping, origin).apply(p);
  const Point<Enu> exact = to_enu(to_geographic({p.x, p.y, 0.0}, ping), origin);
  EXPECT_NEAR(shifted.x, exact.x, 0.002);
  EXPECT_NEAR(shifted.y, exact.y, 0.002);
}

}  // namespace
}  // namespace sonar
