// SPDX-License-Identifier: Apache-2.0
#include "school/grow/grow.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "base/units.h"
#include "school/test_water.h"

namespace sonar {
namespace {

struct RandomVolume {
  explicit RandomVolume(std::uint64_t seed, Shape3 shape = {5, 6, 40}) : sv(shape), flags(shape) {
    for (std::size_t i = 0; i < shape.size(); ++i) {
      sv.all()[i] = static_cast<std::int16_t>(counts_from_db(-70.0 + 40.0 * test::uniform(seed * 104729 + i)));
      const double u = test::uniform(seed * 15485863 + i);
      if (u < 0.05) flags.all()[i] = SampleFlags::seabed;
      if (u > 0.9) flags.all()[i] = SampleFlags::corrupted;
      if (u > 0.97) sv.all()[i] = kNoData;
    }
  }
  Array3<std::int16_t> sv;
  Array3<SampleFlags> flags;
};

std::set<std::pair<int, int>> voxels_of(const PingMask& mask) {
  std::set<std::pair<int, int>> out;
  for (const Run& run : mask.runs) {
    for (int s = run.first_sample; s < run.end(); ++s) out.insert({run.row, s});
  }
  return out;
}

/// Voxel by voxel, straight from the definition.
std::set<std::pair<int, int>> plain_grow(const RandomVolume& v, const MemberTable& members, VoxelIndex seed, bool all,
                                         const IndexBox& box) {
  const Shape3 shape = v.sv.shape();
  const auto member = [&](int f, int b, int s) {
    return box.contains(f, b, s) && f >= 0 && f < shape.fans && b >= 0 && b < shape.beams && s >= 0 &&
           s < shape.samples && members(v.sv(f, b, s)) != 0 && !any(v.flags(f, b, s) & kNeverMember);
  };
  std::set<std::pair<int, int>> out;
  std::vector<std::array<int, 3>> queue;
  const auto reach = [&](int f, int b, int s) {
    if (member(f, b, s) && out.insert({f * shape.beams + b, s}).second) queue.push_back({f, b, s});
  };
  reach(seed.row / shape.beams, seed.row % shape.beams, seed.sample);
  while (!queue.empty()) {
    const auto [f, b, s] = queue.back();
    queue.pop_back();
    for (int df = -1; df <= 1; ++df) {
      for (int db = -1; db <= 1; ++db) {
        for (int ds = -1; ds <= 1; ++ds) {
          if (all || std::abs(df) + std::abs(db) + std::abs(ds) == 1) reach(f + df, b + db, s + ds);
        }
      }
    }
  }
  return out;
}

TEST(Grow, EqualsThePlainTwin) {
  const TransferFunction curve;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const RandomVolume v(seed);
    const VoxelIndex at{static_cast<int>(test::hash64(seed) % 30), static_cast<int>(test::hash64(seed + 99) % 40)};
    const bool all = seed % 2 == 0;
    const IndexBox box = seed % 3 == 0 ? IndexBox{1, 3, 0, 4, 5, 33} : IndexBox::whole(v.sv.shape());
    const MemberTable members = seed % 5 == 0 ? MemberTable::by_opacity(curve.table_i16(), 0.5, 0.3)
                                              : MemberTable::one_sided(-40.0, seed % 4 == 0 ? 20.0 : 12.0);
    GrowLimits limits;
    limits.connectivity = all ? Connectivity::all : Connectivity::faces;
    limits.box = box;
    const PingMask mask = grow(v.sv.view(), v.flags.view(), members, std::span(&at, 1), limits);
    EXPECT_EQ(voxels_of(mask), plain_grow(v, members, at, all, box)) << "seed " << seed;
    EXPECT_TRUE(std::is_sorted(mask.runs.begin(), mask.runs.end()));
  }
}

TEST(Grow, TakenAndInsideLimitTheMask) {
  const RandomVolume v(3);
  const MemberTable members = MemberTable::one_sided(-40.0, 30.0);
  std::vector<VoxelIndex> seeds;
  for (int row = 0; row < 30; ++row) {
    for (int s = 0; s < 40; ++s) seeds.push_back({row, s});
  }
  const PingMask whole = grow(v.sv.view(), v.flags.view(), members, seeds, {});
  PingMask other;
  other.runs = {{3, 5, 10}, {3, 20, 4}, {17, 0, 40}};
  other.confidence.assign(54, 1);
  GrowLimits limits;
  limits.taken = &other;
  EXPECT_EQ(voxels_of(grow(v.sv.view(), v.flags.view(), members, seeds, limits)), voxels_of(subtract(whole, other)));
  limits.taken = nullptr;
  limits.inside = &other;
  EXPECT_EQ(voxels_of(grow(v.sv.view(), v.flags.view(), members, seeds, limits)),
            voxels_of(subtract(whole, subtract(whole, other))));
}

TEST(MemberTable, FollowsTheFallOff) {
  // by hand: reference -40 dB, tolerance 10 dB; 5 dB below f = 1 - 0.25 = 0.75, at -50 f = 0 -> q = 1
  const MemberTable members = MemberTable::one_sided(-40.0, 10.0);
  const auto q = [&](double db) { return int{members(static_cast<std::int16_t>(std::lround(counts_from_db(db))))}; };
  EXPECT_EQ(q(-35.0), 255);
  EXPECT_EQ(q(-40.0), 255);
  EXPECT_NEAR(q(-45.0), 191, 1);
  EXPECT_EQ(q(-49.99), 1);
  EXPECT_EQ(q(-50.02), 0);
  EXPECT_EQ(int{members(kNoData)}, 0);
}

TEST(MemberTable, PaperIsTwoSidedAndNeedsOpacity) {
  const std::vector<float> opacity = TransferFunction().table_i16();  // 0 at -70 dB, 1 at -30 dB
  const MemberTable members = MemberTable::by_opacity(opacity, 0.5, 0.25);
  const auto q = [&](double db) { return int{members(static_cast<std::int16_t>(std::lround(counts_from_db(db))))}; };
  EXPECT_EQ(q(-50.0), 255);       // d = 0
  EXPECT_NEAR(q(-45.0), 191, 1);  // d = 0.125 = t/2
  EXPECT_NEAR(q(-55.0), 191, 1);
  EXPECT_EQ(q(-39.9), 0);  // brighter than the range
  EXPECT_EQ(q(-60.1), 0);
  EXPECT_EQ(int{MemberTable::by_opacity(opacity, 0.0, 0.5)(static_cast<std::int16_t>(counts_from_db(-75.0)))}, 0);
}

TEST(MemberTable, DistanceEqualToToleranceIsAMember) {
  std::vector<float> opacity(65536, 0.0F);
  opacity[32768 + 10] = 0.75F;
  opacity[32768 + 11] = 0.76F;
  const MemberTable members = MemberTable::by_opacity(opacity, 0.5, 0.25);
  EXPECT_EQ(int{members(10)}, 1);
  EXPECT_EQ(int{members(11)}, 0);
}

TEST(Grow, RefusesBadSeedsInOneLine) {
  RandomVolume v(1);
  v.flags.view().row(4)[7] = SampleFlags::near_field;
  v.flags.view().row(4)[8] = SampleFlags::none;
  v.sv.view().row(4)[8] = kNoData;
  v.flags.view().row(4)[9] = SampleFlags::none;
  v.sv.view().row(4)[9] = static_cast<std::int16_t>(counts_from_db(-80.0));
  for (const VoxelIndex seed : {VoxelIndex{4, 7}, VoxelIndex{4, 8}, VoxelIndex{4, 9}, VoxelIndex{30, 0},
                                VoxelIndex{-1, 0}, VoxelIndex{0, 40}}) {
    const auto mask = grow_from_click(v.sv.view(), v.flags.view(), seed, TransferFunction(), {});
    ASSERT_FALSE(mask);
    EXPECT_EQ(mask.error().code, ErrorCode::bad_parameter);
    EXPECT_EQ(mask.error().text.find('\n'), std::string::npos);
  }
}

TEST(Grow, CoreIsInsideTheFuzzyArea) {
  const RandomVolume v(2, {3, 4, 200});
  std::vector<VoxelIndex> seeds{{5, 100}};
  const PingMask mask = grow(v.sv.view(), v.flags.view(), MemberTable::one_sided(-35.0, 35.0), seeds, {});
  const PingMask core = at_least(mask, 0.7);
  EXPECT_TRUE(subtract(core, mask).empty());
  for (const std::uint8_t q : core.confidence) EXPECT_GE(q, 179);  // 0.7 x 255 = 178.5
  EXPECT_EQ(at_least(mask, 0.0), mask);
}

}  // namespace
}  // namespace sonar
