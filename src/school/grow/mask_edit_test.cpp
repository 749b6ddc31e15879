// SPDX-License-Identifier: Apache-2.0
#include "school/grow/mask_edit.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace sonar {
namespace {

constexpr Shape3 kShape{5, 6, 20};

std::set<std::pair<int, int>> voxels_of(const PingMask& mask) {
  std::set<std::pair<int, int>> out;
  for (const Run& run : mask.runs) {
    for (int s = run.first_sample; s < run.end(); ++s) out.insert({run.row, s});
  }
  return out;
}

/// Fans 1..3, beams 1..3, samples 5..9, without what is left out.
PingMask cube(const std::vector<std::tuple<int, int, int>>& holes = {}) {
  PingMask mask;
  for (int f = 1; f <= 3; ++f) {
    for (int b = 1; b <= 3; ++b) {
      for (int s = 5; s <= 9; ++s) {
        bool hole = false;
        for (const auto& [hf, hb, hs] : holes) hole = hole || (hf == f && hb == b && hs == s);
        if (hole) continue;
        const int row = f * kShape.beams + b;
        if (!mask.runs.empty() && mask.runs.back().row == row && mask.runs.back().end() == s) {
          ++mask.runs.back().count;
        } else {
          mask.runs.push_back({row, s, 1});
        }
        mask.confidence.push_back(100);
      }
    }
  }
  return mask;
}

TEST(MaskEdit, BrushedRunsMayOverlapAndSkipWhatIsNeverAMember) {
  Array3<SampleFlags> flags(kShape);
  flags(0, 1, 4) = SampleFlags::seabed;
  flags(0, 1, 5) = SampleFlags::corrupted;  // a fault stays in the mask
  const PingMask mask = brushed({{1, 3, 4}, {1, 2, 2}, {0, 7, 1}}, flags.view());
  EXPECT_EQ(mask.runs, (std::vector<sonar::Run>{{0, 7, 1}, {1, 2, 2}, {1, 5, 2}}));
  EXPECT_EQ(mask.confidence, std::vector<std::uint8_t>(5, 255));
}

TEST(MaskEdit, OnlyEnclosedVoxelsAreFilled) {
  const Array3<SampleFlags> flags(kShape);
  const PingMask filled = fill_holes(cube({{2, 2, 7}, {1, 2, 7}}), flags.view());  // the second opens the first
  EXPECT_EQ(voxels_of(filled), voxels_of(cube({{2, 2, 7}, {1, 2, 7}})));
  const PingMask closed = fill_holes(cube({{2, 2, 7}}), flags.view());
  EXPECT_EQ(voxels_of(closed), voxels_of(cube()));
  EXPECT_EQ(closed.confidence[4 * 5 + 2], 255);  // row (2, 2) is the fifth of nine, sample 7 its third
  EXPECT_EQ(closed.confidence[4 * 5 + 1], 100);
}

TEST(MaskEdit, WhatIsNeverAMemberIsNotFilled) {
  Array3<SampleFlags> flags(kShape);
  flags(2, 2, 7) = SampleFlags::near_field;
  EXPECT_EQ(fill_holes(cube({{2, 2, 7}}), flags.view()), cube({{2, 2, 7}}));
}

TEST(MaskEdit, SmoothingTakesCornersAndStrayVoxelsAndFillsDents) {
  const Array3<SampleFlags> flags(kShape);
  PingMask rough = cube({{2, 2, 7}});
  rough = unite(rough, {{{4 * kShape.beams + 5, 15, 1}}, {50}});
  const auto smooth = voxels_of(smoothed(rough, flags.view()));
  EXPECT_TRUE(smooth.count({2 * kShape.beams + 2, 7}));    // 26 of 27
  EXPECT_FALSE(smooth.count({4 * kShape.beams + 5, 15}));  // 1 of 12
  EXPECT_FALSE(smooth.count({1 * kShape.beams + 1, 5}));   // 8 of 27
  EXPECT_TRUE(smooth.count({2 * kShape.beams + 2, 5}));    // 17 of 27
  EXPECT_EQ(smoothed(PingMask{}, flags.view()), PingMask{});
}

TEST(MaskEdit, PartsAreDisjointAndMakeTheWhole) {
  PingMask two = unite(cube(), {{{4 * kShape.beams + 5, 15, 3}}, {50, 60, 70}});
  const auto pieces = parts(two, kShape, Connectivity::faces);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(unite(pieces[0], pieces[1]), two);
  EXPECT_EQ(overlap(pieces[0], pieces[1]), 0U);
  EXPECT_EQ(largest_part(two, kShape, Connectivity::faces), cube());
  EXPECT_TRUE(contains(two, 4 * kShape.beams + 5, 17));
  EXPECT_FALSE(contains(two, 4 * kShape.beams + 5, 18));
  EXPECT_FALSE(contains(two, 0, 0));
}

}  // namespace
}  // namespace sonar
