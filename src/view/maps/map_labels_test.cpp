// SPDX-License-Identifier: Apache-2.0
// What stands written on maps, strips and timelines: beside what it names, and on nothing else.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "view/label_room.h"
#include "view/maps/map_example.h"
#include "view/maps/map_items.h"
#include "view/maps/observation_map.h"
#include "view/maps/survey_map.h"
#include "view/school_labels.h"
#include "view/timelines/timeline.h"
#include "view/volume/propagation_view.h"

namespace sonar {
namespace {

using map_example::says;

constexpr PixelSize kSize{1000, 760};
constexpr PixelSize kSmall{400, 300};

const TextItem* text_of(const FrameDescription& frame, const std::string& words) {
  for (const auto& item : frame.items) {
    if (const auto* t = std::get_if<TextItem>(&item); t != nullptr && t->text == words) return t;
  }
  return nullptr;
}

bool overlap(const PixelRect& a, const PixelRect& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

/// From a place to the nearest point of a rectangle.
double away(const PixelRect& r, PixelPoint p) {
  return std::hypot(p.x - std::clamp(p.x, r.x, r.x + r.width), p.y - std::clamp(p.y, r.y, r.y + r.height));
}

struct Circle {
  PixelPoint at;
  double radius_px = 0.0;
};

/// Markers of starts and of schools, drawn as polygons of 32 corners.
std::vector<Circle> circles(const FrameDescription& frame, double right_px) {
  std::vector<Circle> out;
  for (const auto& item : frame.items) {
    const auto* path = std::get_if<PathItem>(&item);
    if (path == nullptr || path->parts.size() != 1 || path->parts[0].points.size() != 32) continue;
    Circle c;
    for (const PixelPoint& p : path->parts[0].points) c.at = {c.at.x + p.x / 32.0, c.at.y + p.y / 32.0};
    const PixelPoint& edge = path->parts[0].points[0];
    c.radius_px = std::hypot(edge.x - c.at.x, edge.y - c.at.y);
    if (c.at.x < right_px) out.push_back(c);
  }
  return out;
}

PixelRect map_of(const FrameDescription& frame) {
  return std::get<ClipItem>(*std::find_if(frame.items.begin(), frame.items.end(),
                                          [](const auto& i) { return std::holds_alternative<ClipItem>(i); }))
      .place;
}

// Four observations start within 150 m of each other, with another one's schools round about: on a small map every name
// is there, and none is written over a circle, a start, or another label.
TEST(MapLabels, ObservationsNamesLieOnNothing) {
  std::vector<ObservationProduct> all;
  for (int i = 0; i < 4; ++i) {
    const Geographic start = destination({60.0, 5.0}, 50.0 * i, 80.0);
    all.push_back(map_example::product("obs-000" + std::to_string(i + 1), 60, start, 90.0 * i,
                                       map_example::kStart + 3600 * kSecondNs * i));
  }
  for (int id = 1; id <= 3; ++id) {
    map_example::add_school(all[3], id, destination({60.0, 5.0}, 110.0 * id, 90.0), 30, 31,
                            map_example::block(2, 1, 2, 25, 5));
  }
  for (const PixelSize size : {kSmall, kSize}) {
    const auto frame = survey_map(all, {}, nullptr, {}, size, light_theme(size));
    ASSERT_TRUE(frame);
    const PixelRect map = map_of(*frame);
    const auto markers = circles(*frame, map.x + map.width);
    ASSERT_EQ(markers.size(), 7U);
    std::vector<PixelRect> boxes;
    for (const ObservationProduct& product : all) {
      const TextItem* name = text_of(*frame, product.observation);
      ASSERT_NE(name, nullptr) << product.observation;
      const PixelRect box = LabelRoom::box_of(*name);
      for (const Circle& c : markers) EXPECT_GE(away(box, c.at), 0.95 * c.radius_px) << product.observation;
      boxes.push_back(box);
    }
    for (int id = 1; id <= 3; ++id) {
      if (const TextItem* number = text_of(*frame, std::to_string(id))) boxes.push_back(LabelRoom::box_of(*number));
    }
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(overlap(boxes[i], boxes[j])) << i << ' ' << j;
    }
  }
}

// Fifty observations that start at one place: those without room are told of in the legend.
TEST(MapLabels, NamesWithoutRoomAreToldOf) {
  std::vector<ObservationProduct> all;
  for (int i = 0; i < 50; ++i) all.push_back(map_example::product("observation-" + std::to_string(100 + i), 20));
  const auto frame = survey_map(all, {}, nullptr, {}, kSize, light_theme(kSize));
  ASSERT_TRUE(frame);
  EXPECT_TRUE(says(*frame, "names left out: "));
}

TEST(MapLabels, SchoolsHaveTheNamesThatTheyWereGiven) {
  ObservationProduct p = map_example::product("obs-0001", 60);
  const Geographic near = destination(p.pings[30].transducer, 60.0, 270.0);
  map_example::add_school(p, 3, near, 30, 31, map_example::block(2, 1, 2, 25, 5));
  map_example::add_school(p, 4, destination(near, 300.0, 0.0), 40, 41, map_example::block(2, 1, 2, 25, 5));
  p.schools[0].name = "Storsild";
  for (auto& row : p.school_pings) {
    row.latitude = p.schools[row.school_id == 3 ? 0 : 1].latitude;
    row.longitude = p.schools[row.school_id == 3 ? 0 : 1].longitude;
  }
  const std::vector<ObservationProduct> all{p};
  const auto survey = survey_map(all, {}, nullptr, {}, kSize, light_theme(kSize));
  ASSERT_TRUE(survey);
  EXPECT_NE(text_of(*survey, "3 Storsild"), nullptr);
  EXPECT_NE(text_of(*survey, "4"), nullptr);
  const auto base = observation_map_base(p, kSize, light_theme(kSize));
  ASSERT_TRUE(base);
  FrameDescription frame;
  add_map_schools(frame, *base, map_schools(p));
  EXPECT_NE(text_of(frame, "3 Storsild"), nullptr);
  EXPECT_NE(text_of(frame, "4"), nullptr);
}

// A marker that two share names both; a name that has no room leaves the number, and a long one is cut.
TEST(MapLabels, ANameGivesWayToTheNumber) {
  ObservationProduct p = map_example::product("obs-0001", 60);
  for (const int id : {3, 4})
    map_example::add_school(p, id, p.pings[30].transducer, 30, 31, map_example::block(2, 1, 2, 25, 5));
  p.schools[0].name = "Storsild";
  const std::vector<ObservationProduct> all{p};
  EXPECT_NE(text_of(*survey_map(all, {}, nullptr, {}, kSize, light_theme(kSize)), "3 Storsild, 4"), nullptr);
  const Theme theme = light_theme(kSize);
  EXPECT_TRUE(named_text(3, std::string(80, 'x'), theme).ends_with("\u2026"));
  EXPECT_EQ(named_text(3, "", theme), "");
  FrameDescription frame;
  LabelRoom room({0.0, 0.0, 60.0, 60.0});
  const std::vector<NumberedPlace> places{{{30.0, 30.0}, "3", 4.0, false, "3 Storsild of the whole sea"}};
  EXPECT_TRUE(add_school_numbers(frame, room, places, theme).empty());
  EXPECT_NE(text_of(frame, "3"), nullptr);
}

// Nobody asked for schools: that none is drawn does not say that there are none.
TEST(MapLabels, SchoolsThatAreNotShownAreCounted) {
  EXPECT_EQ(schools_text(0, 0), "0 schools");
  EXPECT_EQ(schools_text(1, 0), "1 school");
  EXPECT_EQ(schools_text(0, 12), "12 schools, not shown");
  EXPECT_EQ(schools_text(2, 10), "2 of 12 schools");
  const ObservationProduct p = map_example::product("obs-0001", 20);
  auto base = observation_map_base(p, kSize, light_theme(kSize));
  ASSERT_TRUE(base);
  base->left_out = 12;
  EXPECT_TRUE(says(observation_map(*base, p, empty_mosaic(*base, 20), 4, {}), "12 schools, not shown"));
  SurveyMapStyle style;
  style.left_out = 12;
  const std::vector<ObservationProduct> all{p};
  EXPECT_TRUE(says(*survey_map(all, {}, nullptr, style, kSize, light_theme(kSize)), "12 schools, not shown"));
  auto panels = propagation_panels(p, 4, {});
  panels[2].left_out = true;
  const Sector sector = p.grid->grid.sector(p.grid->range);
  const auto strip = propagation_view(sector, panels, {}, kSize, light_theme(kSize));
  ASSERT_TRUE(strip);
  EXPECT_TRUE(says(*strip, "schools not shown"));
  TimelineStyle hidden;
  hidden.schools = false;
  const TimelineObservation one{&p, nullptr};
  EXPECT_TRUE(says(*timeline(std::span(&one, 1), hidden, kSize, light_theme(kSize)), "schools not shown"));
}

// The school lies at the ship, at the observation's start.
TEST(MapLabels, NumbersKeepOffTheShipAndTheStart) {
  const ObservationProduct p = map_example::product("obs-0001", 20);
  const Theme theme = light_theme(kSmall);
  const auto base = observation_map_base(p, kSmall, theme);
  ASSERT_TRUE(base);
  for (const int ping : {0, 2, 4}) {
    const auto ship = base->map.at(p.pings[static_cast<std::size_t>(ping)].transducer);
    ASSERT_TRUE(ship && base->start);
    FrameDescription frame;
    const std::vector<MapSchool> schools{{7, "accepted", false, {p.pings[1].transducer}}};
    add_map_schools(frame, *base, schools, ship);
    const TextItem* number = text_of(frame, "7");
    ASSERT_NE(number, nullptr);
    EXPECT_GE(away(LabelRoom::box_of(*number), *ship), 0.9 * theme.text_px);
    EXPECT_GE(away(LabelRoom::box_of(*number), *base->start), 0.45 * theme.text_px);
  }
}

// From the side, two schools at one range beside each other in neighbouring fans, and one right behind the other.
TEST(MapLabels, AStripsNumbersLieOnNoSchool) {
  ObservationProduct p = map_example::product("obs-0001", 5);
  map_example::add_school(p, 5, p.pings[2].transducer, 2, 2, map_example::block(1, 1, 2, 24, 6));
  map_example::add_school(p, 6, p.pings[2].transducer, 2, 2, map_example::block(1, 1, 2, 31, 6));
  map_example::add_school(p, 7, p.pings[2].transducer, 2, 2, map_example::block(2, 1, 2, 24, 6));
  const Sector sector = p.grid->grid.sector(p.grid->range);
  for (const MaskAspect aspect : {MaskAspect::above, MaskAspect::side}) {
    PropagationStyle style;
    style.before = style.after = 0;
    style.aspect = aspect;
    const auto frame = propagation_view(sector, propagation_panels(p, 2, style), style, kSize, light_theme(kSize));
    ASSERT_TRUE(frame);
    const ImageItem* image = map_example::image_of(*frame);
    ASSERT_NE(image, nullptr);
    for (const char* words : {"5", "6", "7"}) {
      const TextItem* number = text_of(*frame, words);
      ASSERT_NE(number, nullptr);
      const PixelRect box = LabelRoom::box_of(*number);
      int covered = 0;
      for (int y = 0; y < image->image->size.height; ++y) {
        for (int x = 0; x < image->image->size.width; ++x) {
          const PixelRect pixel{image->place.x + x, image->place.y + y, 1.0, 1.0};
          covered += image->image->at(x, y).a != 0 && overlap(pixel, box) ? 1 : 0;
        }
      }
      EXPECT_EQ(covered, 0) << words;
    }
  }
}

// Schools that are met at the same time and range: each has its number, on no other, and after all tracks.
TEST(MapLabels, ATimelinesNumbersStandOverAllTracks) {
  ObservationProduct p = map_example::product("obs-0001", 40);
  for (const int id : {1, 2, 3}) {
    map_example::add_school(p, id, p.pings[0].transducer, 5, 15 + id, map_example::block(2, 1, 2, 24, 3));
  }
  const TimelineObservation one{&p, nullptr};
  const auto frame = timeline(std::span(&one, 1), {}, kSize, light_theme(kSize));
  ASSERT_TRUE(frame);
  std::vector<PixelRect> boxes;
  bool numbered = false;
  for (const auto& item : frame->items) {
    if (std::holds_alternative<ClipItem>(item) && numbered) break;
    const auto* t = std::get_if<TextItem>(&item);
    if (t != nullptr && (t->text == "1" || t->text == "2" || t->text == "3")) {
      for (const PixelRect& box : boxes) EXPECT_FALSE(overlap(box, LabelRoom::box_of(*t)));
      boxes.push_back(LabelRoom::box_of(*t));
      numbered = true;
    }
    EXPECT_FALSE(numbered && std::holds_alternative<PathItem>(item)) << "a track over a number";
  }
  EXPECT_EQ(boxes.size(), 3U);
}

}  // namespace
}  // namespace sonar
