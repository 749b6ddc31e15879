// SPDX-License-Identifier: Apache-2.0
#include "view/composed_figure.h"

#include <gtest/gtest.h>

#include <optional>
#include <variant>

#include "view/shapes.h"

namespace sonar {
namespace {

constexpr PixelRect kPlace{100.0, 50.0, 200.0, 300.0};

/// 400 x 200 pixels: fits as 200 x 100 in the middle of kPlace, from (100, 150) on, at half its size.
FrameDescription picture() {
  FrameDescription frame{{400, 200}, {255, 255, 255, 255}, "a picture", {}};
  frame.items.emplace_back(line_item({0.0, 0.0}, {400.0, 200.0}, {0, 0, 0, 255}, 4.0));
  frame.items.emplace_back(ClipItem{{100.0, 100.0, 1000.0, 1000.0}});
  frame.items.emplace_back(text_item({200.0, 100.0}, "words", 20.0, {0, 0, 0, 255}));
  frame.items.emplace_back(ClipItem{});
  frame.items.emplace_back(ImageItem{{0.0, 0.0, 400.0, 200.0}, std::make_shared<Image>(PixelSize{2, 1}), false});
  return frame;
}

TEST(ComposedFigure, APictureIsAsLargeAsItGoesAndNotDistorted) {
  EXPECT_EQ(fitted({400, 200}, kPlace), (PixelRect{100.0, 150.0, 200.0, 100.0}));
  EXPECT_EQ(fitted({100, 400}, kPlace), (PixelRect{162.5, 50.0, 75.0, 300.0}));
  EXPECT_EQ(fitted({0, 4}, kPlace), PixelRect{});
}

TEST(ComposedFigure, PlacesTextLinesAndClipsAreScaledAlike) {
  FrameDescription page{{500, 500}, {255, 255, 255, 255}, "page", {}};
  PathItem line = line_item({}, {}, {}, 1.0);
  place_frame(page, picture(), kPlace);
  ASSERT_EQ(page.items.size(), 7U);
  EXPECT_EQ(std::get<ClipItem>(page.items[0]).place, (PixelRect{100.0, 150.0, 200.0, 100.0}));
  line = std::get<PathItem>(page.items[1]);
  EXPECT_EQ(line.parts[0].points[1], (PixelPoint{300.0, 250.0}));
  EXPECT_EQ(line.stroke.width_px, 2.0);
  EXPECT_EQ(std::get<ClipItem>(page.items[2]).place, (PixelRect{150.0, 200.0, 150.0, 50.0})) << "cut to the place";
  EXPECT_EQ(std::get<TextItem>(page.items[3]).at, (PixelPoint{200.0, 200.0}));
  EXPECT_EQ(std::get<TextItem>(page.items[3]).size_px, 10.0);
  EXPECT_EQ(std::get<ClipItem>(page.items[4]).place, (PixelRect{100.0, 150.0, 200.0, 100.0})) << "its end is the place";
  EXPECT_EQ(std::get<ImageItem>(page.items[5]).place, (PixelRect{100.0, 150.0, 200.0, 100.0}));
  EXPECT_EQ(std::get<ClipItem>(page.items[6]).place, PixelRect{});
}

TEST(ComposedFigure, WhatIsClippedAwayWhollyIsLeftOut) {
  FrameDescription hidden{{400, 200}, {255, 255, 255, 255}, "", {}};
  hidden.items.emplace_back(ClipItem{{500.0, 0.0, 10.0, 10.0}});
  hidden.items.emplace_back(text_item({505.0, 5.0}, "hidden", 20.0, {0, 0, 0, 255}));
  hidden.items.emplace_back(ClipItem{});
  hidden.items.emplace_back(text_item({200.0, 100.0}, "seen", 20.0, {0, 0, 0, 255}));
  FrameDescription page{{500, 500}, {255, 255, 255, 255}, "page", {}};
  place_frame(page, hidden, kPlace);
  std::vector<std::string> texts;
  for (const auto& item : page.items) {
    if (const auto* text = std::get_if<TextItem>(&item)) texts.push_back(text->text);
  }
  EXPECT_EQ(texts, std::vector<std::string>{"seen"});
}

TEST(ComposedFigure, ABackgroundOfItsOwnIsPainted) {
  FrameDescription dark = picture();
  dark.background = {0, 0, 0, 255};
  FrameDescription page{{500, 500}, {255, 255, 255, 255}, "page", {}};
  place_frame(page, dark, kPlace);
  const auto& painted = std::get<PathItem>(page.items.at(1));
  EXPECT_EQ(painted.fill, (Rgba8{0, 0, 0, 255}));
  EXPECT_EQ(painted.parts[0].points[2], (PixelPoint{300.0, 250.0}));
}

}  // namespace
}  // namespace sonar
