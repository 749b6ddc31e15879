// SPDX-License-Identifier: Apache-2.0
#include "view/slices/slice_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <variant>
#include <vector>

#include "geo/refraction.h"
#include "view/slices/slice_context.h"
#include "view/slices/slice_example.h"

namespace sonar {
namespace {

constexpr SvScale kScale{.map = ColourMapName::ek500};

using slice_example::hand_sector;
using slice_example::kLit;
using slice_example::kTop;
using slice_example::LitVolume;
using slice_example::texts_of;

constexpr PixelSize kSize{400, 400};

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

// Law: seen from above with the bow up, places have their distance to the side as a number without a sign, and the label
// names every side that has one.
TEST(SlicePicture, SidesThatTheAxisShowsAreNamedAndNumbersHaveNoSign) {
  for (const auto& [name, sector] : slice_example::sectors()) {
    const bool port = name == "port" || name == "uneven" || name == "one beam";
    const Voxel lit{0, sector.beams() - 1, 60};
    const LitVolume volume(sector, lit, -30.0, -90.0);
    const double y = sector.centre(lit.fan, lit.beam, lit.sample).y;
    for (const SliceView& view : {SliceView{TopSlice{0}}, SliceView{horizontal_plane(20.0, 0.0)}}) {
      for (const PixelSize size :
           {PixelSize{500, 900}, PixelSize{1600, 400}, PixelSize{640, 480}, PixelSize{300, 300}, PixelSize{220, 300}}) {
        const auto top = slice_picture(sector, volume.data(), {}, view, {}, light_theme(size), size);
        ASSERT_TRUE(top.has_value()) << name;
        const PlotAxis& x = top->plot.x;
        if (size.width == 500) {  // grown upwards alone: the side that the sonar looks to, and a margin
          EXPECT_EQ(x.label, port                  ? "port (m)"
                             : name == "starboard" ? "starboard (m)"
                                                   : "port | starboard (m)")
              << name;
        }
        if (std::holds_alternative<TopSlice>(view.slice)) {
          EXPECT_NEAR(top->plot.x_at(top->place_of(lit)->x), y, 1e-6) << name;
        }
        FrameDescription frame;
        PlotFrame alone = top->plot;
        alone.y = {100.0, 10.0, "", false};
        add_axes(frame, alone, light_theme(size));
        const double zero_px = alone.at(0.0, 50.0).x;
        bool left = false;
        bool right = false;
        for (const auto& item : frame.items) {
          const auto* text = std::get_if<TextItem>(&item);
          if (text == nullptr) continue;
          EXPECT_EQ(text->text.find("\u2212"), std::string::npos) << name;
          if (text->at.y < alone.place.y + alone.place.height + 1.0 || text->text == x.label) continue;
          left = left || text->at.x < zero_px - 1.0;
          right = right || text->at.x > zero_px + 1.0;
        }
        const bool longer_left = std::abs(x.first) > std::abs(x.last);
        const std::string sides = left && right                     ? "port | starboard (m)"
                                  : left || (!right && longer_left) ? "port (m)"
                                                                    : "starboard (m)";
        EXPECT_EQ(x.label, sides) << name << " in " << size.width;
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
        "Top: fan 4, elevation \u221230.0\u00B0, 75.0 kHz; bearings from the bow", "port | starboard (m)", "ahead (m)",
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
