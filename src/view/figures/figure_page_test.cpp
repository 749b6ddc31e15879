// SPDX-License-Identifier: Apache-2.0
#include "view/figures/figure_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <variant>

#include "view/axes.h"
#include "view/colour_bar.h"
#include "view/shapes.h"

namespace sonar {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<FigurePanelName> some_panels(std::size_t count) {
  return std::vector<FigurePanelName>(count, FigurePanelName{"view", false});
}

ColourBar sv_bar(double low_db, const std::string& label = kSvLabel) {
  SvScale scale;
  scale.low_db = low_db;
  return colour_bar(sv_colours(scale), label);
}

/// A picture as builders make them for a panel: words as large as the theme has them, and bars left to the page.
FigurePanel picture(const FigureParams& params, const PixelRect& place, std::vector<ColourBar> bars) {
  const PanelDrawing drawing = panel_drawing(params);
  FigurePanel panel;
  panel.name = "View";
  panel.frame.emplace();
  panel.frame->size = drawing.size_in(place);
  panel.frame->bars = std::move(bars);
  panel.frame->items.emplace_back(text_item({10.0, 10.0}, "words", drawing.look.text_px, {0, 0, 0, 255}));
  return panel;
}

FrameDescription page_of(const FigureParams& params, const std::vector<std::vector<ColourBar>>& bars) {
  const auto layout = figure_layout(params, some_panels(bars.size()), true, "");
  EXPECT_TRUE(layout);
  std::vector<FigurePanel> panels;
  for (std::size_t i = 0; i < bars.size(); ++i) panels.push_back(picture(params, layout->panels[i], bars[i]));
  return figure_page(params, *layout, panels, "");
}

std::vector<TextItem> texts_of(const FrameDescription& frame) {
  std::vector<TextItem> out;
  for (const auto& item : frame.items) {
    if (const auto* text = std::get_if<TextItem>(&item)) out.push_back(*text);
  }
  return out;
}

std::ptrdiff_t count_of_text(const FrameDescription& frame, const std::string& words) {
  const auto texts = texts_of(frame);
  return std::count_if(texts.begin(), texts.end(), [&](const TextItem& one) { return one.text == words; });
}

bool apart(const PixelRect& a, const PixelRect& b) {
  constexpr double kRounding = 1e-6;
  return a.x + a.width <= b.x + kRounding || b.x + b.width <= a.x + kRounding || a.y + a.height <= b.y + kRounding ||
         b.y + b.height <= a.y + kRounding;
}

// The definition of dots per inch, worked with whole numbers: 254 tenths of a millimetre to the inch.
TEST(FigurePage, HasAsManyPixelsAsItsMillimetresAtItsDots) {
  FigureParams params;
  for (const int dpi : {72, 96, 150, 300, 600, 1200}) {
    for (const int tenths_mm : {850, 1800, 1234, 2101}) {
      params.width_mm = tenths_mm / 10.0;
      params.dpi = dpi;
      EXPECT_EQ(page_pixels(params).width, (tenths_mm * dpi + 127) / 254) << tenths_mm << " at " << dpi;
    }
  }
}

// Whatever is asked for: nothing lies on anything else or leaves the page, and panels are in the order of reading.
TEST(FigureLayout, NothingOverlapsOrLeavesThePage) {
  std::mt19937 random(3);
  const auto any = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  int laid_out = 0;
  for (int trial = 0; trial < 400; ++trial) {
    FigureParams params;
    params.paper = FigurePaper::own;
    params.width_mm = any(60, 300);
    params.height_mm = any(60, 300);
    params.margin_mm = any(0, 15);
    params.dpi = any(72, 400);
    params.columns = any(1, 4);
    params.wide_height_percent = any(40, 150);
    params.letters = any(0, 1) == 1;
    params.headings = static_cast<FigureHeadings>(any(0, 2));
    params.legend = static_cast<FigureLegend>(any(0, 2));
    if (any(0, 1) == 1) params.title = "A title";
    if (any(0, 1) == 1) params.caption = std::string(static_cast<std::size_t>(any(1, 60)) * 6, 'w') + " words";
    std::vector<FigurePanelName> panels = some_panels(static_cast<std::size_t>(any(1, 7)));
    for (FigurePanelName& one : panels) one.wide = any(0, 3) == 0;
    const auto layout = figure_layout(params, panels, any(0, 1) == 1, any(0, 1) == 1 ? "source" : "");
    if (!layout) {
      EXPECT_THAT(layout.error().text, HasSubstr("have no room for text"));
      continue;
    }
    ++laid_out;
    std::vector<PixelRect> all = layout->panels;
    all.insert(all.end(), layout->headings.begin(), layout->headings.end());
    for (const PixelRect& one : {layout->title, layout->legend, layout->source, layout->caption}) all.push_back(one);
    std::erase_if(all, [](const PixelRect& one) { return !(one.width > 0.0) || !(one.height > 0.0); });
    for (std::size_t i = 0; i < all.size(); ++i) {
      EXPECT_TRUE(all[i].x > -1e-6 && all[i].y > -1e-6 && all[i].x + all[i].width < layout->page.width + 1e-6 &&
                  all[i].y + all[i].height < layout->page.height + 1e-6);
      for (std::size_t j = 0; j < i; ++j) EXPECT_TRUE(apart(all[i], all[j])) << i << " on " << j;
    }
    ASSERT_EQ(layout->panels.size(), panels.size());
    for (std::size_t i = 1; i < panels.size(); ++i) {
      const PixelRect& before = layout->panels[i - 1];
      const PixelRect& here = layout->panels[i];
      EXPECT_TRUE(here.y >= before.y + before.height || (here.y == before.y && here.x >= before.x + before.width));
      if (panels[i].wide) {
        EXPECT_NE(here.y, before.y) << "a row of its own";
      }
    }
  }
  EXPECT_GT(laid_out, 100);
}

TEST(FigureLayout, SaysWhatIsWrongInOneSentence) {
  const auto problem = [](const FigureParams& params, std::size_t panels) {
    const auto layout = figure_layout(params, some_panels(panels), true, "");
    return layout ? std::string() : layout.error().text;
  };
  FigureParams params;
  EXPECT_THAT(problem(params, 0), HasSubstr("no picture is chosen"));
  params.columns = 6;
  EXPECT_THAT(problem(params, 6), HasSubstr("fewer columns"));
  params = {};
  params.width_mm = params.height_mm = 400.0;
  params.dpi = 1200;
  EXPECT_THAT(problem(params, 1), HasSubstr("fewer dpi"));
}

// Text of panels, letters, bars, caption: each has the points that were asked for, on every paper and at every dpi.
TEST(FigurePage, TextIsAsLargeOnPaperInEveryPanelAndForEveryDpi) {
  for (const int dpi : {72, 100, 300, 600, 1200}) {
    for (const int columns : {1, 2, 3}) {
      FigureParams params;
      params.dpi = dpi;
      params.columns = columns;
      params.caption = "What is seen here.";
      const FrameDescription page = page_of(params, {{sv_bar(-60.0)}, {sv_bar(-60.0)}, {}});
      EXPECT_EQ(page.dots_per_inch, dpi);
      const auto texts = texts_of(page);
      EXPECT_EQ(count_of_text(page, "words"), 3);
      for (const TextItem& text : texts) {
        EXPECT_NEAR(text.size_px * 72.0 / dpi, params.text_pt, 1e-6) << text.text << " at " << dpi;
      }
    }
  }
}

TEST(FigurePage, PanelsAreLetteredInTheOrderOfReading) {
  const FrameDescription page = page_of({}, {{}, {}, {}});
  std::vector<std::string> letters;
  for (const TextItem& text : texts_of(page)) {
    if (text.bold) letters.push_back(text.text);
  }
  EXPECT_THAT(letters, ElementsAre("a", "b", "c"));
  FigureParams none;
  none.letters = false;
  EXPECT_EQ(count_of_text(page_of(none, {{}, {}}), "a"), 0);
  EXPECT_EQ(panel_letter(25), "z");
  EXPECT_EQ(panel_letter(26), "aa");
  EXPECT_EQ(panel_letter(51), "az");
}

TEST(FigurePage, PanelsOfOneScaleHaveOneBar) {
  for (const FigureLegend where : {FigureLegend::right, FigureLegend::below}) {
    FigureParams params;
    params.legend = where;
    EXPECT_EQ(count_of_text(page_of(params, {{sv_bar(-60.0)}, {sv_bar(-60.0)}, {sv_bar(-60.0)}}), kSvLabel), 1);
    EXPECT_EQ(count_of_text(page_of(params, {{sv_bar(-60.0)}, {}, {sv_bar(-75.0)}}), kSvLabel), 2);
    EXPECT_EQ(count_of_text(page_of(params, {{}, {}}), kSvLabel), 0);
  }
}

TEST(FigurePage, EachBarNamesThePanelsThatItIsOf) {
  const FrameDescription page = page_of({}, {{sv_bar(-60.0)}, {sv_bar(-75.0)}, {sv_bar(-60.0)}});
  EXPECT_EQ(count_of_text(page, "a, c"), 1);
  EXPECT_EQ(count_of_text(page, "b"), 2) << "its letter, and its bar";
}

TEST(SharedBars, ABarIsAnotherOneWhereAnythingThatItIsReadByDiffers) {
  const auto bars = [](const ColourBar& a, const ColourBar& b) {
    FigurePanel first;
    FigurePanel second;
    first.frame.emplace().bars = {a};
    second.frame.emplace().bars = {b};
    return shared_bars(std::vector{first, second}, true).size();
  };
  const ColourBar bar = sv_bar(-60.0);
  EXPECT_EQ(bars(bar, bar), 1U);
  ColourBar other = bar;
  other.high += 1.0;
  EXPECT_EQ(bars(bar, other), 2U);
  other = bar;
  other.threshold_db = -55.0;
  EXPECT_EQ(bars(bar, other), 2U);
  other = bar;
  other.colours.back() = {1, 2, 3, 255};
  EXPECT_EQ(bars(bar, other), 2U);
  other = bar;
  other.label = "Sv (dB)";
  EXPECT_EQ(bars(bar, other), 2U) << "another unit";
}

TEST(SharedBars, QuantitiesOfOneScaleAreToldApartInItsLabel) {
  FigurePanel first;
  FigurePanel second;
  first.frame.emplace().bars = {sv_bar(-60.0)};
  second.frame.emplace().bars = {sv_bar(-60.0, "largest Sv (dB re 1 m\u207B\u00B9)")};
  const std::vector<FigurePanel> panels{first, second, first};
  ASSERT_EQ(shared_bars(panels, true).size(), 1U);
  EXPECT_EQ(shared_bars(panels, true)[0].bar.label, "a, c: Sv; b: largest Sv (dB re 1 m\u207B\u00B9)");
  EXPECT_EQ(shared_bars(panels, false)[0].bar.label, "Sv, largest Sv (dB re 1 m\u207B\u00B9)");
  EXPECT_THAT(shared_bars(panels, true)[0].panels, ElementsAre(0U, 1U, 2U));
}

TEST(FigurePage, APanelThatCannotBeDrawnSaysWhy) {
  const FigureParams params;
  const auto layout = figure_layout(params, some_panels(2), true, "");
  ASSERT_TRUE(layout);
  std::vector<FigurePanel> panels(2);
  panels[0].problem = "no ping has a position";
  panels[1] = picture(params, layout->panels[1], {});
  EXPECT_EQ(count_of_text(figure_page(params, *layout, panels, ""), "no ping has a position"), 1);
}

TEST(FigurePage, ThatDataIsSyntheticIsNeverShortenedAway) {
  FigureParams params;
  params.width_mm = 60.0;
  params.columns = 1;
  const std::string source = std::string(200, 'w') + " SYNTHETIC";
  const auto layout = figure_layout(params, some_panels(1), false, source);
  ASSERT_TRUE(layout);
  const std::vector<FigurePanel> panels{picture(params, layout->panels[0], {})};
  const auto texts = texts_of(figure_page(params, *layout, panels, source));
  EXPECT_TRUE(std::any_of(texts.begin(), texts.end(),
                          [](const TextItem& text) { return text.text.find("SYNTHETIC") != std::string::npos; }));
}

TEST(FigureParams, PanelsAreReadAsTheyAreWritten) {
  const std::vector<FigurePanelName> names{{"top_slice", false}, {"timeline", true}};
  EXPECT_EQ(panels_text(names), "top_slice,timeline+");
  EXPECT_EQ(panel_names(panels_text(names)), names);
  EXPECT_EQ(panel_names(" top_slice ,, timeline+ "), names);
  EXPECT_TRUE(panel_names("").empty());
}

TEST(PanelTheme, APictureLeavesItsBarToThePageAndHasItsRoom) {
  const Theme theme = panel_theme({20.0, 1.0, false}, false);
  FrameDescription frame;
  add_colour_bar(frame, {0, 0, 10, 100}, sv_bar(-60.0), theme);
  EXPECT_TRUE(frame.items.empty());
  ASSERT_EQ(frame.bars.size(), 1U);
  const Layout panel = lay_out({600, 400}, theme);
  Theme with_bar = theme;
  with_bar.bars = with_bar.titles = true;
  const Layout whole = lay_out({600, 400}, with_bar);
  EXPECT_GT(panel.plot.width, whole.plot.width);
  EXPECT_GT(panel.plot.height, whole.plot.height);
}

TEST(LevelColourBar, HasItsEndsInBoldAndItsLabelBelow) {
  FrameDescription frame;
  const Theme theme = panel_theme({10.0, 1.0, false}, false);
  const PixelRect place{50.0, 20.0, 300.0, 9.0};
  add_level_colour_bar(frame, place, sv_bar(-60.0), theme);
  std::vector<std::string> bold;
  for (const TextItem& text : texts_of(frame)) {
    if (text.bold) bold.push_back(text.text);
    EXPECT_GT(text.at.y, place.y + place.height);
    EXPECT_LE(text.at.y + 5.0, place.y + place.height + kBelowLevelBar_em * 10.0);
  }
  EXPECT_THAT(bold, ElementsAre("\u221260", "\u221224"));
  const auto* colours = std::get_if<ImageItem>(&frame.items.at(1));
  ASSERT_NE(colours, nullptr);
  EXPECT_EQ(colours->image->size.height, 1);
}

}  // namespace
}  // namespace sonar
