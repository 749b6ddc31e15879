// SPDX-License-Identifier: Apache-2.0
#include "view/maps/observation_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <variant>

#include "view/label_room.h"
#include "view/maps/map_example.h"
#include "view/maps/map_items.h"

namespace sonar {
namespace {

constexpr PixelSize kSize{800, 640};

using map_example::image_of;
using map_example::says;

TEST(ObservationMap, HullHoldsEveryFootprint) {
  const ObservationProduct p = map_example::product("obs-0001", 20);
  const auto base = observation_map_base(p, kSize, light_theme(kSize));
  ASSERT_TRUE(base);
  ASSERT_GE(base->hull.size(), 4U);
  ASSERT_EQ(base->footprints.size(), 20U);
  for (const auto& ring : base->footprints) {
    ASSERT_GT(ring.size(), 3U);
    for (const PixelPoint& q : ring) {
      for (std::size_t i = 0; i < base->hull.size(); ++i) {
        const PixelPoint& a = base->hull[i];
        const PixelPoint& b = base->hull[(i + 1) % base->hull.size()];
        // Pixels run down: the hull is clockwise on the picture.
        EXPECT_LE((b.x - a.x) * (q.y - a.y) - (b.y - a.y) * (q.x - a.x), 1e-6);
      }
    }
  }
  // 19 steps of 20 m north; the footprints' apexes are the ship's places.
  const PixelPoint first = *base->map.at(p.pings.front().transducer);
  const PixelPoint last = *base->map.at(p.pings.back().transducer);
  EXPECT_NEAR((first.y - last.y) * base->map.true_metres_per_px(p.pings[0].transducer), 380.0, 0.5);
}

TEST(ObservationMap, ASchoolsVoxelsHaveItsColourAndTheRestIsClear) {
  ObservationProduct p = map_example::product("obs-0001", 20);
  map_example::add_school(p, 8, p.pings[4].transducer, 4, 4, map_example::block(2, 1, 2, 24, 3));
  const auto base = observation_map_base(p, kSize, light_theme(kSize));
  ASSERT_TRUE(base);
  const FrameDescription frame = observation_map(*base, p, mask_mosaic(*base, p), 4, {});
  const ImageItem* image = image_of(frame);
  ASSERT_NE(image, nullptr);
  const PixelPoint at = *base->map.at(destination(p.pings[4].transducer, 49.0, 270.0));
  EXPECT_EQ(image->image->at(static_cast<int>(at.x - image->place.x), static_cast<int>(at.y - image->place.y)),
            school_colour(8));
  EXPECT_EQ(image->image->at(2, 2).a, 0);
  EXPECT_TRUE(says(frame, "ping 4"));
  EXPECT_TRUE(says(frame, "SYNTHETIC"));
}

TEST(ObservationMap, TheTitleTellsOfTheSchoolsThatItIsGiven) {
  const ObservationProduct p = map_example::product("obs-0001", 20);
  const auto base = observation_map_base(p, kSize, light_theme(kSize));
  ASSERT_TRUE(base);
  EXPECT_TRUE(says(observation_map(*base, p, empty_mosaic(*base, 20), 4, {}), "0 schools"));
  EXPECT_TRUE(says(observation_map(*base, p, empty_mosaic(*base, 20), 4, {}, 1), "1 school "));
}

TEST(ObservationMap, ThatNobodyLookedForSchoolsIsSaid) {
  const ObservationProduct p = map_example::product("obs-0001", 20);
  auto base = observation_map_base(p, kSize, light_theme(kSize));
  ASSERT_TRUE(base);
  base->searched = false;
  EXPECT_TRUE(says(observation_map(*base, p, empty_mosaic(*base, 20), 4, {}), "schools not detected"));
}

TEST(ObservationMap, TheShipNeverFillsItAndLeavesTheStartSeen) {
  ObservationProduct p = map_example::product("obs-0001", 3);
  p.grid.reset();  // no footprints: 40 m of track
  const auto base = observation_map_base(p, kSize, light_theme(kSize));
  ASSERT_TRUE(base);
  EXPECT_GT(base->map.place.height * base->map.true_metres_per_px(p.pings[0].transducer), 5.0 * 78.0);
  const FrameDescription frame = observation_map(*base, p, mask_mosaic(*base, p), 0, {});
  EXPECT_EQ(frame.title, "obs-0001 of SYNTHETIC example");
  const Theme theme = light_theme(kSize);
  int ship = -1;
  int start = -1;
  int i = 0;
  for (const auto& item : frame.items) {
    if (const auto* path = std::get_if<PathItem>(&item)) {
      if (path->fill == theme.ship) ship = i;
      if (path->fill == kStartColour) start = i;
    }
    ++i;
  }
  EXPECT_GE(ship, 0);
  EXPECT_GT(start, ship);
}

TEST(ObservationMap, NoPositionIsOneLine) {
  ObservationProduct p = map_example::product("obs-0001", 2);
  for (PingNavigation& n : p.pings) n.transducer.latitude_deg = std::nan("");
  const auto base = observation_map_base(p, kSize, light_theme(kSize));
  ASSERT_FALSE(base);
  EXPECT_EQ(base.error().text, "obs-0001: no ping has a position");
}

TEST(ObservationMap, SchoolsHavePathsInTheirColoursAndNumbers) {
  const ObservationProduct p = map_example::product("obs-0001", 20);
  const Theme theme = light_theme(kSize);
  const auto base = observation_map_base(p, kSize, theme);
  ASSERT_TRUE(base);
  auto frame = observation_map(*base, p, empty_mosaic(*base, p.pings.size()), 3, {});
  const auto strokes = [&](Rgba8 colour) {
    return std::count_if(frame.items.begin(), frame.items.end(), [&](const auto& item) {
      const auto* path = std::get_if<PathItem>(&item);
      return path != nullptr && path->stroke.colour == colour;
    });
  };
  ASSERT_EQ(strokes(school_colour(12)), 0);
  std::vector<MapSchool> schools{{12, "accepted", false, {p.pings[2].transducer, p.pings[5].transducer}},
                                 {13, "rejected", false, {p.pings[9].transducer, p.pings[15].transducer}}};
  const auto muted = strokes(theme.muted);
  add_map_schools(frame, *base, schools);
  EXPECT_EQ(strokes(school_colour(12)), 1);
  EXPECT_EQ(strokes(school_colour(13)), 0);
  EXPECT_EQ(strokes(theme.muted), muted + 1);
  EXPECT_TRUE(says(frame, "12"));
  EXPECT_TRUE(says(frame, "13"));
}

// Ten schools in one place: each has its number, none on another, and those that stand apart have a line.
TEST(ObservationMap, TouchingSchoolsAllHaveTheirNumbers) {
  const ObservationProduct p = map_example::product("obs-0001", 20);
  const Theme theme = light_theme(kSize);
  const auto base = observation_map_base(p, kSize, theme);
  ASSERT_TRUE(base);
  FrameDescription frame;
  frame.size = kSize;
  std::vector<MapSchool> schools;
  for (int i = 1; i <= 10; ++i) {
    schools.push_back({i, "accepted", i == 7, {destination(p.pings[9].transducer, 60.0 + i, 270.0)}});
  }
  add_map_schools(frame, *base, schools);
  std::vector<PixelRect> boxes;
  for (const auto& item : frame.items) {
    const auto* t = std::get_if<TextItem>(&item);
    if (t == nullptr) continue;
    const PixelRect box = LabelRoom::box_of(*t);
    for (const PixelRect& other : boxes) {
      EXPECT_TRUE(box.x >= other.x + other.width || other.x >= box.x + box.width || box.y >= other.y + other.height ||
                  other.y >= box.y + box.height)
          << t->text;
    }
    boxes.push_back(box);
  }
  EXPECT_EQ(boxes.size(), 10U);
  for (int i = 1; i <= 10; ++i) {
    EXPECT_TRUE(std::any_of(frame.items.begin(), frame.items.end(), [&](const auto& item) {
      const auto* t = std::get_if<TextItem>(&item);
      return t != nullptr && t->text == std::to_string(i);
    })) << i;
  }
}

// No room for hundreds of numbers on one spot: what is left out is said, with how many.
TEST(ObservationMap, NumbersWithoutRoomAreNamed) {
  const ObservationProduct p = map_example::product("obs-0001", 20);
  const auto base = observation_map_base(p, kSize, light_theme(kSize));
  ASSERT_TRUE(base);
  FrameDescription frame;
  frame.size = kSize;
  std::vector<MapSchool> schools;
  for (int i = 1; i <= 400; ++i) schools.push_back({i, "accepted", false, {p.pings[9].transducer}});
  add_map_schools(frame, *base, schools);
  const auto numbers = std::count_if(frame.items.begin(), frame.items.end(), [](const auto& item) {
    return std::holds_alternative<TextItem>(item) && std::get<TextItem>(item).bold;
  });
  EXPECT_GT(numbers, 20);
  EXPECT_TRUE(says(frame, "numbers left out: "));
  EXPECT_TRUE(says(frame, "and " + std::to_string(400 - 6 - numbers) + " more"));
}

// Each line and colour of the map is named once, of the schools' statuses those that there are; nothing is cut.
TEST(ObservationMap, AKeyNamesItsLinesAndColours) {
  ObservationProduct p = map_example::product("obs-0001", 20);
  map_example::add_school(p, 3, p.pings[4].transducer, 4, 6, map_example::block(2, 1, 2, 24, 3));
  map_example::add_school(p, 5, p.pings[9].transducer, 9, 12, map_example::block(2, 1, 2, 24, 3));
  p.schools[0].status = "rejected";
  p.schools[1].status = "accepted";
  for (const PixelSize size : {PixelSize{320, 240}, PixelSize{640, 480}, PixelSize{2560, 1600}}) {
    const Theme theme = light_theme(size);
    const auto plain = observation_map_base(p, size, theme);
    const auto base = observation_map_base(p, size, theme, {}, true);
    ASSERT_TRUE(plain && base);
    EXPECT_TRUE(plain->key.empty());
    EXPECT_LT(base->map.place.height, plain->map.place.height);
    auto frame = observation_map(*base, p, mask_mosaic(*base, p), 4, {});
    add_map_schools(frame, *base, map_schools(p));
    for (const char* words : {"ship", "its path", "start", "hull of all pings", "current ping", "core", "fuzzy area",
                              "path of a school, accepted", "path of a school, rejected"}) {
      EXPECT_TRUE(std::any_of(frame.items.begin(), frame.items.end(), [&](const auto& item) {
        const auto* t = std::get_if<TextItem>(&item);
        return t != nullptr && t->text == words;
      })) << words;
    }
    EXPECT_FALSE(says(frame, "unreviewed"));
    EXPECT_FALSE(says(frame, "corrected"));
    for (const auto& item : frame.items) {
      const auto* t = std::get_if<TextItem>(&item);
      if (t == nullptr || t->turned_deg != 0.0) continue;
      const PixelRect box = LabelRoom::box_of(*t);
      EXPECT_GE(box.x, 0.0) << t->text;
      EXPECT_LE(box.x + box.width, size.width) << t->text;
      EXPECT_LE(t->at.y + 0.5 * t->size_px, size.height) << t->text;
    }
  }
}

TEST(ObservationMap, SchoolsHaveTheirPlacesInEachPing) {
  ObservationProduct p = map_example::product("obs-0001", 20);
  map_example::add_school(p, 3, p.pings[4].transducer, 4, 6, map_example::block(2, 1, 2, 24, 3));
  map_example::add_school(p, 5, p.pings[9].transducer, 9, 12, map_example::block(2, 1, 2, 24, 3));
  p.schools[0].status = "rejected";
  const auto all = map_schools(p, 5);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].places.size(), 3U);
  EXPECT_EQ(all[1].places.size(), 4U);
  EXPECT_FALSE(all[0].selected);
  EXPECT_TRUE(all[1].selected);
  const auto kept = map_schools(p, 0, false);
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(kept[0].number, 5);
}

TEST(ObservationMap, ANarrowMapSaysItsPingAndNotItsDay) {
  const ObservationProduct p = map_example::product("obs-0001", 20);
  constexpr PixelSize kNarrow{360, 300};
  const auto base = observation_map_base(p, kNarrow, light_theme(kNarrow));
  ASSERT_TRUE(base);
  const auto frame = observation_map(*base, p, empty_mosaic(*base, p.pings.size()), 3, {});
  EXPECT_TRUE(says(frame, "ping 3 at 12:26:55"));
  EXPECT_FALSE(says(frame, "2020-09-13 12"));
}

// A low map is about where the ship is, not about how long a mile is.
TEST(ObservationMap, AScaleStandsOnlyWhereItLeavesTheMapToBeSeen) {
  const ObservationProduct p = map_example::product("obs-0001", 20);
  const auto with_scale = [&](PixelSize size) {
    const auto base = observation_map_base(p, size, light_theme(size));
    EXPECT_TRUE(base);
    const auto frame = observation_map(*base, p, empty_mosaic(*base, p.pings.size()), 3, {});
    EXPECT_EQ(says(frame, " nmi"), base->scale.has_value());
    return says(frame, " nmi");
  };
  EXPECT_TRUE(with_scale(kSize));
  EXPECT_TRUE(with_scale({320, 240}));
  EXPECT_FALSE(with_scale({400, 120}));
}

// Law: wherever the ship goes, it and its start are seen.
TEST(ObservationMap, TheScaleHidesNoPlaceOfTheShip) {
  std::set<std::pair<bool, bool>> corners;
  for (const PixelSize size : {kSize, PixelSize{480, 400}}) {
    for (int course = 0; course < 360; course += 15) {
      const ObservationProduct p = map_example::product("obs-0001", 40, {60.0, 5.0}, course);
      const auto base = observation_map_base(p, size, light_theme(size));
      ASSERT_TRUE(base);
      ASSERT_TRUE(base->scale);
      const PixelRect& box = base->scale->place;
      for (const PingNavigation& n : p.pings) {
        EXPECT_FALSE(inside(box, *base->map.at(n.transducer))) << course << " in " << size.width;
      }
      const PixelRect& map = base->map.place;
      EXPECT_TRUE(inside(map, {box.x, box.y}) && inside(map, {box.x + box.width, box.y + box.height})) << course;
      corners.insert({box.x > map.x + map.width / 2.0, box.y > map.y + map.height / 2.0});
      bool drawn = false;
      for (const auto& item : observation_map(*base, p, empty_mosaic(*base, 40), 3, {}).items) {
        const auto* text = std::get_if<TextItem>(&item);
        if (text != nullptr && text->text == base->scale->bars[0].text) drawn = inside(box, text->at);
      }
      EXPECT_TRUE(drawn) << course;
    }
  }
  EXPECT_GT(corners.size(), 1U);
}

}  // namespace
}  // namespace sonar
