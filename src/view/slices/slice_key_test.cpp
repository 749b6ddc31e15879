// SPDX-License-Identifier: Apache-2.0
#include "view/slices/slice_picture.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "view/slices/slice_example.h"

namespace sonar {
namespace {

using slice_example::hand_sector;
using slice_example::kLit;
using slice_example::kTop;
using slice_example::LitVolume;
using slice_example::texts_of;

// What is not drawn as recorded is said below the slice, in the flags' own words; a plain slice has no key.
TEST(SlicePicture, AKeySaysWhatIsNotDrawnAsRecorded) {
  const Sector sector = hand_sector();
  const LitVolume volume(sector, kLit, -30.0, -90.0);
  const auto words = [&](const SliceStyle& style, PixelSize size) {
    const auto picture = slice_picture(sector, volume.data(), {}, kTop, style, light_theme(size), size);
    for (const auto& item : picture->frame.items) {
      if (const auto* text = std::get_if<TextItem>(&item)) {
        EXPECT_LE(
            text->at.x + (text->anchor == TextAnchor::left ? text_width_px(text->text.c_str(), text->size_px) : 0),
            size.width)
            << text->text;
        EXPECT_LE(text->at.y + 0.5 * text->size_px, size.height) << text->text;
      }
    }
    return std::pair(texts_of(*picture), picture->plot.place);
  };
  const auto said = [](const auto& picture, const std::string& text) {
    return std::ranges::count(picture.first, text) == 1;
  };
  for (const PixelSize size : {PixelSize{800, 600}, PixelSize{320, 240}}) {
    SliceStyle style;
    const auto bare = words(style, size);
    style.key = SliceKey{};
    const auto plain = words(style, size);
    EXPECT_EQ(plain, bare) << "nothing to explain";
    style.flags = {.hidden = SampleFlags::seabed,
                   .hatched = SampleFlags::interference | SampleFlags::seabed,
                   .faded = SampleFlags::near_field | SampleFlags::low_snr};
    style.key->weak_below_db = 3.0;
    style.key->schools.push_back({{255, 0, 0, 255}, OutlineLine::dashed, "school 7, unreviewed"});
    const auto explained = words(style, size);
    for (const char* expected : {"hatched: interference", "faded: near field", "faded: below 3 dB signal-to-noise",
                                 "not drawn: seabed", "school 7, unreviewed"}) {
      EXPECT_TRUE(said(explained, expected)) << expected << " at " << size.width;
    }
    EXPECT_LT(explained.second.height, plain.second.height) << "the key takes its own room";
  }
}

// A school that the slice does not cut is not in its key; one that it cuts is, with what core and fuzzy area are.
TEST(SlicePicture, AKeyNamesTheSchoolsThatTheSliceCuts) {
  const Sector sector = hand_sector();
  const LitVolume volume(sector, kLit, -30.0, -90.0);
  SliceData data = volume.data();
  for (const int fan : {2, 5}) {
    auto mask = std::make_shared<PingMask>();
    mask->runs = {{fan * sector.beams() + 3, 10, 6}};
    mask->confidence.assign(6, 200);
    data.masks.push_back({mask, {1.0F, 0.0F, 0.0F}});
  }
  SliceStyle style;
  style.key = SliceKey{};
  style.key->schools = {{{255, 0, 0, 255}, OutlineLine::solid, "school 7", 0},
                        {{0, 255, 0, 255}, OutlineLine::solid, "school 8", 1}};
  const PixelSize size{800, 600};
  const auto words = [&](int fan) {
    return texts_of(*slice_picture(sector, data, {}, {TopSlice{fan}}, style, light_theme(size), size));
  };
  const auto said = [](const auto& all, const std::string& text) { return std::ranges::count(all, text) == 1; };
  EXPECT_TRUE(said(words(2), "school 7"));
  EXPECT_FALSE(said(words(2), "school 8"));
  EXPECT_TRUE(said(words(5), "school 8"));
  EXPECT_FALSE(said(words(5), "school 7"));
  EXPECT_TRUE(said(words(5), "core, confidence 0.64 and more"));
  EXPECT_FALSE(said(words(5), "fuzzy area, below that")) << "the outline is round it";
  EXPECT_FALSE(said(words(0), "core, confidence 0.64 and more"));
  style.masks.tint = true;
  EXPECT_TRUE(said(words(5), "core, confidence 0.64 and more"));
  EXPECT_TRUE(said(words(5), "fuzzy area, below that"));
  EXPECT_FALSE(said(words(0), "fuzzy area, below that"));
}

// Switched off, schools leave their room in the key: nothing else of the picture moves.
TEST(SlicePicture, SchoolsThatAreNotShownChangeNothingElse) {
  const Sector sector = hand_sector();
  const LitVolume volume(sector, kLit, -30.0, -90.0);
  const PixelSize size{640, 480};
  SliceData data = volume.data();
  SliceStyle style;
  style.flags.hatched = SampleFlags::interference;
  style.key = SliceKey{};
  for (std::size_t i = 0; i < 4; ++i) {
    auto mask = std::make_shared<PingMask>();
    mask->runs = {{4 * sector.beams() + static_cast<int>(i), 20, 6}};
    mask->confidence.assign(6, 200);
    data.masks.push_back({mask, {1.0F, 0.0F, 0.0F}});
    style.key->schools.push_back({{255, 0, 0, 255}, OutlineLine::solid, "a school, unreviewed", i});
  }
  SliceData bare = data;
  bare.masks.clear();
  const auto drawn = [&](const SliceData& of, const SliceStyle& as) {
    return *slice_picture(sector, of, {}, kTop, as, light_theme(size), size);
  };
  const auto image_of = [](const SlicePicture& picture) {
    for (const auto& item : picture.frame.items) {
      if (const auto* image = std::get_if<ImageItem>(&item)) return *image->image;
    }
    return Image{};
  };
  const SlicePicture with = drawn(data, style);
  style.masks.shown = false;
  const SlicePicture without = drawn(data, style);
  EXPECT_EQ(with.plot.place, without.plot.place);
  EXPECT_NE(image_of(with), image_of(without));
  auto words = texts_of(with);
  std::erase_if(words, [](const std::string& w) { return w.starts_with("a school") || w.starts_with("core"); });
  EXPECT_EQ(words, texts_of(without));
  // The same data drawn as though there had never been a school, in the same place.
  const auto image = slice_image(*without.map, bare, style.colours, style.flags, style.masks, light_theme(size));
  EXPECT_EQ(image_of(without), *image);
}

// The key begins where the slice begins.
TEST(SlicePicture, AKeyStandsBelowItsSlice) {
  const Layout layout = lay_out({800, 600}, light_theme({800, 600}), {.foot_lines = 2});
  EXPECT_EQ(layout.foot.x, layout.plot.x);
  EXPECT_LE(layout.foot.x + layout.foot.width, 800.0);
}

TEST(SlicePicture, AKeySaysThatTheSeabedWasTakenOut) {
  const Sector sector = hand_sector();
  const LitVolume volume(sector, kLit, -30.0, -90.0);
  SliceStyle style;
  style.key = SliceKey{.filtered = true};
  style.flags.hidden = kNotFiltered;
  const PixelSize size{800, 600};
  const auto words = texts_of(*slice_picture(sector, volume.data(), {}, kTop, style, light_theme(size), size));
  EXPECT_EQ(std::ranges::count(words, std::string("taken out: noise, near field, surface, seabed")), 1);
  EXPECT_TRUE(std::ranges::none_of(words, [](const std::string& w) { return w.starts_with("not drawn"); }));
}

// One beam lies in shadow from its sample 20 on: stripes there and nowhere else, and a word for them in the key.
TEST(SlicePicture, ShadowIsHatchedFromItsSampleOn) {
  const Sector sector = hand_sector();
  const LitVolume volume(sector, kLit, -30.0, -60.0);
  const PixelSize size{800, 600};
  SliceStyle style;
  style.key = SliceKey{};
  SliceData data = volume.data();
  data.shadow_from.assign(56, 41);
  data.shadow_from[4 * 7 + 3] = 20;
  const auto picture = slice_picture(sector, data, {}, kTop, style, light_theme(size), size);
  ASSERT_TRUE(picture);
  EXPECT_EQ(std::ranges::count(texts_of(*picture), "in the shadow of schools"), 1);
  const auto image = slice_image(*picture->map, data, style.colours, style.flags, style.masks, light_theme(size));
  const auto plain =
      slice_image(*picture->map, volume.data(), style.colours, style.flags, style.masks, light_theme(size));
  ASSERT_TRUE(image && plain);
  int striped = 0;
  int in_shadow = 0;
  for (int y = 0; y < image->size.height; ++y) {
    for (int x = 0; x < image->size.width; ++x) {
      const auto voxel = picture->map->voxel_at({x + 0.5, y + 0.5});
      const bool behind = voxel && voxel->beam == 3 && voxel->sample >= 20;
      const bool changed = !(image->at(x, y) == plain->at(x, y));
      in_shadow += behind ? 1 : 0;
      striped += changed ? 1 : 0;
      EXPECT_TRUE(behind || !changed) << x << ' ' << y;
    }
  }
  EXPECT_GT(striped, in_shadow / 10);
  EXPECT_LT(striped, in_shadow / 2);
}

}  // namespace
}  // namespace sonar
