// SPDX-License-Identifier: Apache-2.0
#include "view/maps/survey_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <variant>

#include "view/label_room.h"
#include "view/maps/map_example.h"
#include "view/maps/map_items.h"

namespace sonar {
namespace {

constexpr PixelSize kSize{1000, 760};

std::vector<TextItem> texts(const FrameDescription& frame) {
  std::vector<TextItem> out;
  for (const auto& item : frame.items) {
    if (const auto* t = std::get_if<TextItem>(&item)) out.push_back(*t);
  }
  return out;
}

bool says(const FrameDescription& frame, const std::string& words) {
  const auto all = texts(frame);
  return std::any_of(all.begin(), all.end(),
                     [&](const TextItem& t) { return t.text.find(words) != std::string::npos; });
}

/// The map's own; colour bars are images too.
const ImageItem* largest_image(const FrameDescription& frame) {
  const ImageItem* largest = nullptr;
  for (const auto& item : frame.items) {
    const auto* image = std::get_if<ImageItem>(&item);
    if (image == nullptr) continue;
    if (largest == nullptr || image->image->pixels.size() > largest->image->pixels.size()) largest = image;
  }
  return largest;
}

/// Degrees of a label as on charts, by hand: "60°00′20″ N".
double degrees_of(const std::string& label) {
  int deg = 0;
  double minute = 0.0;
  double second = 0.0;
  std::sscanf(label.c_str(), "%d°%lf′%lf″", &deg, &minute, &second);
  const double sign = label.ends_with("S") || label.ends_with("W") ? -1.0 : 1.0;
  return sign * (deg + minute / 60.0 + second / 3600.0);
}

/// Pixels from the graticule's own labels: straight lines between the outermost two.
struct FromLabels {
  double lat0 = 0.0, y0 = 0.0, lat1 = 0.0, y1 = 0.0;
  double lon0 = 0.0, x0 = 0.0, lon1 = 0.0, x1 = 0.0;
  explicit FromLabels(const FrameDescription& frame) {
    std::vector<std::pair<double, double>> lats;
    std::vector<std::pair<double, double>> lons;
    for (const TextItem& t : texts(frame)) {
      const bool degrees = t.text.find("′") != std::string::npos;
      const double deg = degrees_of(t.text);
      if (degrees && t.text.ends_with(" N")) lats.emplace_back(deg, t.at.y);
      if (degrees && (t.text.ends_with(" E") || t.text.ends_with(" W"))) {
        lons.emplace_back(deg < 0.0 ? deg + 360.0 : deg, t.at.x);
      }
    }
    std::sort(lats.begin(), lats.end());
    std::sort(lons.begin(), lons.end());
    EXPECT_GE(lats.size(), 2U);
    EXPECT_GE(lons.size(), 2U);
    if (lats.size() < 2 || lons.size() < 2) return;
    std::tie(lat0, y0) = lats.front();
    std::tie(lat1, y1) = lats.back();
    std::tie(lon0, x0) = lons.front();
    std::tie(lon1, x1) = lons.back();
  }
  [[nodiscard]] PixelPoint at(const Geographic& p) const {
    const double lon = p.longitude_deg < 0.0 ? p.longitude_deg + 360.0 : p.longitude_deg;
    return {x0 + (lon - lon0) / (lon1 - lon0) * (x1 - x0), y0 + (p.latitude_deg - lat0) / (lat1 - lat0) * (y1 - y0)};
  }
};

/// Whether a circle has its centre there.
bool circle_at(const FrameDescription& frame, const PixelPoint& place, double within_px) {
  for (const auto& item : frame.items) {
    const auto* path = std::get_if<PathItem>(&item);
    if (path == nullptr || path->parts.size() != 1 || path->parts[0].points.size() != 32) continue;
    PixelPoint middle;
    for (const PixelPoint& p : path->parts[0].points) middle = {middle.x + p.x / 32.0, middle.y + p.y / 32.0};
    if (std::hypot(middle.x - place.x, middle.y - place.y) < within_px) return true;
  }
  return false;
}

std::vector<ObservationProduct> survey(Geographic start) {
  std::vector<ObservationProduct> all{map_example::product("obs-0001", 60, start),
                                      map_example::product("obs-0002", 60, destination(start, 1500.0, 90.0), 180.0,
                                                           map_example::kStart + 3600 * kSecondNs)};
  map_example::add_school(all[0], 1, destination(all[0].pings[30].transducer, 60.0, 270.0), 30, 31,
                          map_example::block(2, 1, 2, 25, 5));
  return all;
}

TEST(SurveyMap, ASchoolLandsOnItsPixelAlsoOver180Degrees) {
  for (const Geographic start : {Geographic{60.0, 5.0}, Geographic{61.0, 179.99}, Geographic{55.0, -179.995}}) {
    const auto all = survey(start);
    const auto frame = survey_map(all, {}, nullptr, {}, kSize, light_theme(kSize));
    ASSERT_TRUE(frame) << to_line(frame.error());
    const FromLabels from(*frame);
    const SchoolRow& school = all[0].schools[0];
    EXPECT_TRUE(circle_at(*frame, from.at({school.latitude, school.longitude}), 1.5));
    EXPECT_TRUE(circle_at(*frame, from.at(all[0].pings[0].transducer), 1.5));  // the green marker
    EXPECT_FALSE(circle_at(*frame, from.at(destination(start, 700.0, 90.0)), 10.0));
  }
}

TEST(SurveyMap, SaysWhatItIs) {
  const auto all = survey({60.0, 5.0});
  const auto frame = survey_map(all, {}, nullptr, {}, kSize, dark_theme(kSize), "depths.tif: no such depth raster");
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->title, "Fish schools of SYNTHETIC example");
  EXPECT_TRUE(says(*frame, "2 observations, 1 school · 2020-09-13 12:26 \u2013 13:31 UTC"));
  EXPECT_TRUE(says(*frame, "obs-0002"));
  EXPECT_TRUE(says(*frame, "No depth raster: plain sea."));
  EXPECT_TRUE(says(*frame, "no such depth raster"));
  EXPECT_TRUE(says(*frame, "Lambert conformal conic"));  // 1.2 km high, 1.5 km wide, at 60 N
  EXPECT_TRUE(says(*frame, "nmi"));
}

// The map's circles have their school's colour or none: discs of the legend tell the size and have none of their own.
TEST(SurveyMap, TheLegendExplainsCirclesAsTheMapDrawsThem) {
  const auto all = survey({60.0, 5.0});
  const auto frame = survey_map(all, {}, nullptr, {}, kSize, light_theme(kSize));
  ASSERT_TRUE(frame);
  EXPECT_TRUE(says(*frame, "Circles have"));
  EXPECT_TRUE(says(*frame, "seen;"));
  double legend_x = 0.0;
  for (const auto& item : frame->items) {
    const auto* t = std::get_if<TextItem>(&item);
    if (t != nullptr && t->text.ends_with("backscatter")) legend_x = t->at.x;
  }
  ASSERT_GT(legend_x, 0.0);
  int discs = 0;
  for (const auto& item : frame->items) {
    const auto* path = std::get_if<PathItem>(&item);
    if (path == nullptr || path->parts.size() != 1 || path->parts[0].points.size() != 32) continue;
    const PixelPoint p = path->parts[0].points[0];
    if (p.x < legend_x - 60.0 || path->fill == kStartColour) continue;
    EXPECT_EQ(path->fill.a, 0);
    ++discs;
  }
  EXPECT_EQ(discs, 3);
}

// A school at the start itself: the name stands clear of its circle.
TEST(SurveyMap, NamesStandClearOfTheSchoolsAtTheirStarts) {
  auto all = survey({60.0, 5.0});
  all[0].schools[0].latitude = all[0].pings[0].transducer.latitude_deg;
  all[0].schools[0].longitude = all[0].pings[0].transducer.longitude_deg;
  const auto frame = survey_map(all, {}, nullptr, {}, kSize, light_theme(kSize));
  ASSERT_TRUE(frame);
  const PixelPoint start = FromLabels(*frame).at(all[0].pings[0].transducer);
  double radius = 0.0;
  PixelRect name;
  for (const auto& item : frame->items) {
    if (const auto* t = std::get_if<TextItem>(&item); t != nullptr && t->text == "obs-0001")
      name = LabelRoom::box_of(*t);
    const auto* path = std::get_if<PathItem>(&item);
    if (path == nullptr || path->parts.size() != 1 || path->parts[0].points.size() != 32) continue;
    for (const PixelPoint& p : path->parts[0].points) {
      const double away = std::hypot(p.x - start.x, p.y - start.y);
      if (away < 40.0) radius = std::max(radius, away);
    }
  }
  ASSERT_GT(radius, 0.9 * light_theme(kSize).text_px) << "the largest school's circle reaches past the usual place";
  ASSERT_GT(name.width, 0.0);
  EXPECT_TRUE(name.x > start.x + radius - 1.0 || name.x + name.width < start.x - radius + 1.0);
}

// A note either stands there whole or not at all.
TEST(SurveyMap, NotesOfTheLegendAreNotCut) {
  const auto all = survey({60.0, 5.0});
  const std::string note = "This note is long enough to take some lines of a narrow legend and then ends here.";
  int whole = 0;
  int none = 0;
  for (int height = 240; height <= 500; height += 10) {
    const PixelSize size{320, height};
    const auto frame = survey_map(all, {}, nullptr, {}, size, light_theme(size), note);
    ASSERT_TRUE(frame);
    EXPECT_EQ(says(*frame, "This note"), says(*frame, "ends here.") || says(*frame, "here.")) << height;
    ++(says(*frame, "This note") ? whole : none);
  }
  EXPECT_GT(whole, 0);
  EXPECT_GT(none, 0);
}

TEST(SurveyMap, DepthsAreColouredAndSaidWhereFrom) {
  const auto all = survey({60.0, 5.0});
  DepthGrid grid{59.9, 4.8, 0.005, 0.005,
                 60,   100, {},    "sea.nc, elevation: elevation, negative down (told by its name)"};
  for (int r = 0; r < grid.rows; ++r) {
    for (int c = 0; c < grid.columns; ++c) grid.depth_m.push_back(static_cast<float>(100.0 + 2.0 * c));
  }
  const auto frame = survey_map(all, {}, &grid, {}, kSize, light_theme(kSize));
  ASSERT_TRUE(frame);
  EXPECT_TRUE(says(*frame, "depth (m)"));
  EXPECT_TRUE(says(*frame, "sea.nc"));
  const ImageItem* image = largest_image(*frame);
  ASSERT_NE(image, nullptr);
  // Deeper to the east: another colour, and the same colour all the way north.
  const PixelSize s = image->image->size;
  EXPECT_NE(image->image->at(5, s.height / 2), image->image->at(s.width - 5, s.height / 2));
  EXPECT_EQ(image->image->at(s.width / 4, 5).a, 255);
}

TEST(SurveyMap, ARasterOfTheShownExtentColoursEveryPixel) {
  const auto all = survey({60.0, 5.0});
  const auto extent = survey_map_extent(all, {}, {}, kSize, light_theme(kSize));
  ASSERT_TRUE(extent);
  constexpr int kNodes = 21;
  DepthGrid grid;
  grid.south_deg = extent->south_deg;
  grid.west_deg = extent->west_deg;
  grid.step_latitude_deg = (extent->north_deg - extent->south_deg) / (kNodes - 1);
  grid.step_longitude_deg = (extent->east_deg - extent->west_deg) / (kNodes - 1);
  grid.rows = grid.columns = kNodes;
  for (int i = 0; i < kNodes * kNodes; ++i) grid.depth_m.push_back(static_cast<float>(100 + i % kNodes));
  grid.source = "sea.tif, elevation: elevation, negative down (told by its name)";
  const auto frame = survey_map(all, {}, &grid, {}, kSize, light_theme(kSize));
  ASSERT_TRUE(frame);
  EXPECT_FALSE(says(*frame, "Plain where"));
  EXPECT_TRUE(says(*frame, "Depths: sea.tif"));
  EXPECT_FALSE(says(*frame, "told by"));
  const ImageItem* image = largest_image(*frame);
  ASSERT_NE(image, nullptr);
  EXPECT_TRUE(
      std::all_of(image->image->pixels.begin(), image->image->pixels.end(), [](const Rgba8& p) { return p.a == 255; }));
}

TEST(SurveyMap, NamesStandInsideTheMap) {
  for (const double course : {90.0, 270.0}) {
    const std::vector<ObservationProduct> one{
        map_example::product("a-long-name-of-an-observation", 60, {60.0, 5.0}, course)};
    const auto frame = survey_map(one, {}, nullptr, {}, kSize, light_theme(kSize));
    ASSERT_TRUE(frame);
    const PixelRect map = std::get<ClipItem>(*std::find_if(frame->items.begin(), frame->items.end(), [](const auto& i) {
                            return std::holds_alternative<ClipItem>(i);
                          })).place;
    bool seen = false;
    for (const TextItem& t : texts(*frame)) {
      if (t.text != one[0].observation) continue;
      seen = true;
      const double width = text_width_px(t.text.c_str(), t.size_px);
      const double left = t.anchor == TextAnchor::right ? t.at.x - width : t.at.x;
      EXPECT_GE(left, map.x);
      EXPECT_LE(left + width, map.x + map.width);
    }
    EXPECT_TRUE(seen);
  }
}

TEST(SurveyMap, ThatNobodyLookedForSchoolsIsSaid) {
  const std::vector<ObservationProduct> all{map_example::product("obs-0001", 60),
                                            map_example::product("obs-0002", 60, {60.1, 5.0})};
  SurveyMapStyle style;
  const auto second = [&](int unsearched) {
    style.unsearched = unsearched;
    return survey_map(all, {}, nullptr, style, kSize, light_theme(kSize));
  };
  EXPECT_TRUE(says(*second(0), "2 observations, 0 schools ·"));
  EXPECT_TRUE(says(*second(1), "0 schools (not detected in 1 of them)"));
  EXPECT_TRUE(says(*second(2), "2 observations, schools not detected ·"));
}

// Markers on each other share a number text; one apart has its own.
TEST(SurveyMap, SchoolsHaveTheirNumbers) {
  auto all = survey({60.0, 5.0});
  const Geographic near = destination(all[0].pings[30].transducer, 62.0, 270.0);
  for (const int id : {2, 3, 5}) map_example::add_school(all[0], id, near, 30, 31, map_example::block(2, 1, 2, 25, 5));
  map_example::add_school(all[0], 9, destination(near, 150.0, 90.0), 30, 31, map_example::block(2, 1, 2, 25, 5));
  const auto frame = survey_map(all, {}, nullptr, {}, kSize, light_theme(kSize));
  ASSERT_TRUE(frame);
  EXPECT_TRUE(says(*frame, "4 schools"));
  const auto words = texts(*frame);
  EXPECT_EQ(std::count_if(words.begin(), words.end(), [](const TextItem& t) { return t.text == "9"; }), 1);
}

TEST(SurveyMap, AShipNeverHidesASchool) {
  auto all = survey({60.0, 5.0});
  map_example::add_school(all[1], 1, all[1].pings.back().transducer, 30, 31, map_example::block(2, 1, 2, 25, 5));
  const Theme theme = light_theme(kSize);
  const auto frame = survey_map(all, {}, nullptr, {}, kSize, theme);
  ASSERT_TRUE(frame);
  std::ptrdiff_t ship = -1;
  std::ptrdiff_t last_circle = -1;
  for (std::size_t i = 0; i < frame->items.size(); ++i) {
    const auto* path = std::get_if<PathItem>(&frame->items[i]);
    if (path == nullptr || path->parts.empty()) continue;
    // The legend shows a ship, too, after the map's.
    if (path->fill == theme.ship && ship < 0) ship = static_cast<std::ptrdiff_t>(i);
    if (path->parts[0].points.size() == 32 && path->fill.a == 215) last_circle = static_cast<std::ptrdiff_t>(i);
  }
  ASSERT_GE(ship, 0);
  EXPECT_GT(last_circle, ship);
}

// A hole of a pixel or two between footprints is no hole on a map; the area itself stays.
TEST(SurveyMap, TheSearchVolumesEdgeIsNotPerforated) {
  const auto all = survey({60.0, 5.0});
  ObservationOutlines o;
  o.observation = "obs-0001";
  const Geographic corner = all[0].pings[0].transducer;
  const auto square = [&](double east_m, double size_m) {
    std::vector<Geographic> ring;
    for (const auto& [x, y] : {std::pair(0.0, 0.0), {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) {
      ring.push_back(to_geographic(Point<Enu>{east_m + x * size_m, 100.0 + y * size_m, 0.0}, corner));
    }
    return ring;
  };
  o.swept.rings = {square(-400.0, 400.0), square(-300.0, 3.0), square(-200.0, 5.0)};
  const auto frame = survey_map(all, std::span(&o, 1), nullptr, {}, kSize, light_theme(kSize));
  ASSERT_TRUE(frame);
  const auto swept = std::find_if(frame->items.begin(), frame->items.end(), [](const auto& item) {
    const auto* path = std::get_if<PathItem>(&item);
    return path != nullptr && path->fill == Rgba8{110, 110, 110, 95};
  });
  ASSERT_NE(swept, frame->items.end());
  EXPECT_EQ(std::get<PathItem>(*swept).parts.size(), 1U);
}

TEST(SurveyMap, RejectedSchoolsAreLeftOutUnlessAskedFor) {
  auto all = survey({60.0, 5.0});
  all[0].schools[0].status = "rejected";
  SurveyMapStyle style;
  auto frame = survey_map(all, {}, nullptr, style, kSize, light_theme(kSize));
  ASSERT_TRUE(frame);
  EXPECT_TRUE(says(*frame, "0 schools"));
  style.rejected = true;
  style.colouring = SchoolColouring::status;
  frame = survey_map(all, {}, nullptr, style, kSize, light_theme(kSize));
  ASSERT_TRUE(frame);
  EXPECT_TRUE(says(*frame, "rejected"));
}

TEST(SurveyMap, RefusesInOneLine) {
  auto all = survey({60.0, 5.0});
  const auto small = survey_map(all, {}, nullptr, {}, {200, 100}, light_theme({200, 100}));
  ASSERT_FALSE(small);
  EXPECT_EQ(small.error().text, "a picture of 200 x 100 pixels is too small for a survey map");
  for (auto& p : all) {
    for (auto& n : p.pings) n.transducer.latitude_deg = std::nan("");
  }
  const auto nowhere = survey_map(all, {}, nullptr, {}, kSize, light_theme(kSize));
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().code, ErrorCode::not_found);
}

TEST(MapItems, TitlesTellWhatIsSynthetic) {
  std::vector<ObservationProduct> two(2);
  two[0].observation = "obs-0001";
  two[0].title = "Herring obs-0001";
  two[1].observation = "obs-0002";
  two[1].title = "Herring obs-0002";
  EXPECT_EQ(survey_title(two), "Herring");
  two[1].title = "SYNTHETIC obs-0002";
  EXPECT_EQ(survey_title(two), "SYNTHETIC: Herring and others");
}

TEST(MapItems, TitlesOfSurveysWithoutAName) {
  ObservationProduct p;
  p.observation = "obs-0001";
  p.title = "Fish schools of  obs-0001";
  EXPECT_EQ(survey_title(std::span(&p, 1)), "Fish schools");
  EXPECT_EQ(observation_title(p), "obs-0001");
  p.title = "Fish schools of Herring 2009 obs-0001";
  EXPECT_EQ(observation_title(p), "obs-0001 of Herring 2009");
}

TEST(MapItems, TracksBreakWherePositionsAreUnknown) {
  auto p = map_example::product("obs-0001", 30);
  p.pings[12].transducer.latitude_deg = std::nan("");
  const MapFrame map = fit_map({60.0, 60.01, 4.99, 5.01}, {0.0, 0.0, 600.0, 600.0});
  EXPECT_EQ(track_item(map, p.pings, {}).parts.size(), 2U);
}

}  // namespace
}  // namespace sonar
