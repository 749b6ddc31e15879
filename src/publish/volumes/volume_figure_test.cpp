// SPDX-License-Identifier: Apache-2.0
#include "publish/volumes/volume_figure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "publish/volumes/volume_legend.h"
#include "view/label_room.h"
#include "view/slices/slice_example.h"

namespace sonar {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Schools all over a ping; the third one is selected.
VolumeFigure schools_alone(int schools) {
  const Sector sector = slice_example::hand_sector();
  const Shape3 shape{sector.fans(), sector.beams(), sector.range().count};
  VolumeFigure figure;
  figure.volume = std::make_shared<VolumeData>(VolumeData{sector, Array3<std::int16_t>(shape, kMinCount), -7.0});
  figure.navigation.transducer_depth_m = 7.0;
  for (int i = 0; i < schools; ++i) {
    auto mask = std::make_shared<PingMask>();
    mask->runs = {{(1 + i % 6) * sector.beams() + i % 7, 8 + 4 * (i % 7), 4}};
    mask->confidence.assign(4, 255);
    figure.masks.push_back({std::move(mask), {0.0F, 0.5F, 1.0F}});
    figure.masks.back().selected = i == 2;
    figure.names.push_back(std::to_string(i + 1));
    figure.legend.emplace_back(Rgba8{0, 128, 255, 255}, "school " + std::to_string(i + 1) + ", unreviewed");
  }
  figure.refused.push_back({1, {2, 5, 30}, 1, 1, 1, false});
  figure.fitted = FittedSeabed{120.0, 0.05, 0.0, -90.0, 90.0, -180.0, -30.0};
  figure.outlined = true;
  figure.fan = 3;
  figure.beam = 2;
  figure.title_line = "obs-0001   ping 3";
  return figure;
}

/// A view's trails: none, the ship's, or all of them, each with a row of the legend.
void choose_trails(int view, VolumeFigure& figure, PictureOptions& options) {
  figure.trails = view % 4 == 0 ? nullptr : std::make_shared<std::vector<SceneLine>>();
  figure.schools_tracked = view % 4 > 1;
  options.volume.ship_track = true;
  options.volume.school_tracks = view % 4 == 3;
  options.volume.trail_pings = view % 5;
}

CameraParams from_anywhere(std::mt19937& random, double least_zoom, double most_zoom) {
  const auto even = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  CameraParams out;
  out.orbit_deg = even(-180.0, 180.0);
  out.rise_deg = even(-70.0, 40.0);
  out.zoom = even(least_zoom, most_zoom);
  return out;
}

/// The frame of a figure without echoes.
FrameDescription frame_of(const VolumeFigure& figure, const PictureOptions& options) {
  Work work(1);
  const auto place = volume_place(options);
  EXPECT_TRUE(place);
  const auto camera = volume_camera(figure.sector(), options, place->rays);
  EXPECT_TRUE(camera);
  const ContextPicture context = volume_context(figure, options, *place, *camera, work);
  const VolumeView view = volume_view(figure, options, *place, *camera, context);
  const RayImage rays{place->rays, std::vector<std::array<float, 4>>(place->rays.count()), {}};
  return volume_figure_frame(figure, options, *place, view, context, rays, work);
}

bool overlap(const PixelRect& a, const PixelRect& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

std::vector<TextItem> words_in(const FrameDescription& frame, const PixelRect& place) {
  std::vector<TextItem> out;
  for (const auto& item : frame.items) {
    const auto* text = std::get_if<TextItem>(&item);
    if (text != nullptr && text->turned_deg == 0.0 && inside(place, text->at)) out.push_back(*text);
  }
  return out;
}

/// Where a camera sees the voxels of the schools, and points between them.
std::vector<PixelPoint> seen_of(const VolumeFigure& figure, const VolumePlace& place, const CameraBasis& camera) {
  std::vector<PixelPoint> out;
  const Sector& sector = figure.sector();
  for (const MaskLayer& layer : figure.masks) {
    for (const Run& run : layer.mask->runs) {
      for (double sample = run.first_sample; sample <= run.end() - 1; sample += 0.25) {
        const Point<Sonar> at = Sector::direction(sector.elevation_rad(run.row / sector.beams()),
                                                  sector.azimuth_rad(run.row % sector.beams())) *
                                sector.range().range_m(sample);
        const auto seen = camera.project(at);
        if (seen) out.push_back({place.rect.x + seen->pixel.x, place.rect.y + seen->pixel.y});
      }
    }
  }
  return out;
}

// Law: in 200 random views no words in the volume lie on others, on a school, or beyond its edge: labels, numbers of
// schools, legend, scale bar and, in every tenth view, why nothing is there.
TEST(VolumeFigure, NothingLiesOnAnythingInTwoHundredViews) {
  std::mt19937 random(20200105);
  int numbers = 0;
  int legends = 0;
  int tracks = 0;
  int bars = 0;
  int whys = 0;
  for (int view = 0; view < 200; ++view) {
    const bool nothing = view % 10 == 9;
    VolumeFigure figure = schools_alone(nothing ? 0 : 7);
    PictureOptions options;
    options.volume.data = !nothing;
    options.size = view % 2 == 0 ? PixelSize{640, 400} : PixelSize{900, 700};
    options.dark = view % 3 == 0;
    options.volume.drop_lines = DropLines::all;
    choose_trails(view, figure, options);
    options.kind.volume = from_anywhere(random, 0.6, 2.5);
    const auto place = volume_place(options);
    ASSERT_TRUE(place);
    const PixelSize size{static_cast<int>(place->rect.width), static_cast<int>(place->rect.height)};
    const CameraBasis camera = basis(*volume_camera(figure.sector(), options, place->rays), size);
    const std::vector<PixelPoint> schools = seen_of(figure, *place, camera);
    std::vector<PixelRect> words;
    bool bar = false;
    for (const TextItem& text : words_in(frame_of(figure, options), place->rect)) {
      const PixelRect box = LabelRoom::box_of(text);
      for (const PixelRect& other : words) ASSERT_FALSE(overlap(box, other)) << view << ' ' << text.text;
      words.push_back(box);
      for (const PixelPoint& school : schools) ASSERT_FALSE(inside(box, school)) << view << ' ' << text.text;
      numbers += text.text.size() == 1 ? 1 : 0;
      legends += text.text == "fuzzy area" ? 1 : 0;
      tracks += text.text == "track of the ship" ? 1 : 0;
      whys += text.text.starts_with("no masks: ") ? 1 : 0;
      bar = bar || text.text.ends_with("at the view's centre");
    }
    bars += bar ? 1 : 0;
  }
  EXPECT_GT(numbers, 500);
  EXPECT_GT(legends, 170);
  EXPECT_GT(tracks, 140);
  EXPECT_GT(bars, 190);
  EXPECT_EQ(whys, 20);
}

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
TEST(VolumeFigure, LegendAndScaleBarKeepOffTheSectorInTwoHundredViews) {
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
TEST(VolumeFigure, NoWordsAreCutAtAnyWidth) {
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
TEST(VolumeFigure, TheLegendSaysWhichSeabedIsShown) {
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

// A profile at the ship tells of 10 to 30 m, and recipes let it hold 20 m farther: depths of which nothing is told have no
// arrow. Between two profiles it is linear in time, as it is for schools.
TEST(VolumeFigure, ArrowsOfTheCurrentStandWhereItIsTold) {
  Recipe recipe;
  PingNavigation ship;
  ship.time = 100 * kSecondNs;
  ship.transducer = {60.0, 5.0};
  ship.heading_deg = 0.0;
  ship.transducer_depth_m = 7.0;
  recipe.current_profiles = {{0, ship.transducer, {{10.0, 0.0, 0.1}, {30.0, 0.0, 0.3}}},
                             {400 * kSecondNs, ship.transducer, {{10.0, 0.4, 0.1}, {30.0, 0.4, 0.3}}}};
  const Sector sector = slice_example::hand_sector();
  VolumeFigure figure = schools_alone(1);
  figure.navigation = ship;
  figure.currents = volume_currents(recipe, sector, ship, {});
  ASSERT_EQ(figure.currents.at.size(), 2U) << "20 and 40 m of 20, 40, ... 180";
  EXPECT_NEAR(figure.currents.at[0].east_mps, 0.1, 1e-12);
  EXPECT_NEAR(figure.currents.at[0].north_mps, 0.2, 1e-12);
  EXPECT_EQ(figure.currents.at[1].depth_m, 40.0);
  EXPECT_NEAR(figure.currents.at[1].north_mps, 0.3, 1e-12) << "the last bin holds below it";
  EXPECT_NEAR(figure.currents.longest_mps, 0.5, 1e-12);
  PictureOptions options;
  const auto told = [&] {
    for (const LegendRow& row : volume_legend(figure, options, {0.0, 0.0, 600.0, 400.0}, theme_of(options))) {
      if (row.words.starts_with("current below the ship: 0.5 m/s is 50 m long")) return true;
    }
    return false;
  };
  EXPECT_TRUE(told());
  options.volume.context = false;
  EXPECT_FALSE(told()) << "they stand round the volume";
  VolumeParams off;
  off.current_arrows = false;
  EXPECT_EQ(volume_currents(recipe, sector, ship, off), CurrentColumn{});
  ship.heading_deg = kNaN;
  EXPECT_EQ(volume_currents(recipe, sector, ship, {}), CurrentColumn{}) << "nobody knows which way they point";
}

// Lines go down to the chart where there is one, else to the plane where that was seen, else nowhere.
TEST(VolumeFigure, DropLinesKnowTheirSeabed) {
  VolumeFigure figure = schools_alone(3);
  PictureOptions options;
  const auto bed_of = [&](DropLines lines) {
    options.volume.drop_lines = lines;
    return volume_surroundings(figure, options).schools;
  };
  for (const SchoolPlace& school : bed_of(DropLines::all)) {
    EXPECT_TRUE(school.drop_line);
    const Point<Sonar>& m = school.middle;
    const bool seen = std::abs(m.x) <= 90.0 && m.y >= -180.0 && m.y <= -30.0;
    EXPECT_EQ(std::isnan(school.seabed_z_m), !seen);
    if (seen) {
      EXPECT_NEAR(school.seabed_z_m, 120.0 + 0.05 * m.x, 1e-9);
    }
  }
  std::vector<SchoolPlace> schools = bed_of(DropLines::selected);
  EXPECT_EQ(std::count_if(schools.begin(), schools.end(), [](const SchoolPlace& s) { return s.drop_line; }), 1);
  EXPECT_TRUE(schools[2].drop_line);
  EXPECT_EQ(schools[2].name.find("3: "), 0U) << "with its depth: " << schools[2].name;
  figure.seabed =
      std::make_shared<SeabedPatch>(SeabedPatch{2, 2, -300.0, -300.0, 600.0, std::vector<float>(4, 150.0F)});
  EXPECT_NEAR(bed_of(DropLines::all)[0].seabed_z_m, 143.0, 1e-6) << "7 m below the sea the sonar is";
  schools = bed_of(DropLines::none);
  EXPECT_TRUE(std::none_of(schools.begin(), schools.end(), [](const SchoolPlace& s) { return s.drop_line; }));
}

}  // namespace
}  // namespace sonar
