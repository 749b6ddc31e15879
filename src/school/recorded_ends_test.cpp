// SPDX-License-Identifier: Apache-2.0
#include "school/recorded_ends.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "base/units.h"
#include "school/grow/grow.h"
#include "school/grow/mask_edit.h"
#include "school/test_scene.h"

namespace sonar {
namespace {

void lose(View3<SampleFlags> flags, int fan, int beam, int first) {
  const auto row = flags.row(fan, beam);
  for (auto s = static_cast<std::size_t>(first); s < row.size(); ++s) row[s] |= SampleFlags::dropout;
}

/// Two fans of two beams and 10 samples. Of the upper one 8 were recorded, and one beam is lost.
Array3<SampleFlags> unequal_fans() {
  Array3<SampleFlags> flags(Shape3{2, 2, 10});
  lose(flags.view(), 1, 0, 8);
  lose(flags.view(), 1, 1, 0);
  return flags;
}

TEST(RecordedEnds, AreTheLongestBeamsOfEachFan) {
  Array3<SampleFlags> flags(Shape3{4, 3, 10});
  flags(0, 0, 4) = SampleFlags::dropout;  // a gap is no end
  flags(0, 1, 9) = SampleFlags::seabed;
  for (int beam = 0; beam < 3; ++beam) lose(flags.view(), 1, beam, 5 + beam);
  for (int beam = 0; beam < 3; ++beam) lose(flags.view(), 2, beam, 0);  // nothing tells how far
  for (int beam = 0; beam < 2; ++beam) lose(flags.view(), 3, beam, 0);
  EXPECT_THAT(recorded_ends(flags.view()), testing::ElementsAre(10, 7, 10, 10));
  Array3<SampleFlags> nothing(Shape3{1, 1, 6});
  lose(nothing.view(), 0, 0, 0);
  EXPECT_THAT(recorded_ends(nothing.view()), testing::ElementsAre(6));
}

TEST(RecordedEnds, NothingGrowsPastThem) {
  const Array3<SampleFlags> flags = unequal_fans();
  const Array3<std::int16_t> sv(flags.shape(),
                                static_cast<std::int16_t>(counts_from_db(-40.0)));  // the filter fills gaps
  const MemberTable members = MemberTable::one_sided(-40.0, 10.0);
  const VoxelIndex seed{0, 5};
  const PingMask grown = grow(sv.view(), flags.view(), members, std::span(&seed, 1), {});
  EXPECT_EQ(grown.runs, (std::vector<sonar::Run>{{0, 0, 10}, {1, 0, 10}, {2, 0, 8}, {3, 0, 8}}));
  const auto past = grow_from_click(sv.view(), flags.view(), {3, 8}, TransferFunction(), {}, nullptr);
  ASSERT_FALSE(past.has_value());
  EXPECT_THAT(past.error().text, testing::HasSubstr("has no data"));
}

TEST(RecordedEnds, NothingIsPaintedPastThem) {
  const PingMask painted = brushed({{1, 6, 4}, {3, 6, 4}, {3, 9, 1}}, unequal_fans().view());
  EXPECT_EQ(painted.runs, (std::vector<sonar::Run>{{1, 6, 4}, {3, 6, 2}}));
}

TEST(RecordedEnds, ASchoolThatTheRecordCutsOffEndsThere) {
  test::Scene scene;
  scene.add(150.0, -18.0, 265.0, -40.0, {16, 9, 6});
  const int end = 398;  // in the midst of it
  for (int fan = 12; fan < 20; ++fan) {
    for (int beam = 0; beam < 25; ++beam) lose(scene.flags.view(), fan, beam, end);
  }
  lose(scene.flags.view(), 12, 10, 0);
  const std::vector<Detection> found = scene.look(3);
  ASSERT_EQ(found.size(), 1U);
  bool in_the_lost_beam = false;
  bool behind_in_longer_fans = false;
  for (const sonar::Run& run : found[0].mask.runs) {
    EXPECT_TRUE(run.row < 12 * 25 || run.end() <= end) << run.row << ' ' << run.end();
    in_the_lost_beam = in_the_lost_beam || run.row == 12 * 25 + 10;
    behind_in_longer_fans = behind_in_longer_fans || run.end() > end;
  }
  EXPECT_TRUE(in_the_lost_beam);
  EXPECT_TRUE(behind_in_longer_fans);
}

}  // namespace
}  // namespace sonar
