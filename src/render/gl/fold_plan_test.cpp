// SPDX-License-Identifier: Apache-2.0
#include "render/gl/fold_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace sonar {
namespace {

std::int16_t value_of(int fan, int beam, int sample) {
  return static_cast<std::int16_t>((fan * 61 + beam) * 997 + sample * 7);
}

Array3<std::int16_t> numbered(Shape3 shape) {
  Array3<std::int16_t> out(shape);
  for (int f = 0; f < shape.fans; ++f) {
    for (int b = 0; b < shape.beams; ++b) {
      for (int s = 0; s < shape.samples; ++s) out(f, b, s) = value_of(f, b, s);
    }
  }
  return out;
}

std::int16_t fetched(const FoldPlan& plan, const std::vector<std::int16_t>& texture, const FoldedPlace& place) {
  const auto& t = plan.texture;
  const auto i = static_cast<std::size_t>(
      ((place.texel[2] * t[1] + place.texel[1]) * t[0] + place.texel[0]) * plan.channels + place.channel);
  return texture.at(i);
}

TEST(FoldPlan, WhatFitsIsNotFolded) {
  const auto plan = plan_folds({20, 25, 1319}, 2048);
  ASSERT_TRUE(plan);
  EXPECT_FALSE(plan->folded());
  EXPECT_EQ(plan->texture, (std::array{1319, 25, 20}));
  EXPECT_EQ(plan->channels, 1);
}

TEST(FoldPlan, ThePapersPingNeedsThreeChannelsAt512) {
  // 512 + 511 + 511 = 1534 >= 1319 > 1023 = 512 + 511: the repeated samples cost one in each fold.
  const auto plan = plan_folds({20, 25, 1319}, 512);
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->channels, 3);
  EXPECT_EQ(plan->pieces, (std::array{3, 1, 1}));
  EXPECT_EQ(plan->texture[1], 25);
  EXPECT_LE(plan->texture[0], 512);
}

TEST(FoldPlan, FourFoldsOf512HoldThePapers2045SamplesAndNoMore) {
  EXPECT_EQ(plan_folds({20, 25, 2045}, 512)->channels, 4);
  EXPECT_EQ(plan_folds({20, 25, 2045}, 512)->slots, (std::array{1, 1}));
  EXPECT_EQ(plan_folds({20, 25, 2046}, 512)->slots, (std::array{2, 1})) << "the fifth fold begins a stack";
  EXPECT_EQ(plan_folds({20, 25, 512}, 512)->channels, 1);
  EXPECT_EQ(plan_folds({20, 25, 513}, 512)->channels, 2);
  EXPECT_EQ(plan_folds({20, 25, 1023}, 512)->channels, 2);
  EXPECT_EQ(plan_folds({20, 25, 1024}, 512)->channels, 3);
}

TEST(FoldPlan, StacksHaveABorderOnBothSides) {
  const auto plan = plan_folds({4, 6, 5000}, 512);  // 10 folds, 3 slots
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->pieces[0], 10);
  EXPECT_EQ(plan->slots, (std::array{3, 1}));
  EXPECT_EQ(plan->texture[1], 3 * (6 + 2));
  EXPECT_EQ(plan->texture[2], 4);
}

class FoldedVolumes : public testing::TestWithParam<std::tuple<Shape3, int>> {};

TEST_P(FoldedVolumes, FitTheLimitAndHoldEveryPairOfNeighboursInOnePiece) {
  const auto [shape, limit] = GetParam();
  const auto plan = plan_folds(shape, limit);
  ASSERT_TRUE(plan);
  EXPECT_LE(*std::max_element(plan->texture.begin(), plan->texture.end()), limit);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_GE((plan->length[axis] - 1) * plan->pieces[axis] + 1, plan->size[axis]) << "axis " << axis;
  }
  const auto volume = numbered(shape);
  const auto texture = folded<std::int16_t>(*plan, volume.view(), -1);
  int wrong = 0;
  std::array<int, 3> p{};
  for (p[2] = 0; p[2] < plan->pieces[2]; ++p[2]) {
    for (p[1] = 0; p[1] < plan->pieces[1]; ++p[1]) {
      for (p[0] = 0; p[0] < plan->pieces[0]; ++p[0]) {
        // Borders included: one row more to each side where pieces are stacked.
        for (int k = -plan->border(2); k < plan->length[2] + plan->border(2); ++k) {
          for (int j = -plan->border(1); j < plan->length[1] + plan->border(1); ++j) {
            for (int i = 0; i < plan->length[0]; ++i) {
              const std::array inside{i, j, k};
              std::array<int, 3> index{};
              for (std::size_t a = 0; a < 3; ++a) {
                const int kept = std::clamp(inside[a], 0, plan->length[a] - 1);
                index[a] = std::min(p[a] * (plan->length[a] - 1) + kept, plan->size[a] - 1);
              }
              wrong += fetched(*plan, texture, place_of(*plan, p, inside)) != value_of(index[2], index[1], index[0]);
            }
          }
        }
      }
    }
  }
  EXPECT_EQ(wrong, 0);
}

TEST_P(FoldedVolumes, PiecesDoNotOverlapInTheTexture) {
  const auto [shape, limit] = GetParam();
  const auto plan = plan_folds(shape, limit);
  ASSERT_TRUE(plan);
  std::set<std::tuple<int, int, int>> corners;
  std::array<int, 3> p{};
  for (p[2] = 0; p[2] < plan->pieces[2]; ++p[2]) {
    for (p[1] = 0; p[1] < plan->pieces[1]; ++p[1]) {
      for (p[0] = 0; p[0] < plan->pieces[0]; ++p[0]) {
        const auto place = place_of(*plan, p, {0, 0, 0});
        EXPECT_TRUE(corners.insert({place.texel[1], place.texel[2], place.channel}).second);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, FoldedVolumes,
                         testing::Values(std::tuple{Shape3{20, 25, 1319}, 2048}, std::tuple{Shape3{20, 25, 1319}, 512},
                                         std::tuple{Shape3{20, 25, 1319}, 300}, std::tuple{Shape3{20, 25, 1319}, 128},
                                         std::tuple{Shape3{20, 25, 10000}, 2048},
                                         std::tuple{Shape3{20, 25, 10000}, 512}, std::tuple{Shape3{40, 60, 2000}, 256},
                                         std::tuple{Shape3{2, 2, 2}, 4}, std::tuple{Shape3{3, 40, 90}, 24},
                                         std::tuple{Shape3{30, 5, 60}, 20}, std::tuple{Shape3{20, 25, 10000}, 128}));

TEST(FoldPlan, WhatFitsNowhereIsRefused) {
  const auto plan = plan_folds({400, 400, 4000}, 64);
  ASSERT_FALSE(plan);
  EXPECT_EQ(plan.error().code, ErrorCode::unsupported);
  EXPECT_FALSE(plan_folds({0, 5, 5}, 64));
}

}  // namespace
}  // namespace sonar
