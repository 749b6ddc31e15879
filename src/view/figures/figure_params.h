// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/describe.h"

namespace sonar {

/// Paper that figures are often made for.
enum class FigurePaper : std::uint8_t { single_column, double_column, a4_upright, a4_across, own };
inline constexpr std::array<std::string_view, 5> kFigurePaperNames{"single_column", "double_column", "a4_upright",
                                                                   "a4_across", "own"};

/// What stands above a panel beside its letter.
enum class FigureHeadings : std::uint8_t { none, names, titles };
inline constexpr std::array<std::string_view, 3> kFigureHeadingNames{"none", "names", "titles"};

/// Where the colour bars of a page stand.
enum class FigureLegend : std::uint8_t { automatic, right, below };
inline constexpr std::array<std::string_view, 3> kFigureLegendNames{"automatic", "right", "below"};

/// Several pictures on a page: what a user sets of it. Text has one size, whatever the panels' sizes are.
struct FigureParams {
  FigurePaper paper = FigurePaper::double_column;
  double width_mm = 180.0;
  double height_mm = 120.0;
  double margin_mm = 2.0;
  int dpi = 300;
  int columns = 2;
  double wide_height_percent = 60.0;
  double text_pt = 8.0;
  bool letters = true;
  FigureHeadings headings = FigureHeadings::names;
  FigureLegend legend = FigureLegend::automatic;
  bool source = true;
  bool dark = false;
  std::string title;
  std::string caption;
  std::string panels;
  friend bool operator==(const FigureParams&, const FigureParams&) = default;
};

template <class Visitor>
void describe(Visitor& v, FigureParams& p) {
  v.choice(
      "paper", p.paper, kFigurePaperNames,
      "what the figure is for, which sets width, height and margin: one column of a journal (85 mm), two (180 mm), "
      "a page of A4");
  v.field("width_mm", p.width_mm, {.unit = "mm", .min = 30, .max = 1200, .text = "width of the page"});
  v.field("height_mm", p.height_mm, {.unit = "mm", .min = 20, .max = 1200, .text = "height of the page"});
  v.field("margin_mm", p.margin_mm, {.unit = "mm", .min = 0, .max = 50, .text = "empty edge of the page"});
  v.field(
      "dpi", p.dpi,
      {.unit = "dpi", .min = 72, .max = 1200, .text = "pixels of a PNG an inch; in SVG and PDF, of the rasters in it"});
  v.field("columns", p.columns, {.unit = "1", .min = 1, .max = 6, .text = "panels beside each other"});
  v.field("wide_height_percent", p.wide_height_percent,
          {.unit = "%",
           .min = 20,
           .max = 200,
           .text = "height of a panel that has a row of its own, of the other panels' height"});
  v.field("text_pt", p.text_pt,
          {.unit = "pt",
           .min = 7.5,
           .max = 16,
           .text = "size of the text on paper, the same in every panel; small print has 0.8 of it"});
  v.field("letters", p.letters, {.text = "number the panels a, b, c", .flag = "no-letters"});
  v.choice("headings", p.headings, kFigureHeadingNames,
           "what stands above each panel: nothing, the name of the view, or the lines that the view itself has there");
  v.choice("legend", p.legend, kFigureLegendNames,
           "where the colour bars stand; automatic = below the panels of a narrow page, else at their right");
  v.field("source", p.source,
          {.text = "say below the panels which survey, observation and ping they are of", .flag = "no-source"});
  v.field("dark", p.dark, {.text = "light on dark, for slides; off = paper", .flag = kNoFlag});
  v.field("title", p.title, {.text = "a line above the panels; empty = none"});
  v.field("caption", p.caption, {.text = "lines below the panels; empty = none"});
  v.field("panels", p.panels,
          {.text = "the pictures in their order, names between commas; a + behind one gives it a row of its own"});
}

/// Width, height and margin that a paper has, mm. Of `own`, those that it was given.
struct FigureSize {
  double width_mm = 0.0;
  double height_mm = 0.0;
  double margin_mm = 0.0;
  friend bool operator==(const FigureSize&, const FigureSize&) = default;
};
[[nodiscard]] FigureSize size_of(FigurePaper paper, const FigureSize& own);

/// One entry of `panels`.
struct FigurePanelName {
  std::string name;
  bool wide = false;  ///< has a row of its own
  friend bool operator==(const FigurePanelName&, const FigurePanelName&) = default;
};

}  // namespace sonar
