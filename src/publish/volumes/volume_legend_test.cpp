// SPDX-License-Identifier: Apache-2.0
#include "publish/volumes/volume_legend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <vector>

#include "publish/volumes/test_volume_figure.h"
#include "view/label_room.h"

namespace sonar {
namespace {

using namespace volume_test;  // NOLINT(google-build-using-namespace)

/// Whether words are others' beginning that ends where a word ends, or all of them.
bool shortened_well(const std::string& words, const std::string& whole) {
  if (words == whole) return true;
  if (!words.ends_with("\u2026")) return false;
  const std::string kept = words.substr(0, words.size() - 3);
  return whole.starts_with(kept) && std::string(" ,;:").find(whole[kept.size()]) != std::string::npos;
}

/// Where a camera sees the sector's cells, from the sonar to their far ends.
std::vector<PixelPoint> seen_of_sector(const Sector& sector, const VolumePlace& place, const CameraBasis& camera) {
  constexpr int kSteps = 24;
  std::vector<PixelPoint> out;
  const auto between = [](double first, double last, int i) { return first + (last - first) * i / kSteps; };
  const double lowest = sector.elevation_bounds(0).lower;
  const double highest = sector.elevation_bounds(sector.fans() - 1).upper;
  const double aft = sector.azimuth_bounds(0).lower;
  const double fore = sector.azimuth_bounds(sector.beams() - 1).upper;
  for (int i = 0; i <= kSteps; ++i) {
    for (int k = 0; k <= kSteps; ++k) {
      const Point<Sonar> along = Sector::direction(between(lowest, highest, i), between(aft, fore, k));
      for (int far = 1; far <= kSteps; ++far) {
        const auto seen = camera.project(along * between(0.0, sector.range().range_m(sector.range().count - 1), far));
        if (seen) out.push_back({place.rect.x + seen->pixel.x, place.rect.y + seen->pixel.y});
      }
    }
  }
  return out;
}

/// Whether a box of this size has room to spare in one of a picture's corners, off points and off a rectangle.
bool a_corner_has_room(const PixelRect& picture, double width, double height, const std::vector<PixelPoint>& points,
                       const PixelRect& off) {
  for (const double x : {picture.x, picture.x + picture.width - width}) {
    for (const double y : {picture.y, picture.y + picture.height - height}) {
      const PixelRect box{x, y, width, height};
      if (overlap(box, off)) continue;
      if (std::ranges::none_of(points, [&](const PixelPoint& p) { return inside(box, p); })) return true;
    }
  }
  return false;
}

PixelRect about(const PixelRect& a, const PixelRect& b) {
  if (a.width == 0.0) return b;
  const double x = std::min(a.x, b.x);
  const double y = std::min(a.y, b.y);
  return {x, y, std::max(a.x + a.width, b.x + b.width) - x, std::max(a.y + a.height, b.y + b.height) - y};
}

// Law: in 200 random views, from a small window's panel to a large screen, the legend and the scale bar lie on the sector only
// where no corner of the picture has room for them beside it.
TEST(VolumeLegend, LegendAndScaleBarKeepOffTheSectorInTwoHundredViews) {
  VolumeFigure figure = schools_alone(6);  // but the first, at the sector's edge: it reaches out a little
  figure.masks.erase(figure.masks.begin());
  figure.names.erase(figure.names.begin());
  figure.legend.erase(figure.legend.begin());
  std::mt19937 random(20200106);
  constexpr std::array<PixelSize, 4> kSizes{{{400, 300}, {600, 400}, {720, 560}, {1280, 800}}};
  int rooms = 0;
  int bars = 0;
  for (int view = 0; view < 200; ++view) {
    PictureOptions options;
    options.size = view % 50 == 49 ? PixelSize{3840, 2160} : kSizes[static_cast<std::size_t>(view) % kSizes.size()];
    options.kind.volume = from_anywhere(random, 0.4, 1.4);
    options.volume.ship_length_m = 1.0;  // kept off too; here the sector alone is looked at
    choose_trails(view, figure, options);
    const auto place = volume_place(options);
    ASSERT_TRUE(place);
    const PixelRect& picture = place->rect;
    const double em = place->theme.text_px;
    const PixelSize size{static_cast<int>(picture.width), static_cast<int>(picture.height)};
    const CameraBasis camera = basis(*volume_camera(figure.sector(), options, place->rays), size);
    const std::vector<PixelPoint> sector = seen_of_sector(figure.sector(), *place, camera);
    const auto on_sector = [&](const PixelRect& box) {
      return std::ranges::any_of(sector, [&](const PixelPoint& p) { return inside(box, p); });
    };
    double wide = 0.0;
    double lines = 0.0;
    std::vector<std::string> of_legend;
    for (const LegendRow& row : volume_legend(figure, options, picture, place->theme)) {
      of_legend.push_back(row.words);
      if (row.one_school) continue;
      lines += 1.0;
      wide = std::max(wide, text_width_px(row.words.c_str(), em));
    }
    PixelRect legend{};
    PixelRect bar{};
    for (const TextItem& text : words_in(frame_of(figure, options), picture)) {
      const PixelRect box = LabelRoom::box_of(text);
      const auto says = [&](const std::string& row) { return shortened_well(text.text, row); };
      if (std::ranges::any_of(of_legend, says)) legend = about(legend, box);
      if (text.text.ends_with("at the view's centre")) bar = {box.x, box.y, box.width, 2.3 * em};
    }
    // To spare: the sector's convex hull reaches a little beyond what is seen of it, the box beyond its words.
    const double spare = 0.1 * picture.height + 3.0 * em;
    if (lines > 0.0 && a_corner_has_room(picture, wide + spare, 1.5 * em * lines + spare, sector, {})) {
      ++rooms;
      EXPECT_FALSE(on_sector(legend)) << view;
      EXPECT_GT(legend.width, 0.0) << view;
    }
    if (a_corner_has_room(picture, bar.width + spare, bar.height + spare, sector, legend)) {
      EXPECT_FALSE(on_sector(bar)) << view;
    }
    if (bar.width > 0.0) ++bars;
    EXPECT_FALSE(overlap(legend, bar)) << view;
  }
  EXPECT_GT(rooms, 20);
  EXPECT_GT(bars, 150);
}

// Law: from 200 pixels on, under all palettes and in both themes, no words reach over the border, and what has no room is
// shortened by whole words: the legend's, and the line below the title.
TEST(VolumeLegend, NoWordsAreCutAtAnyWidth) {
  VolumeFigure figure = schools_alone(3);
  figure.mark = "interpolated between pings 3 and 4";
  PictureOptions options;
  options.least_text_px = 12.0;
  const auto legend_at = [&](double width) {
    return volume_legend(figure, options, {0.0, 0.0, width, 4000.0}, theme_of(options));
  };
  const auto second_line = [&](const FrameDescription& frame) {
    const PixelRect above{0.0, 0.0, 1.0 * options.size.width, volume_place(options)->rect.y};
    for (const TextItem& text : words_in(frame, above)) {
      if (text.text.starts_with("noise removed") || text.text.starts_with("as recorded")) return text.text;
    }
    return std::string();
  };
  options.size = {4000, 500};
  const std::string whole_line = second_line(frame_of(figure, options));
  const std::string without_legend = whole_line + "; no room for the legend";
  const auto whole_legend = legend_at(4000.0);
  ASSERT_FALSE(whole_line.empty());
  for (std::size_t palette = 0; palette < colour_map_names().size(); ++palette) {
    options.display.scale.map = static_cast<ColourMapName>(palette);
    for (int width = 200; width <= 1000; width += 50) {
      options.size = {width, 500};
      options.dark = width % 100 == 0;
      const FrameDescription frame = frame_of(figure, options);
      for (const TextItem& text : words_in(frame, {0.0, 0.0, 1.0 * width, 500.0})) {
        const double wide = text_width_px(text.text.c_str(), text.size_px);
        const double left = text.anchor == TextAnchor::left     ? text.at.x
                            : text.anchor == TextAnchor::centre ? text.at.x - wide / 2
                                                                : text.at.x - wide;
        EXPECT_GE(left, 0.0) << width << ": " << text.text;
        EXPECT_LE(left + wide, width) << width << ": " << text.text;
      }
      const std::string line = second_line(frame);
      EXPECT_TRUE(shortened_well(line, whole_line) || shortened_well(line, without_legend)) << width << ": " << line;
      for (const LegendRow& row : legend_at(volume_place(options)->rect.width)) {
        EXPECT_TRUE(std::ranges::any_of(whole_legend,
                                        [&](const LegendRow& all) { return shortened_well(row.words, all.words); }))
            << width << ": " << row.words;
      }
    }
  }
}

// The seabed and what the numbers mean stand in the legend; where schools are many their numbers alone are left.
TEST(VolumeLegend, TheLegendSaysWhichSeabedIsShown) {
  PictureOptions options;
  const auto words_of = [&](const VolumeFigure& figure) {
    std::string all;
    for (const LegendRow& row : volume_legend(figure, options, {0.0, 0.0, 600.0, 400.0}, theme_of(options))) {
      all += row.words + "; ";
    }
    return all;
  };
  VolumeFigure figure = schools_alone(2);
  EXPECT_NE(words_of(figure).find("seabed, fitted to the ping's echoes"), std::string::npos);
  EXPECT_NE(words_of(figure).find("school 2"), std::string::npos);
  figure.seabed = std::make_shared<SeabedPatch>(SeabedPatch{2, 2, 0, 0, 1, std::vector<float>(4, 90.0F)});
  EXPECT_EQ(words_of(figure).find("fitted"), std::string::npos);
  EXPECT_NE(words_of(figure).find("seabed, of the depth chart"), std::string::npos);
  EXPECT_EQ(words_of(schools_alone(13)).find("school 2"), std::string::npos);
  EXPECT_NE(words_of(schools_alone(13)).find("fuzzy area"), std::string::npos);
  options.volume.seabed = false;
  EXPECT_EQ(words_of(schools_alone(2)).find("seabed"), std::string::npos);
  EXPECT_EQ(words_of(figure).find("shadow"), std::string::npos);
  figure.shadow_from = std::make_shared<const std::vector<int>>(56, 20);
  EXPECT_NE(words_of(figure).find("in the shadow of schools"), std::string::npos);
}

}  // namespace
}  // namespace sonar
