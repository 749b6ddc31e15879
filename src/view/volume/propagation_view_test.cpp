// SPDX-License-Identifier: Apache-2.0
#include "view/volume/propagation_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "view/maps/map_example.h"
#include "view/maps/map_items.h"

namespace sonar {
namespace {

using map_example::image_of;
using map_example::says;

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

// Words go in the order of what is missed least, and those that stay can be read.
TEST(PropagationView, ALowStripHasFewerWordsNotSmallerOnes) {
  ObservationProduct p = map_example::product("obs-0001", 9);
  map_example::add_school(p, 4, p.pings[3].transducer, 3, 4, map_example::block(2, 1, 2, 24, 3));
  PropagationStyle style;
  style.before = style.after = 1;
  style.one_row = true;
  const auto panels = propagation_panels(p, 3, style);
  const Sector sector = p.grid->grid.sector(p.grid->range);
  const std::string time = clock_text(p.pings[3].time, true).substr(11);
  std::size_t said = 4;
  for (int height = 200; height >= 55; --height) {
    const PixelSize size{600, height};
    const Theme theme = with_text(light_theme(size), 12.0);
    const auto frame = propagation_view(sector, panels, style, size, theme, "obs-0001");
    ASSERT_TRUE(frame) << height;
    const std::vector<bool> there{says(*frame, "ping 3"), says(*frame, " m "), says(*frame, time),
                                  says(*frame, "obs-0001")};
    EXPECT_TRUE(std::ranges::is_sorted(there, std::greater{})) << height;
    const auto now = static_cast<std::size_t>(std::ranges::count(there, true));
    EXPECT_LE(now, said) << height;
    said = now;
    for (const auto& item : frame->items) {
      const auto* text = std::get_if<TextItem>(&item);
      if (text == nullptr) continue;
      EXPECT_GE(text->size_px, 12.0) << text->text;
    }
    EXPECT_TRUE(height < 200 || said == 4U);
  }
  EXPECT_EQ(said, 0U);
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
    EXPECT_EQ(says(*frame, "not detected"), !searched);
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
