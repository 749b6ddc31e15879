// SPDX-License-Identifier: Apache-2.0
#include "view/observation_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "view/label_room.h"
#include "view/map_example.h"
#include "view/map_items.h"
#include "view/propagation_view.h"

namespace sonar {
namespace {

constexpr PixelSize kSize{800, 640};

bool says(const FrameDescription& frame, const std::string& words) {
  return std::any_of(frame.items.begin(), frame.items.end(), [&](const auto& item) {
    const auto* t = std::get_if<TextItem>(&item);
    return t != nullptr && t->text.find(words) != std::string::npos;
  });
}

const ImageItem* image_of(const FrameDescription& frame, int which = 0) {
  for (const auto& item : frame.items) {
    if (const auto* i = std::get_if<ImageItem>(&item); i != nullptr && which-- == 0) return i;
  }
  return nullptr;
}

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
  EXPECT_TRUE(says(observation_map(*base, p, empty_mosaic(*base, 20), 4, {}), "schools not looked for"));
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

TEST(PropagationView, AStripIsOneRowThatTellsItsPlacesAndWhyAPropagationEnded) {
  ObservationProduct p = map_example::product("obs-0001", 9);
  map_example::add_school(p, 4, p.pings[3].transducer, 3, 4, map_example::block(2, 1, 2, 24, 3));
  PropagationStyle style;
  style.before = style.after = 3;
  style.one_row = true;
  constexpr PixelSize kLow{1000, 400};
  auto panels = propagation_panels(p, 4, style);
  panels[4].note = "stopped at ping 5";
  const Sector sector = p.grid->grid.sector(p.grid->range);
  const auto frame = propagation_view(sector, panels, style, kLow, light_theme(kLow));
  ASSERT_TRUE(frame);
  EXPECT_TRUE(says(*frame, "stopped at ping 5"));
  const auto places = propagation_places(sector, panels, style, kLow, light_theme(kLow));
  ASSERT_TRUE(places);
  ASSERT_EQ(places->size(), 7U);
  for (std::size_t i = 1; i < places->size(); ++i) {
    EXPECT_EQ((*places)[i].y, (*places)[0].y);
    EXPECT_GT((*places)[i].x, (*places)[i - 1].x + (*places)[i - 1].width);
  }
  EXPECT_EQ(image_of(*frame, 0)->place.x, (*places)[2].x);  // ping 3 is the third of 1 .. 7
}

TEST(PropagationView, NeighboursAreLabelledAndSayWhatTheyAre) {
  ObservationProduct p = map_example::product("obs-0001", 5);
  map_example::add_school(p, 417, p.pings[3].transducer, 3, 3, map_example::block(2, 1, 2, 24, 3));
  p.pings[2].bad = true;
  const PropagationStyle style;
  const auto panels = propagation_panels(p, 3, style);
  ASSERT_EQ(panels.size(), 5U);
  EXPECT_TRUE(panels[2].current);
  EXPECT_TRUE(panels[4].absent);  // there is no ping 5
  const Sector sector = p.grid->grid.sector(p.grid->range);
  const auto frame = propagation_view(sector, panels, style, {1200, 500}, light_theme({1200, 500}), "SYNTHETIC");
  ASSERT_TRUE(frame) << to_line(frame.error());
  EXPECT_TRUE(says(*frame, "ping 1"));
  EXPECT_TRUE(says(*frame, "12:26:55"));  // ping 3, 15 s after 12:26:40
  EXPECT_TRUE(says(*frame, "no school"));
  EXPECT_TRUE(says(*frame, "bad ping"));
  EXPECT_TRUE(says(*frame, "after the last ping"));
  EXPECT_FALSE(says(*frame, "ping 5"));
  EXPECT_TRUE(std::any_of(frame->items.begin(), frame->items.end(), [](const auto& item) {
    const auto* t = std::get_if<TextItem>(&item);
    return t != nullptr && t->text == "417";
  }));
  EXPECT_EQ(image_of(*frame, 1), nullptr);  // only one ping has a mask
}

// The current ping keeps the middle at both ends; where all pings are seen nothing is missing.
TEST(PropagationView, AtTheEndsTheMissingPingsKeepTheirPlaces) {
  const ObservationProduct p = map_example::product("obs-0001", 8);
  PropagationStyle style;
  for (const std::int64_t current : {0, 7}) {
    const auto panels = propagation_panels(p, current, style);
    ASSERT_EQ(panels.size(), 5U);
    EXPECT_TRUE(panels[2].current);
    EXPECT_EQ(std::count_if(panels.begin(), panels.end(), [](const auto& one) { return one.absent; }), 2);
    const auto frame =
        propagation_view(p.grid->grid.sector(p.grid->range), panels, style, {900, 400}, light_theme({900, 400}));
    ASSERT_TRUE(frame);
    EXPECT_TRUE(says(*frame, current == 0 ? "before the first ping" : "after the last ping"));
  }
  style.before = style.after = 10;
  EXPECT_EQ(propagation_panels(p, 3, style).size(), 8U);
}

TEST(PropagationView, ThatNobodyLookedForSchoolsIsSaid) {
  const ObservationProduct p = map_example::product("obs-0001", 8);
  const Sector sector = p.grid->grid.sector(p.grid->range);
  for (const bool searched : {false, true}) {
    const auto frame =
        propagation_view(sector, propagation_panels(p, 4, {}, searched), {}, {1200, 500}, light_theme({1200, 500}));
    ASSERT_TRUE(frame);
    EXPECT_EQ(says(*frame, "not looked for"), !searched);
    EXPECT_EQ(says(*frame, "no school"), searched);
  }
}

// The example's ship starts at 2020-09-13 12:26:40 and pings every 5 s.
TEST(PropagationView, APublishedPingHasItsDayAndItsClock) {
  ObservationProduct p = map_example::product("obs-0001", 5);
  map_example::add_school(p, 1, p.pings[3].transducer, 1, 3, map_example::block(2, 1, 2, 24, 3));
  const Sector sector = p.grid->grid.sector(p.grid->range);
  PropagationStyle style;
  style.dates = true;
  const auto frame = propagation_view(sector, propagation_panels(p, 2, style), style, {1200, 500},
                                      light_theme({1200, 500}), "SYNTHETIC");
  ASSERT_TRUE(frame);
  EXPECT_TRUE(says(*frame, "12:26:55 UTC"));
  EXPECT_TRUE(says(*frame, "2020-09-13"));
  style.dates = false;
  const auto strip =
      propagation_view(sector, propagation_panels(p, 2, style), style, {1200, 500}, light_theme({1200, 500}));
  EXPECT_FALSE(says(*strip, "2020-09-13"));
}

// Two labelled depths give pixels per metre; the same scale and the transducer's depth give where the mask must lie.
TEST(PropagationView, FromTheSideItHasAScaleOfDepths) {
  ObservationProduct p = map_example::product("obs-0001", 3);
  map_example::add_school(p, 1, p.pings[1].transducer, 1, 1, map_example::block(2, 1, 2, 24, 3));
  p.pings[1].transducer_depth_m = 7.0;
  const Sector sector = p.grid->grid.sector(p.grid->range);
  PropagationStyle style;
  style.before = style.after = 0;
  const PixelSize size{900, 900};
  const auto depths = [&](const FrameDescription& frame) {
    std::vector<std::pair<double, double>> out;  // m, px
    for (const auto& item : frame.items) {
      const auto* t = std::get_if<TextItem>(&item);
      if (t == nullptr || t->text == "0 m" || !t->text.ends_with(" m") || t->anchor != TextAnchor::left) continue;
      out.emplace_back(std::stod(t->text), t->at.y);
    }
    return out;
  };
  const auto above = propagation_view(sector, propagation_panels(p, 1, style), style, size, light_theme(size));
  ASSERT_TRUE(above);
  EXPECT_TRUE(depths(*above).empty());
  style.aspect = MaskAspect::side;
  const auto side = propagation_view(sector, propagation_panels(p, 1, style), style, size, light_theme(size));
  ASSERT_TRUE(side);
  const auto scale = depths(*side);
  ASSERT_GE(scale.size(), 2U);
  const double px_per_m = (scale.back().second - scale.front().second) / (scale.back().first - scale.front().first);
  const ImageItem* image = image_of(*side);
  ASSERT_NE(image, nullptr);
  int top = -1;
  int bottom = -1;
  for (int y = 0; y < image->image->size.height; ++y) {
    for (int x = 0; x < image->image->size.width; ++x) {
      if (image->image->at(x, y).a == 0) continue;
      if (top < 0) top = y;
      bottom = y + 1;
    }
  }
  const auto depth_at = [&](double y) {
    return scale.front().first + (image->place.y + y - scale.front().second) / px_per_m;
  };
  // The mask's cells: fan 2, samples 24 to 26; the sonar lies 7 m deep, z points down.
  const auto [low, high] = std::pair(sector.elevation_bounds(2).lower, sector.elevation_bounds(2).upper);
  const double near_m = sector.range().range_m(23.5);
  const double far_m = sector.range().range_m(26.5);
  EXPECT_NEAR(depth_at(bottom), 7.0 - far_m * std::sin(low), 2.0 / px_per_m);
  EXPECT_NEAR(depth_at(top), 7.0 - near_m * std::sin(high), 2.0 / px_per_m);
}

TEST(PropagationView, OneScaleAndOnePlaceForAllPings) {
  // The same mask in two pings is the same picture; core and fuzzy have their two colours, and areas are true.
  ObservationProduct p = map_example::product("obs-0001", 5);
  PingMask mask = map_example::block(2, 1, 1, 24, 3, 255);
  const PingMask fuzzy = map_example::block(2, 2, 1, 24, 3, 10);
  mask.runs.insert(mask.runs.end(), fuzzy.runs.begin(), fuzzy.runs.end());
  mask.confidence.insert(mask.confidence.end(), fuzzy.confidence.begin(), fuzzy.confidence.end());
  map_example::add_school(p, 1, p.pings[3].transducer, 1, 3, mask);
  const Sector sector = p.grid->grid.sector(p.grid->range);
  for (const MaskAspect aspect : {MaskAspect::above, MaskAspect::side}) {
    PropagationStyle style;
    style.aspect = aspect;
    const auto panels = propagation_panels(p, 2, style);
    const auto frame = propagation_view(sector, panels, style, {1400, 600}, dark_theme({1400, 600}));
    ASSERT_TRUE(frame);
    const Image& a = *image_of(*frame, 0)->image;
    EXPECT_TRUE(a == *image_of(*frame, 1)->image);
    const auto count = [&](std::uint8_t q) {
      return std::count(a.pixels.begin(), a.pixels.end(), mask_colour(style.palette, 0, q));
    };
    EXPECT_GT(count(255), 50);
    if (aspect == MaskAspect::above) {
      // Two beams of the same width and reach: equal areas.
      EXPECT_NEAR(static_cast<double>(count(10)) / static_cast<double>(count(255)), 1.0, 0.15);
    } else {
      EXPECT_EQ(count(10), 0);  // the core hides what is behind it
    }
  }
}

TEST(PropagationView, TooManyPingsForThePictureIsOneLine) {
  const ObservationProduct p = map_example::product("obs-0001", 200);
  PropagationStyle style;
  style.before = style.after = 90;
  const auto frame = propagation_view(p.grid->grid.sector(p.grid->range), propagation_panels(p, 100, style), style,
                                      {400, 300}, light_theme({400, 300}));
  ASSERT_FALSE(frame);
  EXPECT_EQ(frame.error().text, "a picture of 400 x 300 pixels is too small for 181 pings");
}

}  // namespace
}  // namespace sonar
