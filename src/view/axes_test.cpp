// SPDX-License-Identifier: Apache-2.0
#include "view/axes.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "view/colour_bar.h"

namespace sonar {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Ticks, ByHand) {
  EXPECT_THAT(nice_ticks(0.0, 500.0, 6).major, ElementsAre(0, 100, 200, 300, 400, 500));
  EXPECT_THAT(nice_ticks(0.0, 500.0, 5).major, ElementsAre(0, 200, 400));
  EXPECT_THAT(nice_ticks(500.0, 0.0, 5).major, ElementsAre(0, 200, 400));
  const Ticks fine = nice_ticks(-0.25, 0.25, 5);
  EXPECT_THAT(fine.major, ElementsAre(-0.2, -0.1, 0.0, 0.1, 0.2));
  EXPECT_EQ(fine.decimals, 1);
  EXPECT_THAT(fine.minor, ::testing::SizeIs(20));  // -0.24 .. 0.24 by 0.02 are 25, five of them major
}

TEST(Ticks, DegreesAndColourSteps) {
  EXPECT_THAT(degree_ticks(240.0, 300.0, 7).major, ElementsAre(240, 250, 260, 270, 280, 290, 300));
  EXPECT_THAT(degree_ticks(-45.0, 0.0, 4).major, ElementsAre(-45, -30, -15, 0));
  EXPECT_THAT(step_ticks(-70.0, -34.0, -70.0, 3.0, 13).major, ::testing::SizeIs(13));
  EXPECT_THAT(step_ticks(-70.0, -34.0, -70.0, 3.0, 7).major, ElementsAre(-70, -64, -58, -52, -46, -40, -34));
}

TEST(Ticks, Laws) {
  for (int i = 0; i < 400; ++i) {
    const double low = (i % 7 - 3) * std::pow(10.0, i % 9 - 4);
    const double high = low + (1 + i % 11) * std::pow(10.0, (i / 9) % 9 - 4);
    const int most = 2 + i % 9;
    const Ticks t = nice_ticks(low, high, most);
    ASSERT_LE(t.major.size(), static_cast<std::size_t>(most));
    const double mantissa = t.step / std::pow(10.0, std::floor(std::log10(t.step) + 1e-9));
    ASSERT_TRUE(std::abs(mantissa - 1) < 1e-6 || std::abs(mantissa - 2) < 1e-6 || std::abs(mantissa - 5) < 1e-6);
    for (const double v : t.major) {
      ASSERT_GE(v, low - 1e-6 * t.step);
      ASSERT_LE(v, high + 1e-6 * t.step);
      // What the label says is where the tick is.
      ASSERT_NEAR(std::stod(fmt::format("{:.{}f}", v, t.decimals)), v, 1e-6 * t.step);
    }
    for (const double m : t.minor) {
      for (const double v : t.major) ASSERT_GT(std::abs(m - v), 0.1 * t.step);
    }
  }
}

TEST(Ticks, NothingWhereThereIsNoRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_THAT(nice_ticks(1.0, 1.0, 5).major, IsEmpty());
  EXPECT_THAT(nice_ticks(nan, 1.0, 5).major, IsEmpty());
  EXPECT_THAT(nice_ticks(0.0, infinite, 5).major, IsEmpty());
  EXPECT_THAT(nice_ticks(1e300, 1e300 * (1 + 1e-15), 5).major, IsEmpty());
  EXPECT_THAT(degree_ticks(0.0, 10.0, 0).major, IsEmpty());
  EXPECT_THAT(step_ticks(0.0, 10.0, 0.0, 0.0, 5).major, IsEmpty());
}

TEST(Ticks, Text) {
  EXPECT_EQ(tick_text(-60.0, 0), "\u221260");
  EXPECT_EQ(tick_text(-0.04, 1), "0.0");
  EXPECT_EQ(tick_text(1.25, 1), "1.2");
}

TEST(PlotFrame, PlacesAndValues) {
  const PlotFrame plot{{100, 50, 400, 200}, {-10, 10, "x", false}, {5, -5, "y", false}};
  EXPECT_EQ(plot.at(-10, 5), (PixelPoint{100, 50}));
  EXPECT_EQ(plot.at(10, -5), (PixelPoint{500, 250}));
  EXPECT_DOUBLE_EQ(plot.x_at(300), 0.0);
  EXPECT_DOUBLE_EQ(plot.y_at(100), 2.5);
}

TEST(PlotFrame, IsotropicWidensOnlyTheAxisWithRoom) {
  PlotFrame plot{{0, 0, 400, 100}, {0, 10, "", false}, {20, 0, "", false}};
  make_isotropic(plot);  // y needs 0.2 a pixel; x gets 80 about 5
  EXPECT_DOUBLE_EQ(plot.y.first, 20.0);
  EXPECT_DOUBLE_EQ(plot.x.first, -35.0);
  EXPECT_DOUBLE_EQ(plot.x.last, 45.0);
}

TEST(Layout, EverythingStaysInThePicture) {
  for (const PixelSize size : {PixelSize{640, 480}, {800, 600}, {1280, 800}, {1920, 1080}, {3840, 2160}}) {
    const Theme theme = light_theme(size);
    const Layout layout = lay_out(size, theme);
    EXPECT_GT(layout.plot.width, 0.6 * size.width);
    EXPECT_GT(layout.plot.height, 0.7 * size.height);
    EXPECT_GT(layout.plot.y, layout.title.y + layout.title.height - 1);
    EXPECT_LT(layout.colour_bar.x + layout.colour_bar.width + 5.2 * theme.text_px, size.width);
    EXPECT_GE(theme.text_px, 10.0);
    // Whole pixels, so that data is not resampled.
    EXPECT_EQ(layout.plot.x, std::round(layout.plot.x));
    EXPECT_EQ(layout.plot.height, std::round(layout.plot.height));
  }
}

std::vector<std::string> texts(const FrameDescription& frame) {
  std::vector<std::string> out;
  for (const auto& item : frame.items) {
    if (const auto* text = std::get_if<TextItem>(&item)) out.push_back(text->text);
  }
  return out;
}

TEST(ColourBar, NamesBothLimitsTheUnitAndTheThreshold) {
  SvScale scale;
  scale.map = ColourMapName::ek500;
  scale.threshold_db = -51.5;
  FrameDescription frame;
  frame.size = {200, 600};
  add_colour_bar(frame, {20, 20, 20, 500}, colour_bar(sv_colours(scale)), light_theme({800, 600}));
  EXPECT_THAT(texts(frame), ::testing::IsSupersetOf({"\u221260", "\u221224", "Sv (dB re 1 m\u207B\u00B9)", "threshold",
                                                     "\u221251.5 dB", "\u221257", "\u221227"}));
}

TEST(ColourBar, AShortOnesLabelReachesNoTitle) {
  const Theme theme = light_theme({800, 600});
  for (const double height : {24.0, 48.0, 96.0, 300.0}) {
    FrameDescription frame;
    const PixelRect place{20, 200, 20, height};
    add_colour_bar(frame, place, colour_bar(sv_colours(SvScale{})), theme);
    const auto turned = [](const auto& item) {
      const auto* text = std::get_if<TextItem>(&item);
      return text != nullptr && text->turned_deg != 0.0;
    };
    const auto found = std::find_if(frame.items.begin(), frame.items.end(), turned);
    ASSERT_NE(found, frame.items.end());
    const auto& label = std::get<TextItem>(*found);
    const double above = label.at.y - 0.5 * text_width_px(label.text.c_str(), label.size_px);
    EXPECT_GE(above, place.y - 0.9 * theme.text_px) << height;
    EXPECT_EQ(label.text == "Sv (dB re 1 m\u207B\u00B9)", height > 48.0) << height << ": " << label.text;
    EXPECT_EQ(label.text.find('(') == std::string::npos, label.text.find(')') == std::string::npos) << "no unit is cut";
  }
}

TEST(ColourBar, DepthReadsDownwards) {
  FrameDescription frame;
  const ColourMap& deep = colour_map(ColourMapName::deep);
  add_colour_bar(frame, {0, 0, 10, 100}, colour_bar(deep, 0.0, 400.0, "depth (m)", true), light_theme({800, 600}));
  const auto* blocks = std::get_if<ImageItem>(&frame.items.at(1));
  ASSERT_NE(blocks, nullptr);
  EXPECT_GT(lightness(blocks->image->pixels.front()), lightness(blocks->image->pixels.back()));
  for (const auto& item : frame.items) {
    const auto* text = std::get_if<TextItem>(&item);
    if (text != nullptr && text->text == "0") {
      EXPECT_LT(text->at.y, 50.0);
    }
  }
}

std::vector<TextItem> title_in(PixelSize size, const std::vector<std::string>& lines, const std::string& right,
                               double least_text_px = 0.0) {
  FrameDescription frame;
  frame.size = size;
  const Theme theme = with_text(light_theme(size), least_text_px);
  add_title(frame, lay_out(size, theme), theme, lines, right);
  std::vector<TextItem> texts;
  for (const auto& item : frame.items) texts.push_back(std::get<TextItem>(item));
  return texts;
}

TEST(Elided, KeepsWholeLettersOfTheBeginning) {
  EXPECT_EQ(elided("north", 10.0, 1000.0), "north");
  const double wide = text_width_px("\u00E9\u00E9\u00E9\u2026", 10.0);
  EXPECT_EQ(elided("\u00E9\u00E9\u00E9\u00E9\u00E9\u00E9", 10.0, wide), "\u00E9\u00E9\u00E9\u2026");
  EXPECT_EQ(elided("a b", 10.0, text_width_px("a\u2026", 10.0)), "a\u2026");  // no blank before the ellipsis
  EXPECT_EQ(elided("north", 10.0, 1.0), "");
}

// Law: at every width what is left is the line's beginning, ends where a word ends, and fits; and more room never leaves less.
TEST(Elided, ALineLosesWholePartsAndWords) {
  const std::string line = "Top: fan 17, elevation \u22124.7\u00B0, 79.6 kHz; bearings from the bow";
  std::size_t before = 0;
  for (double width = 0.0; width < 600.0; width += 1.0) {
    const std::string left = elided_line(line, 12.0, width);
    ASSERT_LE(text_width_px(left.c_str(), 12.0), width);
    ASSERT_GE(left.size(), before) << width;
    before = left.size();
    if (left == line || left.empty()) continue;
    ASSERT_TRUE(left.ends_with("\u2026")) << left;
    const std::string kept = left.substr(0, left.size() - 3);
    ASSERT_TRUE(line.starts_with(kept)) << left;
    EXPECT_TRUE(std::string(" ,;:").find(line[kept.size()]) != std::string::npos) << left;
    EXPECT_EQ(left.find("79.6\u2026"), std::string::npos) << "no figure without its unit";
  }
  EXPECT_EQ(elided_line(line, 12.0, 1000.0), line);
  EXPECT_EQ(elided_line("a b", 10.0, text_width_px("a\u2026", 10.0)), "a\u2026");
  EXPECT_EQ(elided_line("north", 10.0, text_width_px("nor\u2026", 10.0)), "") << "words are not cut";
}

TEST(Title, NothingLeavesANarrowPictureAndSyntheticStays) {
  const std::vector<std::string> lines{"obs-0001 of SYNTHETIC survey of herring in the north",
                                       "Top: fan 4, elevation -30.0, 75.0 kHz"};
  const std::string time = "2026-11-21 19:57:26.123 UTC";
  // Whole, or without its day.
  const auto of_time = [&](const TextItem& t) { return t.text == time || t.text == "19:57:26.123 UTC"; };
  for (int width = 160; width <= 1200; width += 40) {
    SCOPED_TRACE(width);
    double left_end = 0.0;
    double right_begin = 1e9;
    const auto texts = title_in({width, 400}, lines, time);
    for (const TextItem& text : texts) {
      const double wide = text_width_px(text.text.c_str(), text.size_px);
      const double begin = text.anchor == TextAnchor::right ? text.at.x - wide : text.at.x;
      EXPECT_GE(begin, 0.0) << text.text;
      EXPECT_LE(begin + wide, width) << text.text;
      if (of_time(text)) right_begin = begin;
    }
    for (const TextItem& text : texts) {
      if (of_time(text) || right_begin > 1e8) continue;
      const auto right = std::find_if(texts.begin(), texts.end(), of_time);
      if (text.at.y == right->at.y) left_end = text.at.x + text_width_px(text.text.c_str(), text.size_px);
    }
    EXPECT_LT(left_end, right_begin);
    EXPECT_THAT(texts[0].text, ::testing::HasSubstr("SYN"));
    if (width >= 240) {
      EXPECT_THAT(texts[0].text, ::testing::HasSubstr("SYNTHETIC"));
    }
  }
  EXPECT_EQ(title_in({1600, 900}, lines, time)[0].text, lines[0]);
}

// What says least goes first where there is no room: the day beside a ping, the words before a survey's name.
TEST(Title, ANarrowPictureLosesWhatSaysLeast) {
  const auto said = [](const std::vector<TextItem>& texts, const std::string& words) {
    return std::any_of(texts.begin(), texts.end(), [&](const TextItem& t) { return t.text == words; });
  };
  const std::string slice = "Top: fan 17, elevation -4.7\u00B0, 79.6 kHz; bearings from the bow";
  const std::vector<std::string> lines{"obs-0001 SYNTHETIC   ping 10", slice};
  const std::string time = "2020-01-04 08:00:50.350 UTC";
  EXPECT_TRUE(said(title_in({1200, 900}, lines, time), time));
  const auto narrow = title_in({320, 240}, lines, time);
  EXPECT_TRUE(said(narrow, "08:00:50.350 UTC"));
  EXPECT_TRUE(said(narrow, slice)) << "whole";
  // As a window of 1280 x 800 has it: where the slice is, before when.
  const auto small = title_in({338, 229}, lines, time, 12.0);
  EXPECT_FALSE(said(small, "08:00:50.350 UTC"));
  EXPECT_TRUE(std::ranges::any_of(
      small, [](const TextItem& t) { return t.text.starts_with("Top: fan 17, elevation -4.7\u00B0"); }));
  const std::string survey = "Fish schools of SYNTHETIC survey, made by somebody";
  EXPECT_TRUE(said(title_in({1200, 900}, {survey}, ""), survey));
  EXPECT_TRUE(said(title_in({260, 240}, {survey}, ""), "SYNTHETIC survey, made by somebody"));
}

// A flat view has fewer lines, none of them small: the plot keeps five lines' height wherever the picture has it.
TEST(Title, AFlatPictureHasFewerLinesNotSmallerOnes) {
  constexpr double kLeast_px = 12.0;
  const std::vector<std::string> lines{"obs-0001 SYNTHETIC   ping 10", "Top: fan 17, elevation -4.7\u00B0, 79.6 kHz"};
  std::size_t before = 0;
  for (int height = 100; height <= 300; height += 10) {
    SCOPED_TRACE(height);
    const PixelSize size{420, height};
    const auto texts = title_in(size, lines, "2020-01-04 08:00:50.350 UTC", kLeast_px);
    for (const TextItem& text : texts) EXPECT_GE(text.size_px, kLeast_px) << text.text;
    const Layout layout = lay_out(size, with_text(light_theme(size), kLeast_px));
    for (const TextItem& text : texts) EXPECT_LT(text.at.y + 0.5 * text.size_px, layout.plot.y) << text.text;
    if (height >= 140) {
      EXPECT_GE(layout.plot.height, 5.0 * kLeast_px);
    }
    EXPECT_GE(texts.size(), before);
    before = texts.size();
  }
  EXPECT_TRUE(title_in({420, 100}, lines, "", kLeast_px).empty());
  EXPECT_EQ(title_in({420, 150}, lines, "", kLeast_px).size(), 1U);
  EXPECT_EQ(before, 3U);
}

}  // namespace
}  // namespace sonar
