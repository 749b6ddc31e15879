// SPDX-License-Identifier: Apache-2.0
#include "school/detect/flood.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "school/detect/settle_members.h"
#include "school/test_water.h"

namespace sonar {
namespace {

using Runs = std::vector<Run>;

constexpr Shape3 kShape{7, 6, 40};

Runs everywhere() {
  Runs runs;
  for (int row = 0; row < 42; ++row) runs.push_back({row, 0, 40});
  return runs;
}

int voxels(const Runs& runs) {
  int count = 0;
  for (const auto& run : runs) count += run.count;
  return count;
}

Array3<std::int16_t> noise(std::uint64_t seed) {
  Array3<std::int16_t> sv(kShape);
  for (std::size_t i = 0; i < kShape.size(); ++i) {
    sv.all()[i] = static_cast<std::int16_t>(-10000.0 + 3000.0 * test::uniform(seed * 100003 + i));
  }
  return sv;
}

TEST(Flood, FloodsMeetInTheSaddleWhereverItLies) {
  for (const int saddle : {1, 2, 4}) {
    Array3<std::int16_t> sv(kShape, -9000);
    for (int b = 0; b < 6; ++b) {
      for (std::int16_t& count : sv.row(saddle, b)) count = -9800;
    }
    const std::vector<Runs> cores{{{2, 20, 1}}, {{6 * 6 + 3, 5, 2}}};
    const auto schools = flood(std::as_const(sv).view(), everywhere(), cores, Connectivity::faces);
    ASSERT_EQ(schools.size(), 2U);
    EXPECT_EQ(voxels(schools[0]) + voxels(schools[1]), static_cast<int>(kShape.size()));
    for (const auto& run : schools[0]) EXPECT_LE(run.row / 6, saddle);
    for (const auto& run : schools[1]) EXPECT_GE(run.row / 6, saddle);
  }
}

Runs above(const Array3<std::int16_t>& sv, int level, const std::vector<Runs>& cores) {
  Runs runs;
  for (int row = 0; row < 42; ++row) {
    for (int s = 0; s < 40; ++s) {
      bool wet = sv.view().row(row)[static_cast<std::size_t>(s)] >= level;
      for (const Runs& core : cores) wet = wet || share_a_voxel({{row, s, 1}}, core);
      if (!wet) continue;
      if (runs.empty() || runs.back().row != row || runs.back().end() != s) runs.push_back({row, s, 0});
      ++runs.back().count;
    }
  }
  return runs;
}

/// What hangs together above a level with one core alone is that core's.
void expect_loudest_ways(const Array3<std::int16_t>& sv, int level, const std::vector<Runs>& cores,
                         const std::vector<Runs>& schools, Connectivity connectivity) {
  for (const Runs& part : connected_parts(above(sv, level, cores), kShape, connectivity)) {
    const auto in_part = [&](const Runs& core) { return share_a_voxel(part, core); };
    if (std::count_if(cores.begin(), cores.end(), in_part) != 1) continue;
    const auto owner = std::find_if(cores.begin(), cores.end(), in_part) - cores.begin();
    EXPECT_EQ(voxels(common_runs(part, schools[static_cast<std::size_t>(owner)])), voxels(part)) << level;
  }
}

// Each voxel goes to the core to which the best way leads: the one whose faintest voxel is loudest.
TEST(Flood, FollowsTheLoudestWay) {
  const std::vector<Runs> cores{{{7, 4, 3}}, {{30, 30, 2}}, {{17, 18, 1}}};
  for (const Connectivity connectivity : {Connectivity::faces, Connectivity::all}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const Array3<std::int16_t> sv = noise(seed);
      const auto schools = flood(sv.view(), everywhere(), cores, connectivity);
      for (int level = -10000; level < -7000; level += 150) {
        expect_loudest_ways(sv, level, cores, schools, connectivity);
      }
    }
  }
}

TEST(Flood, SharesAPlainByTheWay) {
  const Array3<std::int16_t> sv(kShape, -9000);
  const auto schools =
      flood(sv.view(), everywhere(), std::vector<Runs>{{{0, 0, 1}}, {{0, 39, 1}}}, Connectivity::faces);
  EXPECT_NEAR(voxels(schools[0]), voxels(schools[1]), 42);
}

TEST(Flood, StaysInTheWaterAndLeavesWhatItDoesNotReach) {
  const Array3<std::int16_t> sv(kShape, -9000);
  const Runs water{{0, 0, 10}, {0, 12, 5}, {1, 9, 4}, {8, 13, 3}};
  const std::vector<Runs> core{{{0, 3, 2}}};
  const auto faces = flood(sv.view(), water, core, Connectivity::faces);
  EXPECT_EQ(faces[0], (Runs{{0, 0, 10}, {0, 12, 5}, {1, 9, 4}}));  // row 1 leads from one to the other
  const auto all = flood(sv.view(), water, core, Connectivity::all);
  EXPECT_EQ(all[0], water);
  EXPECT_TRUE(flood(sv.view(), {}, {}, Connectivity::faces).empty());
}

TEST(Flood, CommonRunsAreTheVoxelsOfBoth) {
  const Runs a{{0, 0, 10}, {0, 12, 5}, {3, 4, 2}, {5, 0, 3}};
  const Runs b{{0, 8, 6}, {0, 16, 9}, {3, 5, 1}, {4, 0, 3}};
  const Runs both{{0, 8, 2}, {0, 12, 2}, {0, 16, 1}, {3, 5, 1}};
  EXPECT_EQ(common_runs(a, b), both);
  EXPECT_EQ(common_runs(b, a), both);
  EXPECT_TRUE(common_runs(a, {}).empty());
}

}  // namespace
}  // namespace sonar
