// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "view/school_look.h"
#include "view/slices/slice_example.h"
#include "view/slices/slice_picture.h"

namespace sonar {
namespace {

using slice_example::hand_sector;
using slice_example::kLit;
using slice_example::kTop;
using slice_example::LitVolume;

constexpr SvScale kScale{.map = ColourMapName::ek500};
constexpr PixelSize kSize{400, 400};

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

}  // namespace
}  // namespace sonar
