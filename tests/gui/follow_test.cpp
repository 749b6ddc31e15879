// SPDX-License-Identifier: Apache-2.0
// Slices that go with the selected school, the lock that holds them, and the keys of the colours.
#include <gtest/gtest.h>

#include <QTreeView>
#include <algorithm>

#include "clocked_window.h"
#include "session/playback.h"

namespace sonar {
namespace {

class Following : public ClockedWindow {
 protected:
  /// A school over several pings; the window looks at the first of them, with the slices elsewhere and nothing selected.
  void follow_a_school() {
    const Target target = look_at_school();
    double_click("top_slice", place_in("top_slice", target.voxel));
    ASSERT_GT(masks().size(), 2U);
    masks_ = document().state().schools.front()->masks;
    document().look_at(masks().front().ping_index);
    settle();
    raise("schools");
    key(Qt::Key_Escape);
    ASSERT_FALSE(workspace().school());
    workspace().slices.set({});
    settle_jobs();
    ASSERT_FALSE(both_cut());
  }
  /// A click on the school's row.
  void select() {
    auto& list = *view("schools")->findChild<QTreeView*>("rows");
    const QRect place = list.visualRect(list.model()->index(0, list.columnAt(8)));
    click_on(list.viewport(), {12.0, static_cast<double>(place.center().y())});
    ASSERT_TRUE(workspace().school());
  }
  /// Whether the slices from above and from the side meet a voxel of the school in the ping on show.
  bool both_cut() {
    const auto* there = in_ping(masks_, document().ping());
    if (there == nullptr) return false;
    const int beams = document().shown()->sector().beams();
    const auto& runs = there->mask.runs;
    const auto fan = [&](const sonar::Run& run) { return run.row / beams == workspace().slices().fan; };
    const auto beam = [&](const sonar::Run& run) { return run.row % beams == workspace().slices().beam; };
    return std::ranges::any_of(runs, fan) && std::ranges::any_of(runs, beam);
  }
  SchoolMasks masks_;
};

TEST_F(Following, SlicesGoToASchoolPickedInTheTableAlsoWhilePingsPlay) {
  ASSERT_NO_FATAL_FAILURE(follow_a_school());
  select();
  EXPECT_TRUE(both_cut());
  const std::int64_t ping = document().ping();
  press(Qt::Key_Space);
  tick(0.0);
  workspace().slices.set({});
  settle_jobs();
  ASSERT_FALSE(both_cut());
  tick(0.55);
  ASSERT_EQ(document().ping(), ping + 1);
  EXPECT_TRUE(both_cut());
  press(Qt::Key_Space);
}

TEST_F(Following, TheLockLeavesThemWhereTheyAre) {
  ASSERT_NO_FATAL_FAILURE(follow_a_school());
  key(Qt::Key_L, Qt::ControlModifier | Qt::ShiftModifier);
  select();
  EXPECT_EQ(workspace().slices(), SlicePlaces{});
  key(Qt::Key_Right);
  EXPECT_EQ(workspace().slices(), SlicePlaces{});
  key(Qt::Key_L, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_TRUE(both_cut()) << "unlocked, they go to what is selected";
}

TEST_F(Following, F7TakesTheColoursOfTheEchoSounderAndF5TheUsualOnes) {
  const Target target = look_at_school();
  const DisplayParams usual = workspace().display.values();
  const Image before = app_->picture("top_slice")->image();
  key(Qt::Key_F7);
  EXPECT_EQ(workspace().display.values().scale.map, ColourMapName::ek500);
  EXPECT_EQ(workspace().display.values().scale.low_db, usual.scale.low_db) << "the limits stay";
  EXPECT_NE(app_->picture("top_slice")->image(), before);
  ASSERT_TRUE(workspace().display.set("scale.low_db", usual.scale.low_db - 15.0));
  key(Qt::Key_F5);
  EXPECT_EQ(workspace().display.values().scale.map, usual.scale.map);
  EXPECT_EQ(workspace().display.values().scale.low_db, usual.scale.low_db);
  EXPECT_EQ(app_->picture("top_slice")->image(), before) << "in ping " << target.ping;
}

}  // namespace
}  // namespace sonar
