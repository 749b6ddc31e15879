// SPDX-License-Identifier: Apache-2.0
#include "publish/volumes/mask_silhouettes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "render/test_scenes.h"
#include "view/contrast_example.h"

namespace sonar {
namespace {

constexpr PixelSize kSize{20, 20};
constexpr std::array<float, 4> kData{0.1F, 0.2F, 0.3F, 0.5F};

std::vector<std::uint8_t> square(int first, int last) {
  std::vector<std::uint8_t> out(kSize.count(), 0);
  for (int y = first; y <= last; ++y) {
    for (int x = first; x <= last; ++x) out[static_cast<std::size_t>(y * kSize.width + x)] = 1;
  }
  return out;
}

Theme black_on_white() {
  Theme theme;
  theme.text = {0, 0, 0, 255};
  theme.background = {255, 255, 255, 255};
  return theme;
}

// A square from 5 to 14 with a line of 2 pixels: 5 and 6 are the line, 4 the rim, all else is as it was.
TEST(MaskOutlines, AreLinesAndLeaveWhatLiesInside) {
  RayImage rays{kSize, std::vector<std::array<float, 4>>(kSize.count(), kData), {}};
  const MaskLayer layer{nullptr, {1.0F, 0.0F, 0.0F}};
  lay_outlines(rays, std::span(&layer, 1), {square(5, 14), square(9, 8)}, 2, black_on_white());
  const auto at = [&](int x) { return rays.rgba[static_cast<std::size_t>(9 * kSize.width + x)]; };
  const std::array<float, 4> red{1.0F, 0.0F, 0.0F, 1.0F};
  const std::array<float, 4> black{0.0F, 0.0F, 0.0F, 1.0F};
  for (int x = 0; x < kSize.width; ++x) {
    const int to_edge = std::min(x - 5, 14 - x);
    EXPECT_EQ(at(x), to_edge >= 2 || to_edge < -1 ? kData : to_edge < 0 ? black : red) << x;
  }
}

// A core's line is broken: of every eight pixels along a side four are drawn, with a dark rim outside and a light one
// inside.
TEST(MaskOutlines, AreBrokenRoundTheCore) {
  RayImage rays{kSize, std::vector<std::array<float, 4>>(kSize.count(), kData), {}};
  const MaskLayer layer{nullptr, {1.0F, 0.0F, 0.0F}};
  lay_outlines(rays, std::span(&layer, 1), {std::vector<std::uint8_t>(kSize.count(), 1), square(2, 17)}, 1,
               black_on_white());
  const auto count = [&](int y, std::array<float, 4> colour) {
    const auto row = rays.rgba.begin() + std::ptrdiff_t{y} * kSize.width;
    return std::count(row + 4, row + 16, colour);  // off the corners
  };
  EXPECT_EQ(count(1, {0.0F, 0.0F, 0.0F, 1.0F}), count(2, {1.0F, 0.0F, 0.0F, 1.0F}));
  EXPECT_EQ(count(3, {1.0F, 1.0F, 1.0F, 1.0F}), count(2, {1.0F, 0.0F, 0.0F, 1.0F}));
  int drawn = 0;
  for (int x = 2; x <= 17; ++x) drawn += rays.rgba[static_cast<std::size_t>(2 * kSize.width + x)] == kData ? 0 : 1;
  EXPECT_EQ(drawn, 8);
}

// Law: across each dash of a core's line, in data of whatever colour, there is something with a contrast of 3 or more.
TEST(MaskOutlines, ACoresLineStandsOutFromEveryColour) {
  const MaskSilhouettes silhouettes{std::vector<std::uint8_t>(kSize.count(), 1), square(4, 15)};
  const auto part = [](int v) { return static_cast<float>(v) / 255.0F; };
  const auto check = [&](const Theme& theme, const contrast_example::DataColour& data, int number) {
    const std::array<float, 4> under{part(data.colour.r), part(data.colour.g), part(data.colour.b), 1.0F};
    RayImage rays{kSize, std::vector<std::array<float, 4>>(kSize.count(), under), {}};
    const Rgba8 c = school_colour(number);
    const MaskLayer layer{nullptr, {part(c.r), part(c.g), part(c.b)}};
    lay_outlines(rays, std::span(&layer, 1), silhouettes, 1, theme);
    const Image image = over(rays, theme.plot);
    for (int x = 6; x < 14; ++x) {
      if ((x + 4) / 4 % 2 != 0) continue;  // a gap
      double most = 0.0;
      for (int y = 3; y <= 5; ++y) most = std::max(most, contrast_example::contrast(image.at(x, y), data.colour));
      ASSERT_GE(most, 3.0) << data.map << ", school " << number << ", at " << x;
    }
  };
  for (const Theme& theme : contrast_example::both_themes({640, 480})) {
    for (const auto& data : contrast_example::data_colours()) {
      for (int number = 0; number < kSchoolColours; ++number) check(theme, data, number);
    }
  }
}

PingMask block(const Shape3& shape, int fan0, int beam0, int sample0, int size) {
  PingMask mask;
  for (int fan = fan0; fan < fan0 + size; ++fan) {
    for (int beam = beam0; beam < beam0 + size; ++beam) {
      mask.runs.push_back({fan * shape.beams + beam, sample0, 4 * size});
      const bool rim = fan == fan0 || fan == fan0 + size - 1 || beam == beam0 || beam == beam0 + size - 1;
      mask.confidence.insert(mask.confidence.end(), static_cast<std::size_t>(4 * size), rim ? 60 : 255);
    }
  }
  return mask;
}

// The selected school's line is wider by half, and a line runs between schools of which one stands before the other.
TEST(MaskOutlines, OfTheSelectedSchoolAreWide) {
  RayImage rays{kSize, std::vector<std::array<float, 4>>(kSize.count(), kData), {}};
  const std::array<MaskLayer, 2> layers{{{nullptr, {1.0F, 0.0F, 0.0F}}, {nullptr, {0.0F, 1.0F, 0.0F}}}};
  auto selected = layers;
  selected[0].selected = true;
  MaskSilhouettes both{square(2, 17), std::vector<std::uint8_t>(kSize.count(), 0)};
  for (int y = 2; y <= 17; ++y) {
    for (int x = 10; x <= 17; ++x) both.fuzzy[static_cast<std::size_t>(y * kSize.width + x)] = 2;
  }
  lay_outlines(rays, selected, both, 2, black_on_white());
  const auto at = [&](int x) { return rays.rgba[static_cast<std::size_t>(9 * kSize.width + x)]; };
  const std::array<float, 4> red{1.0F, 0.0F, 0.0F, 1.0F};
  const std::array<float, 4> green{0.0F, 1.0F, 0.0F, 1.0F};
  for (int x = 2; x <= 9; ++x) EXPECT_EQ(at(x), std::min(x - 2, 9 - x) < 3 ? red : kData) << x;
  for (int x = 10; x <= 17; ++x) EXPECT_EQ(at(x), std::min(x - 10, 17 - x) < 2 ? green : kData) << x;
}

// A pixel belongs to the silhouettes where a mask drawn alone as a veil leaves anything, to one of those that do; a core
// lies in its fuzzy area.
TEST(MaskSilhouettes, AreWhatIsSeenOfTheMasks) {
  const Sector sector = scenes::fan();
  const auto volume = scenes::volume(sector);
  const Shape3 shape = volume->sv.shape();
  const std::vector<MaskLayer> masks{{std::make_shared<PingMask>(block(shape, 2, 3, 40, 4)), {1.0F, 0.0F, 0.0F}},
                                     {std::make_shared<PingMask>(block(shape, 5, 8, 70, 3)), {0.0F, 0.0F, 1.0F}}};
  const auto renderer = make_cpu_renderer();
  ASSERT_TRUE(renderer->set_volume(volume));
  ASSERT_TRUE(renderer->set_transfer(scenes::table(false)));
  VolumeView view;
  view.size = {160, 120};
  view.camera = scenes::looking({-20.0, -10.0, -5.0}, {30.0, 0.0, 15.0});
  view.mode = RayMode::maximum;
  Work work(1);
  const auto s = mask_silhouettes(*renderer, masks, view, work);
  ASSERT_TRUE(s) << to_line(s.error());
  std::vector<std::vector<bool>> veiled;
  for (const MaskLayer& mask : masks) {
    ASSERT_TRUE(renderer->set_masks(std::span(&mask, 1)));
    VolumeView veil = view;
    veil.masks = {.fuzzy_opacity = 0.35F, .core_extinction_per_m = 0.0F, .data_too = false};
    const auto alone = renderer->draw(veil, {}, work);
    ASSERT_TRUE(alone);
    veiled.emplace_back();
    for (const auto& pixel : alone->rgba) veiled.back().push_back(pixel[3] > 0.0F);
  }
  std::array<int, 3> fuzzy{};
  std::array<int, 3> core{};
  for (std::size_t i = 0; i < s->fuzzy.size(); ++i) {
    ASSERT_LE(s->fuzzy[i], masks.size());
    ASSERT_EQ(s->fuzzy[i] != 0, veiled[0][i] || veiled[1][i]) << i;
    if (s->fuzzy[i] != 0) {
      ASSERT_TRUE(veiled[s->fuzzy[i] - 1U][i]) << i;
    }
    ASSERT_TRUE(s->core[i] == 0 || s->fuzzy[i] != 0) << i;
    ++fuzzy[s->fuzzy[i]];
    ++core[s->core[i]];
  }
  for (const std::size_t k : {1U, 2U}) {
    EXPECT_GT(core[k], 20);
    EXPECT_GT(fuzzy[k], core[k] + 20);
  }
}

}  // namespace
}  // namespace sonar
