// SPDX-License-Identifier: Apache-2.0
#include "publish/mask_silhouettes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "render/test_scenes.h"

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

// A square from 5 to 14 with a line of 2 pixels: 5 and 6 are the line, 4 the rim, all else is as it was.
TEST(MaskOutlines, AreLinesAndLeaveWhatLiesInside) {
  RayImage rays{kSize, std::vector<std::array<float, 4>>(kSize.count(), kData), {}};
  const MaskLayer layer{nullptr, {1.0F, 0.0F, 0.0F}};
  const MaskSilhouette silhouette{square(5, 14), square(9, 8)};
  lay_outlines(rays, std::span(&layer, 1), std::span(&silhouette, 1), 2, {0, 0, 0, 255});
  const auto at = [&](int x) { return rays.rgba[static_cast<std::size_t>(9 * kSize.width + x)]; };
  const std::array<float, 4> red{1.0F, 0.0F, 0.0F, 1.0F};
  const std::array<float, 4> black{0.0F, 0.0F, 0.0F, 1.0F};
  for (int x = 0; x < kSize.width; ++x) {
    const int to_edge = std::min(x - 5, 14 - x);
    EXPECT_EQ(at(x), to_edge >= 2 || to_edge < -1 ? kData : to_edge < 0 ? black : red) << x;
  }
}

// A core's line is broken: of every eight pixels along a side four are drawn.
TEST(MaskOutlines, AreBrokenRoundTheCore) {
  RayImage rays{kSize, std::vector<std::array<float, 4>>(kSize.count(), kData), {}};
  const MaskLayer layer{nullptr, {1.0F, 0.0F, 0.0F}};
  const MaskSilhouette silhouette{std::vector<std::uint8_t>(kSize.count(), 1), square(2, 17)};
  lay_outlines(rays, std::span(&layer, 1), std::span(&silhouette, 1), 1, {0, 0, 0, 255});
  int drawn = 0;
  for (int x = 2; x <= 17; ++x) drawn += rays.rgba[static_cast<std::size_t>(2 * kSize.width + x)] == kData ? 0 : 1;
  EXPECT_EQ(drawn, 8);
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

// A pixel belongs to a silhouette where the mask drawn alone as a veil leaves anything; a core lies in its fuzzy area.
TEST(MaskSilhouettes, AreWhatIsSeenOfEachMaskAlone) {
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
  const auto silhouettes = mask_silhouettes(*renderer, masks, view, work);
  ASSERT_TRUE(silhouettes) << to_line(silhouettes.error());
  ASSERT_EQ(silhouettes->size(), 2U);
  for (std::size_t k = 0; k < masks.size(); ++k) {
    ASSERT_TRUE(renderer->set_masks(std::span(&masks[k], 1)));
    VolumeView veil = view;
    veil.masks = {.fuzzy_opacity = 0.35F, .core_extinction_per_m = 0.0F, .data_too = false};
    const auto alone = renderer->draw(veil, {}, work);
    ASSERT_TRUE(alone);
    const MaskSilhouette& s = (*silhouettes)[k];
    int fuzzy = 0;
    int core = 0;
    for (std::size_t i = 0; i < s.fuzzy.size(); ++i) {
      ASSERT_EQ(s.fuzzy[i] != 0, alone->rgba[i][3] > 0.0F) << k << " " << i;
      ASSERT_LE(s.core[i], s.fuzzy[i]) << k << " " << i;
      fuzzy += s.fuzzy[i];
      core += s.core[i];
    }
    EXPECT_GT(core, 20);
    EXPECT_GT(fuzzy, core + 20);
  }
}

}  // namespace
}  // namespace sonar
