// SPDX-License-Identifier: Apache-2.0
#include "view/slices/slice_steps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "view/slices/slice_example.h"

namespace sonar {
namespace {

using slice_example::hand_sector;
using slice_example::kLit;
using slice_example::kTop;
using Shows = SliceStepPlace::Shows;

constexpr PixelSize kSize{1200, 800};

std::int16_t counts(double db) { return static_cast<std::int16_t>(std::lround(counts_from_db(db))); }

/// Three steps by hand: -40 dB everywhere; interference takes out one voxel; a filter fills it in at -46 dB and lowers the
/// voxel beside it by 12 dB.
class ThreeSteps : public testing::Test {
 protected:
  ThreeSteps() {
    filtered_(kLit.fan, kLit.beam, kLit.sample) = counts(-46.0);
    filtered_(kLit.fan, kLit.beam, kLit.sample + 4) = counts(-52.0);
    flags_(kLit.fan, kLit.beam, kLit.sample) = SampleFlags::interference;
    ping_.observation = "obs-0001";
    ping_.ping_index = 7;
    data_.flags = std::as_const(flags_).view();
    const auto add = [&](const char* name, const Array3<std::int16_t>& sv, SampleFlags out) {
      SliceStep step;
      step.name = name;
      step.words = {std::string("what ") + name + " did"};
      step.sv = sv.view();
      step.taken_out = out;
      data_.steps.push_back(std::move(step));
    };
    add("Unfiltered", recorded_, SampleFlags::none);
    add("Interference", recorded_, SampleFlags::interference);
    add("Filter", filtered_, SampleFlags::none);
  }
  SliceStepsPicture picture() {
    auto made = slice_steps(sector_, data_, ping_, kTop, style_, light_theme(kSize), kSize);
    EXPECT_TRUE(made) << to_line(made.error());
    return made ? std::move(*made) : SliceStepsPicture{};
  }
  /// The image that was drawn at a place.
  static const Image& image(const SliceStepsPicture& picture, const SliceStepPlace& place) {
    for (const auto& item : picture.frame.items) {
      if (const auto* one = std::get_if<ImageItem>(&item); one && one->place == place.plot) return *one->image;
    }
    static const Image none;
    ADD_FAILURE();
    return none;
  }
  /// The colour of a voxel there.
  static Rgba8 colour(const SliceStepsPicture& picture, Shows shows, std::size_t step, const Voxel& voxel) {
    const auto place = std::find_if(picture.places.begin(), picture.places.end(),
                                    [&](const SliceStepPlace& one) { return one.shows == shows && one.step == step; });
    EXPECT_NE(place, picture.places.end());
    const PixelPoint at = *picture.map_of(*place).place_of(voxel);
    return image(picture, *place).at(static_cast<int>(at.x), static_cast<int>(at.y));
  }

  Sector sector_ = hand_sector();
  Array3<std::int16_t> recorded_{{8, 7, 41}, counts(-40.0)};
  Array3<std::int16_t> filtered_{{8, 7, 41}, counts(-40.0)};
  Array3<SampleFlags> flags_{{8, 7, 41}};
  SliceStepsData data_;
  SlicePing ping_;
  SliceStepsStyle style_;
};

TEST_F(ThreeSteps, StandSideBySideInOneExtentAndOneScale) {
  style_.mark = false;
  const SliceStepsPicture out = picture();
  ASSERT_EQ(out.places.size(), 3U);
  EXPECT_FALSE(out.large);
  for (const SliceStepPlace& one : out.places) {
    EXPECT_EQ(one.shows, Shows::step);
    EXPECT_EQ(one.plot.width, out.places[0].plot.width);
    EXPECT_EQ(one.plot.height, out.places[0].plot.height);
    for (const SliceStepPlace& other : out.places) {
      if (&one == &other) continue;
      const bool apart =
          one.place.x + one.place.width <= other.place.x || other.place.x + other.place.width <= one.place.x ||
          one.place.y + one.place.height <= other.place.y || other.place.y + other.place.height <= one.place.y;
      EXPECT_TRUE(apart);
    }
  }
  const Theme theme = light_theme(kSize);
  const Rgba8 loud = style_.colours[counts(-40.0)];
  EXPECT_EQ(colour(out, Shows::step, 0, kLit), loud);
  EXPECT_EQ(colour(out, Shows::step, 1, kLit), theme.no_data) << "taken out";
  EXPECT_EQ(colour(out, Shows::step, 2, kLit), style_.colours[counts(-46.0)]);
  EXPECT_EQ(colour(out, Shows::step, 1, {4, 2, 20}), loud);
}

TEST_F(ThreeSteps, MarkWhatEachChangedAgainstTheOneBefore) {
  const SliceStepsPicture out = picture();
  const Theme theme = light_theme(kSize);
  EXPECT_NE(colour(out, Shows::step, 0, kLit), theme.accent);
  EXPECT_EQ(colour(out, Shows::step, 1, kLit), theme.accent);
  // Stripes: some pixels of a voxel, not all.
  const auto marked = [&](const Voxel& voxel) {
    const Image& drawn = image(out, out.places[2]);
    std::set<bool> seen;
    for (std::size_t i = 0; i < drawn.pixels.size(); ++i) {
      const int x = static_cast<int>(i) % drawn.size.width;
      const int y = static_cast<int>(i) / drawn.size.width;
      if (out.map->voxel_at({x + 0.5, y + 0.5}) == voxel) seen.insert(drawn.pixels[i] == theme.accent);
    }
    return seen;
  };
  EXPECT_EQ(marked(kLit), (std::set<bool>{false, true})) << "filled in";
  EXPECT_EQ(marked({4, 3, 24}), (std::set<bool>{false, true})) << "changed by 12 dB";
  EXPECT_EQ(marked({4, 3, 28}), (std::set<bool>{false}));
  style_.mark_db = 12.5;
  const SliceStepsPicture fewer = picture();
  const PixelPoint at = *fewer.map->place_of({4, 3, 24});
  const Image& drawn = image(fewer, fewer.places[2]);
  for (int dx = -2; dx <= 2; ++dx)
    EXPECT_NE(drawn.at(static_cast<int>(at.x) + dx, static_cast<int>(at.y)), theme.accent);
}

// By hand: -12 dB of 20 are at 0.5 - 0.3 of the scale, 0.8 from its first colour (at 0) to the second (at 0.25).
TEST_F(ThreeSteps, TwoOfThemAreComparedWithTheirDifference) {
  style_.compared = {0, 2};
  const SliceStepsPicture out = picture();
  ASSERT_EQ(out.places.size(), 6U);
  ASSERT_TRUE(out.large);
  EXPECT_EQ(out.places[0].shows, Shows::before);
  EXPECT_EQ(out.places[1].shows, Shows::after);
  EXPECT_EQ(out.places[2].shows, Shows::difference);
  EXPECT_GT(out.places[0].plot.height, 2.0 * out.places[3].plot.height);
  const Theme theme = light_theme(kSize);
  const Rgba8 mid = colour(out, Shows::difference, 2, {4, 2, 20});
  EXPECT_EQ(mid, theme.water) << "no difference: the scale's middle";
  const Rgba8 lower = colour(out, Shows::difference, 2, {4, 3, 24});
  EXPECT_NEAR(lower.r, 5 + 0.8 * (67 - 5), 1.5);
  EXPECT_NEAR(lower.g, 48 + 0.8 * (147 - 48), 1.5);
  EXPECT_NEAR(lower.b, 97 + 0.8 * (195 - 97), 1.5);
  // The other way round it is louder.
  style_.compared = {2, 0};
  const SliceStepsPicture back = picture();
  const Rgba8 louder = colour(back, Shows::difference, 0, {4, 3, 24});
  EXPECT_GT(louder.r, louder.b);
  style_.compared = {1, 2};
  EXPECT_NE(colour(picture(), Shows::difference, 2, {4, 2, 20}), theme.accent);
  style_.compared = {0, 1};
  EXPECT_EQ(colour(picture(), Shows::difference, 1, kLit), theme.accent) << "there before alone";
}

TEST_F(ThreeSteps, FindTheVoxelUnderAPointerInEveryPicture) {
  style_.compared = {0, 2};
  const SliceStepsPicture out = picture();
  for (const SliceStepPlace& one : out.places) {
    const PixelPoint on_map = *out.map_of(one).place_of(kLit);
    EXPECT_EQ(out.voxel_at({one.plot.x + on_map.x, one.plot.y + on_map.y}), kLit);
    EXPECT_EQ(out.at({one.place.x + 1.0, one.place.y + 1.0}), &one);
  }
  EXPECT_FALSE(out.voxel_at({0.0, 0.0}));
}

TEST_F(ThreeSteps, WhatCannotBeDrawnIsRefused) {
  const Theme theme = light_theme(kSize);
  EXPECT_FALSE(slice_steps(sector_, data_, ping_, kTop, style_, theme, {100, 100}));
  EXPECT_FALSE(slice_steps(sector_, data_, ping_, {TopSlice{8}}, style_, theme, kSize));
  EXPECT_FALSE(slice_steps(sector_, {}, ping_, kTop, style_, theme, kSize));
  style_.compared = {0, 3};
  EXPECT_FALSE(slice_steps(sector_, data_, ping_, kTop, style_, theme, kSize));
}

TEST_F(ThreeSteps, AreDrawnInSmallDocksAndManyOfThemToo) {
  while (data_.steps.size() < 12) data_.steps.push_back(data_.steps[2]);
  for (const PixelSize size : {PixelSize{160, 120}, PixelSize{320, 900}, PixelSize{1600, 200}}) {
    for (const bool compared : {false, true}) {
      style_.compared = compared ? std::optional(std::pair<std::size_t, std::size_t>{3, 4}) : std::nullopt;
      EXPECT_TRUE(slice_steps(sector_, data_, ping_, kTop, style_, light_theme(size), size)) << size.width;
    }
  }
}

// Of a name and its words either more than a letter is left or nothing: a number is enough, and the pointer tells the rest.
TEST_F(ThreeSteps, InANarrowDockNumbersStandAlone) {
  while (data_.steps.size() < 12) data_.steps.push_back(data_.steps[2]);
  bool names = false;
  bool numbers = false;
  for (const PixelSize size : {PixelSize{340, 250}, PixelSize{400, 280}, PixelSize{1200, 800}}) {
    const auto made = slice_steps(sector_, data_, ping_, kTop, style_, light_theme(size), size);
    ASSERT_TRUE(made);
    for (const auto& item : made->frame.items) {
      const auto* text = std::get_if<TextItem>(&item);
      if (text == nullptr) continue;
      names = names || text->text == "3  Filter";
      numbers = numbers || text->text == "3";
      const bool cut = text->text.ends_with("\u2026");
      const double width_em = text_width_px(text->text.c_str(), text->size_px) / text->size_px;
      EXPECT_TRUE(!cut || width_em > 4.0) << text->text;
    }
  }
  EXPECT_TRUE(names && numbers);
}

// By hand: 8 fans of 7 beams of 41 samples.
TEST(SamplesIn, AreThoseOfAFanABeamOrARange) {
  const Sector sector = hand_sector();
  const auto top = samples_in(sector, TopSlice{4});
  EXPECT_EQ(top.size(), 7U * 41U);
  EXPECT_EQ(top.front(), 4 * 7 * 41);
  EXPECT_EQ(top.back(), 5 * 7 * 41 - 1);
  const auto side = samples_in(sector, SideSlice{3});
  EXPECT_EQ(side.size(), 8U * 41U);
  EXPECT_EQ(side[41], (7 + 3) * 41);
  const auto range = samples_in(sector, RangeSlice{20});
  EXPECT_EQ(range.size(), 56U);
  EXPECT_EQ(range[1], 41 + 20);
  const auto plane = samples_in(sector, horizontal_plane(50.0, 5.0));
  ASSERT_FALSE(plane.empty());
  EXPECT_TRUE(std::is_sorted(plane.begin(), plane.end()));
  EXPECT_EQ(std::adjacent_find(plane.begin(), plane.end()), plane.end());
  EXPECT_GE(plane.front(), 0);
}

}  // namespace
}  // namespace sonar
