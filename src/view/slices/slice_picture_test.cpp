// SPDX-License-Identifier: Apache-2.0
#include "view/slices/slice_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <variant>
#include <vector>

#include "geo/refraction.h"
#include "view/school_look.h"
#include "view/slices/slice_context.h"
#include "view/slices/slice_example.h"

namespace sonar {
namespace {

constexpr SvScale kScale{.map = ColourMapName::ek500};

using slice_example::hand_sector;
using slice_example::LitVolume;
using slice_example::texts_of;

constexpr PixelSize kSize{400, 400};

const Voxel kLit{4, 3, 20};
const SliceView kTop{TopSlice{4}};

SliceMap hand_map() { return SliceMap(hand_sector(), kTop, {-200, -200, 200, 200}, kSize); }

PingMask one_voxel(const Voxel& v, std::uint8_t confidence) {
  return {{{v.fan * 7 + v.beam, v.sample, 1}}, {confidence}};
}

void near(Rgba8 is, double r, double g, double b) {
  EXPECT_NEAR(is.r, r, 1.0);
  EXPECT_NEAR(is.g, g, 1.0);
  EXPECT_NEAR(is.b, b, 1.0);
}

TEST(SliceImage, EveryCellHasItsOwnColourAndNothingIsMixed) {
  const SliceMap map = hand_map();
  const LitVolume volume(map.sector(), kLit, -58.5, -80.0);
  const Theme theme = light_theme(kSize);
  const auto image = slice_image(map, volume.data(), sv_colours(kScale), {}, {}, theme);
  ASSERT_TRUE(image.has_value());
  for (int y = 0; y < 400; ++y) {
    for (int x = 0; x < 400; ++x) {
      const auto voxel = map.voxel_at({x + 0.5, y + 0.5});
      const Rgba8 expected = !voxel ? Rgba8{0, 0, 0, 0} : *voxel == kLit ? Rgba8{159, 159, 159, 255} : theme.water;
      ASSERT_EQ(image->at(x, y), expected);
    }
  }
}

TEST(SliceImage, NoDataAndHiddenSamplesAreNotWater) {
  const SliceMap map = hand_map();
  LitVolume volume(map.sector(), kLit, -30.0, -40.0);
  volume.sv(4, 3, 20) = kNoData;
  volume.flags(4, 3, 30) = SampleFlags::interference | SampleFlags::low_snr;
  volume.flags(4, 3, 35) = SampleFlags::low_snr;
  const Theme theme = light_theme(kSize);
  const FlagStyle flags{SampleFlags::interference, SampleFlags::none, SampleFlags::low_snr};
  const auto image = *slice_image(map, volume.data(), sv_colours(kScale), flags, {}, theme);
  const auto pixel = [&](int sample) {
    const PixelPoint p = *map.place_of({4, 3, sample});
    return image.at(static_cast<int>(p.x), static_cast<int>(p.y));
  };
  EXPECT_EQ(pixel(20), theme.no_data);
  EXPECT_EQ(pixel(30), theme.no_data);
  EXPECT_EQ(pixel(25), (Rgba8{255, 255, 0, 255}));  // -40 dB: the seventh step, -42 to -39
  near(pixel(35), 255.0, 255.0, 0.7 * 255.0);       // 70 % white water, 30 % yellow
}

TEST(SliceImage, HatchKeepsMostOfTheColour) {
  const SliceMap map = hand_map();
  LitVolume volume(map.sector(), kLit, -40.0, -40.0);
  for (auto& f : volume.flags.all()) f = SampleFlags::corrupted;
  const Theme theme = light_theme(kSize);
  const FlagStyle flags{SampleFlags::none, SampleFlags::corrupted, SampleFlags::none};
  const auto image = *slice_image(map, volume.data(), sv_colours(kScale), flags, {}, theme);
  const auto inside = std::count_if(map.voxels().begin(), map.voxels().end(), [](int v) { return v >= 0; });
  const auto kept = std::count(image.pixels.begin(), image.pixels.end(), Rgba8{255, 255, 0, 255});
  EXPECT_NEAR(static_cast<double>(kept) / static_cast<double>(inside), 5.0 / 6.0, 0.01);
}

// White water; core half red, fuzzy a quarter: (255, 127.5, 127.5) and (255, 191, 191).
TEST(SliceImage, MasksAreBlendedOverTheData) {
  const SliceMap map = hand_map();
  const LitVolume volume(map.sector(), kLit, -90.0, -90.0);
  const Theme theme = light_theme(kSize);
  const PixelPoint p = *map.place_of(kLit);
  const auto colour = [&](std::uint8_t confidence, bool outline) {
    SliceData data = volume.data();
    data.masks.push_back({std::make_shared<PingMask>(one_voxel(kLit, confidence)), {1.0F, 0.0F, 0.0F}});
    SliceMaskStyle style;
    style.tint = true;
    style.core_strength = 0.5;
    style.fuzzy_strength = 0.25;
    style.outline = outline;
    return slice_image(map, data, sv_colours(kScale), {}, style, theme)
        ->at(static_cast<int>(p.x), static_cast<int>(p.y));
  };
  near(colour(255, false), 255, 127.5, 127.5);
  near(colour(164, false), 255, 127.5, 127.5);  // 164 / 255 = 0.643 >= 0.64
  near(colour(163, false), 255, 191.25, 191.25);
  near(colour(255, true), 255, 127.5, 127.5);  // the cell is 4 pixels by 15: its middle is not its edge
}

TEST(SliceImage, AnOutlineRunsAlongTheMasksEdge) {
  const SliceMap map = hand_map();
  const LitVolume volume(map.sector(), kLit, -90.0, -90.0);
  SliceData data = volume.data();
  data.masks.push_back({std::make_shared<PingMask>(PingMask{{{31, 18, 6}}, {9, 9, 9, 9, 9, 9}}), {1.0F, 0.0F, 0.0F}});
  const Theme theme = light_theme({640, 480});
  const auto image = *slice_image(map, data, sv_colours(kScale), {}, {}, theme);
  for (int y = 1; y < 399; ++y) {
    for (int x = 1; x < 399; ++x) {
      const auto member = [&](int px, int py) {
        const auto v = map.voxel_at({px + 0.5, py + 0.5});
        return v && v->fan == 4 && v->beam == 3 && v->sample >= 18 && v->sample < 24;
      };
      const bool whole = member(x - 1, y) && member(x + 1, y) && member(x, y - 1) && member(x, y + 1);
      const bool touched = member(x - 1, y) || member(x + 1, y) || member(x, y - 1) || member(x, y + 1);
      if (member(x, y)) {
        ASSERT_EQ(image.at(x, y) == (Rgba8{255, 0, 0, 255}), !whole);
      }
      if (!member(x, y) && touched) {
        ASSERT_EQ(image.at(x, y), theme.text);
      }
    }
  }
}

// line_dashes() of status_line(): dashes 0.7 of a text size with gaps of 0.3, dots 0.15 with gaps of 0.35.
TEST(SliceImage, AnUnreviewedSchoolsOutlineIsDashedAndARejectedOnesDotted) {
  const SliceMap map = hand_map();
  const LitVolume volume(map.sector(), kLit, -90.0, -90.0);
  PingMask arc;  // over all beams: its edges go in every direction
  for (int beam = 0; beam < 7; ++beam) arc.runs.push_back({28 + beam, 12, 20});
  arc.confidence.assign(std::size_t{7} * 20, 9);
  const Theme theme = light_theme({640, 480});
  const auto image = [&](const std::string& status) {
    SliceData data = volume.data();
    data.masks.push_back({std::make_shared<PingMask>(arc), {1.0F, 0.0F, 0.0F}, status_line(status)});
    return *slice_image(map, data, sv_colours(kScale), {}, {}, theme);
  };
  const Rgba8 red{255, 0, 0, 255};
  const Image solid = image("accepted");
  EXPECT_EQ(solid.pixels, image("corrected").pixels);
  const auto share_of = [&](const Image& broken) {
    double drawn = 0.0;
    double all = 0.0;
    for (std::size_t i = 0; i < solid.pixels.size(); ++i) {
      EXPECT_TRUE(broken.pixels[i] != red || solid.pixels[i] == red);  // nothing is drawn off the outline
      if (solid.pixels[i] == red) ++all;
      if (broken.pixels[i] == red) ++drawn;
    }
    return drawn / all;
  };
  EXPECT_NEAR(share_of(image("unreviewed")), 0.7, 0.08);
  EXPECT_NEAR(share_of(image("rejected")), 0.3, 0.08);
}

// One beam seen from the side, as thin as the outline: it must not vanish where the count does not change along it.
TEST(SliceImage, WhatIsAsThinAsItsOutlineIsDashedToo) {
  const Sector sector = hand_sector();
  const SliceMap map(sector, kTop, {-2000, -2000, 2000, 2000}, kSize);
  const LitVolume volume(sector, kLit, -90.0, -90.0);
  PingMask arc;
  for (int beam = 0; beam < 7; ++beam) arc.runs.push_back({28 + beam, 30, 2});
  arc.confidence.assign(std::size_t{7} * 2, 9);
  const Theme theme = light_theme({640, 480});
  const auto red = [&](OutlineLine line) {
    SliceData data = volume.data();
    data.masks.push_back({std::make_shared<PingMask>(arc), {1.0F, 0.0F, 0.0F}, line});
    const Image image = *slice_image(map, data, sv_colours(kScale), {}, {}, theme);
    return std::count(image.pixels.begin(), image.pixels.end(), Rgba8{255, 0, 0, 255});
  };
  EXPECT_LT(red(OutlineLine::dashed), red(OutlineLine::solid));
  EXPECT_GT(red(OutlineLine::dashed), red(OutlineLine::solid) / 3);
}

TEST(SliceImage, WhatDoesNotBelongIsRefused) {
  const SliceMap map = hand_map();
  const LitVolume other(slice_example::sectors()[0].sector, {0, 0, 0}, -40.0, -90.0);
  EXPECT_EQ(slice_image(map, other.data(), sv_colours(kScale), {}, {}, {}).error().code, ErrorCode::mismatch);
  const LitVolume volume(map.sector(), kLit, -40.0, -90.0);
  for (const PingMask& bad : {PingMask{{{56, 0, 1}}, {1}}, PingMask{{{0, 40, 2}}, {1, 1}}, PingMask{{{-1, 0, 1}}, {1}},
                              PingMask{{{0, 0, 3}}, {1}}, PingMask{{{0, 5, 2147483647}}, {1}}}) {
    SliceData data = volume.data();
    data.masks.push_back({std::make_shared<PingMask>(bad), {}});
    EXPECT_EQ(slice_image(map, data, sv_colours(kScale), {}, {}, {}).error().code, ErrorCode::mismatch);
  }
}

TEST(SlicePicture, PointerAndAxesAgree) {
  const Sector sector = hand_sector();
  const LitVolume volume(sector, kLit, -30.0, -90.0);
  SlicePing ping;
  ping.transducer_depth_m = 7.0;
  const PixelSize size{1024, 768};
  const auto side = slice_picture(sector, volume.data(), ping, {SideSlice{3}}, {}, light_theme(size), size);
  ASSERT_TRUE(side.has_value());
  const PixelPoint p = *side->place_of(kLit);
  EXPECT_EQ(side->voxel_at(p), kLit);
  EXPECT_NEAR(side->plot.x_at(p.x), 100.0 * std::cos(rad_from_deg(30.0)), 1e-6);
  EXPECT_NEAR(side->plot.y_at(p.y), 57.0, 1e-6);
  // One metre is as long down as across.
  EXPECT_NEAR((side->plot.x.last - side->plot.x.first) / side->plot.place.width,
              (side->plot.y.last - side->plot.y.first) / side->plot.place.height, 1e-12);
}

// Heading 35: the beam at 270 from the bow looks along bearing 305.
TEST(SlicePicture, NorthUpReadsEastAndNorth) {
  const Sector sector = hand_sector();
  const LitVolume volume(sector, kLit, -30.0, -90.0);
  SlicePing ping;
  ping.heading_rad = rad_from_deg(35.0);
  SliceStyle style;
  style.north_up = true;
  const PixelSize size{800, 600};
  const double h = 100.0 * std::cos(rad_from_deg(30.0));
  for (const SliceView& view :
       {SliceView{TopSlice{4}, -ping.heading_rad}, SliceView{horizontal_plane(50.0, 0.0), -ping.heading_rad}}) {
    const auto top = slice_picture(sector, volume.data(), ping, view, style, light_theme(size), size);
    ASSERT_TRUE(top.has_value());
    const PixelPoint p = *top->place_of(kLit);
    EXPECT_NEAR(top->plot.x_at(p.x), h * std::sin(rad_from_deg(305.0)), 1e-6);
    EXPECT_NEAR(top->plot.y_at(p.y), h * std::cos(rad_from_deg(305.0)), 1e-6);
    EXPECT_EQ(top->plot.x.label, "east (m)");
  }
}

// Law: seen from above with the bow up, a place's number along the axis is its distance to the side that the axis names;
// where the sonar looks to both sides there is no sign.
TEST(SlicePicture, TheSideIsTheOneThatTheSonarLooksTo) {
  const PixelSize size{800, 600};
  for (const auto& [name, sector] : slice_example::sectors()) {
    const bool port = name == "port" || name == "uneven" || name == "one beam";
    const Voxel lit{0, sector.beams() - 1, 60};
    const LitVolume volume(sector, lit, -30.0, -90.0);
    const double y = sector.centre(lit.fan, lit.beam, lit.sample).y;
    for (const SliceView& view : {SliceView{TopSlice{0}}, SliceView{horizontal_plane(20.0, 0.0)}}) {
      const auto top = slice_picture(sector, volume.data(), {}, view, {}, light_theme(size), size);
      ASSERT_TRUE(top.has_value()) << name;
      const PlotAxis& x = top->plot.x;
      EXPECT_EQ(x.label, port ? "port (m)" : name == "starboard" ? "starboard (m)" : "port | starboard (m)") << name;
      if (std::holds_alternative<TopSlice>(view.slice)) {
        EXPECT_NEAR(top->plot.x_at(top->place_of(lit)->x), port ? -y : y, 1e-6) << name;
      }
      if (x.both_ways) {
        FrameDescription frame;
        PlotFrame alone = top->plot;
        alone.y = {100.0, 10.0, "", false};
        add_axes(frame, alone, light_theme(size));
        for (const auto& item : frame.items) {
          const auto* text = std::get_if<TextItem>(&item);
          EXPECT_TRUE(text == nullptr || text->text.find("\u2212") == std::string::npos) << name;
        }
        EXPECT_LT(x.first, 0.0) << name;
        EXPECT_GT(x.last, 0.0) << name;
      }
    }
  }
}

// By hand: an origin 30 m astern and 40 m to port, and its mirror image.
TEST(SlicePicture, AnObliquePlanesPlaceIsNamedByItsSide) {
  const Sector sector = hand_sector();
  SlicePing ping;
  ping.transducer_depth_m = 7.0;
  PlaneSlice plane = vertical_plane(rad_from_deg(270.0));
  plane.kind = PlaneSlice::Kind::oblique;
  plane.origin = {-30.0, -40.0, 50.0};
  EXPECT_EQ(slice_text(sector, {plane}, ping, {}), "Oblique plane through 30.0 m astern, 40.0 m to port, depth 57.0 m");
  plane.origin = {30.0, 40.0, 50.0};
  EXPECT_EQ(slice_text(sector, {plane}, ping, {}),
            "Oblique plane through 30.0 m ahead, 40.0 m to starboard, depth 57.0 m");
}

// No sample is known: the sector is drawn in the colour of "no data" with all its decorations, in every slice.
TEST(SlicePicture, APingWithoutDataIsDrawnAsNoData) {
  const Sector sector = hand_sector();
  LitVolume volume(sector, kLit, -30.0, -90.0);
  for (auto& sv : volume.sv.all()) sv = kNoData;
  const PixelSize size{800, 600};
  const Theme theme = light_theme(size);
  for (const SliceView& view :
       {kTop, SliceView{SideSlice{3}}, SliceView{RangeSlice{20}}, SliceView{horizontal_plane(50.0, 0.0)},
        SliceView{vertical_plane(rad_from_deg(270.0))}}) {
    const auto picture = slice_picture(sector, volume.data(), {}, view, {}, theme, size);
    ASSERT_TRUE(picture.has_value());
    EXPECT_EQ(std::ranges::count(texts_of(*picture), "no data in this ping"), 1);
    const SliceMap& map = *picture->map;
    const auto image = slice_image(map, volume.data(), sv_colours(kScale), {}, {}, theme);
    ASSERT_TRUE(image.has_value());
    std::ptrdiff_t drawn = 0;
    for (const Rgba8& pixel : image->pixels) {
      if (pixel.a == 0) continue;
      ++drawn;
      ASSERT_EQ(pixel, theme.no_data);
    }
    EXPECT_EQ(drawn, std::count_if(map.voxels().begin(), map.voxels().end(), [](int v) { return v >= 0; }));
    EXPECT_GT(drawn, 1000);
  }
}

TEST(SlicePicture, TheMapIsUsedAgainForTheNextPing) {
  const Sector sector = hand_sector();
  const LitVolume volume(sector, kLit, -30.0, -90.0);
  const PixelSize size{640, 480};
  const Theme theme = dark_theme(size);
  const auto first = slice_picture(sector, volume.data(), {}, kTop, {}, theme, size);
  const auto second = slice_picture(hand_sector(), volume.data(), {}, kTop, {}, theme, size, first->map);
  EXPECT_EQ(first->map, second->map);
  const auto third = slice_picture(sector, volume.data(), {}, {TopSlice{5}}, {}, theme, size, first->map);
  EXPECT_NE(first->map, third->map);
}

TEST(SlicePicture, TitlesNameThePingAndTheSlice) {
  const Sector sector = hand_sector();
  const LitVolume volume(sector, kLit, -30.0, -90.0);
  SlicePing ping{"obs-0001", 12, *time_from_iso("2026-11-21T19:57:26.123Z"), 0.0, 7.0, std::vector<double>(8, 75000.0)};
  const PixelSize size{800, 600};
  const auto top = slice_picture(sector, volume.data(), ping, kTop, {}, light_theme(size), size);
  const std::vector<std::string> texts = texts_of(*top);
  for (const std::string expected :
       {"obs-0001   ping 12", "2026-11-21 19:57:26.123 UTC",
        "Top: fan 4, elevation \u221230.0\u00B0, 75.0 kHz; bearings from the bow", "port (m)", "ahead (m)",
        "Sv (dB re 1 m\u207B\u00B9)", "100 m", "270\u00B0", "N"}) {
    EXPECT_NE(std::find(texts.begin(), texts.end(), expected), texts.end()) << expected;
  }
}

// Heading 20: the beam at 270 from the bow looks along 290. Bow up it is labelled 270, north up 290; the title says which.
TEST(SlicePicture, TitlesSayWhatBearingsStartFrom) {
  const Sector sector = hand_sector();
  const LitVolume volume(sector, kLit, -30.0, -90.0);
  const PixelSize size{800, 600};
  SlicePing ping;
  const auto second_line = [&](const SliceView& view, bool north_up, bool rings = true) {
    SliceStyle style;
    style.north_up = north_up;
    style.rings = rings;
    return slice_picture(sector, volume.data(), ping, view, style, light_theme(size), size)->frame.title;
  };
  const SliceView level{horizontal_plane(50.0, 0.0)};
  EXPECT_EQ(second_line(level, true), "Horizontal plane, depth 50.0 m; bearings from the bow") << "no heading";
  EXPECT_EQ(second_line({SideSlice{3}}, false), "Side: beam 3, 270.0\u00B0 from the bow");
  ping.heading_rad = rad_from_deg(20.0);
  EXPECT_EQ(second_line(level, false), "Horizontal plane, depth 50.0 m; bearings from the bow");
  EXPECT_EQ(second_line(level, true), "Horizontal plane, depth 50.0 m; true bearings");
  EXPECT_EQ(second_line(level, true, false), "Horizontal plane, depth 50.0 m");
  EXPECT_EQ(second_line({SideSlice{3}}, false), "Side: beam 3, 270.0\u00B0 from the bow, true bearing 290.0\u00B0");
  EXPECT_EQ(second_line({vertical_plane(rad_from_deg(270.0))}, false),
            "Vertical plane, true bearing 290.0\u00B0 to the right");
  ping.moved = true;
  EXPECT_EQ(second_line(level, true), "Horizontal plane, depth 50.0 m, straight and level beams; true bearings");
}

// Words lie over lines, never under them.
TEST(SlicePicture, LabelsOfRingsAndBearingsAreDrawnOverTheirLines) {
  const Sector sector = hand_sector();
  const LitVolume volume(sector, kLit, -30.0, -90.0);
  const PixelSize size{800, 600};
  const auto top = slice_picture(sector, volume.data(), {}, kTop, {}, light_theme(size), size);
  std::size_t last_line = 0;
  std::size_t first_word = top->frame.items.size();
  for (std::size_t i = 0; i < top->frame.items.size(); ++i) {
    const auto* path = std::get_if<PathItem>(&top->frame.items[i]);
    if (path != nullptr && !path->stroke.dashes_px.empty()) last_line = i;
    const auto* text = std::get_if<TextItem>(&top->frame.items[i]);
    if (text != nullptr) first_word = std::min(first_word, i);
  }
  EXPECT_LT(last_line, first_word);
}

// Rays of a known profile begin at the transducer and end where sound is when straight paths end; nothing else changes.
TEST(SlicePicture, TheSideShowsBentRays) {
  const SliceMap map(hand_sector(), SliceView{SideSlice{3}}, {0, -200, 400, 200}, kSize);  // a pixel a metre
  SlicePing ping;
  FrameDescription straight;
  add_slice_context(straight, map, {}, ping, {}, light_theme(kSize));
  const RangeAxis& range = map.sector().range();
  const double far_m = range.range_m(range.count - 0.5);
  const SoundProfile profile{{0, 1500}, {500, 1400}};
  ping.rays = std::make_shared<const Refraction>(profile, 7.0, 1500.0, far_m);
  FrameDescription bent;
  add_slice_context(bent, map, {}, ping, {}, light_theme(kSize));
  ASSERT_EQ(bent.items.size(), straight.items.size() + 1);
  const PixelPoint from = map.pixel_of(0.0, 0.0);
  std::size_t rays = 0;
  for (const auto& item : bent.items) {
    const auto* path = std::get_if<PathItem>(&item);
    if (path == nullptr) continue;
    for (const PathItem::Part& part : path->parts) {
      if (part.points.size() < 50 || part.points.front() != from) continue;
      ++rays;
      const PixelPoint next = part.points[1];
      SoundRay ray(profile, 7.0, -std::atan2(next.y - from.y, next.x - from.x));
      ray.advance(far_m / 1500.0);
      EXPECT_NEAR(part.points.back().x - from.x, ray.place().distance_m, 0.3);
      EXPECT_NEAR(part.points.back().y - from.y, ray.place().depth_m - 7.0, 0.3);
    }
  }
  EXPECT_GT(rays, 1U);
}

TEST(SlicePicture, BadRequestsAreRefusedInOneLine) {
  const Sector sector = hand_sector();
  const LitVolume volume(sector, kLit, -30.0, -90.0);
  const Theme theme = light_theme({640, 480});
  const auto error = [&](const SliceView& view, PixelSize size) {
    return slice_picture(sector, volume.data(), {}, view, {}, theme, size).error();
  };
  EXPECT_EQ(error({TopSlice{9}}, {640, 480}).text, "there is no fan 9; expected 0 to 7");
  EXPECT_EQ(error({horizontal_plane(900.0, 7.0)}, {640, 480}).text, "the slice does not meet the sonar's sector");
  EXPECT_EQ(error(kTop, {100, 100}).code, ErrorCode::bad_parameter);
  EXPECT_EQ(slice_picture(Sector{}, {}, {}, kTop, {}, theme, {640, 480}).error().code, ErrorCode::bad_parameter);
  EXPECT_EQ(flag_text(SampleFlags::interference | SampleFlags::low_snr), "interference, low signal");
}

}  // namespace
}  // namespace sonar
