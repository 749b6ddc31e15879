// SPDX-License-Identifier: Apache-2.0
// Tracks cut, joined and handed over in the lineage, by key and mouse.
#include <gtest/gtest.h>

#include "session/timelines/lineage_model.h"
#include "window_at_work.h"

namespace sonar {
namespace {

class LineageInTheWindow : public WindowAtWork {
 protected:
  LineageModel& lineage() { return dynamic_cast<LineageModel&>(*app_->picture("lineage")); }
  /// In the middle of a ping's part of a lane, 0 = top.
  PixelPoint at(std::size_t lane, std::int64_t ping) {
    const LineageSight& seen = *lineage().sight();
    const auto time = [&](std::int64_t i) { return seen.places.x_of(seen.data.times[static_cast<std::size_t>(i)]); };
    return {0.5 * (time(ping) + time(ping + 1)), seen.drawn.plot.at(0.0, static_cast<double>(lane) + 0.5).y};
  }
};

TEST_F(LineageInTheWindow, ASchoolIsCutHandedOverJoinedAndUndoneByHand) {
  EXPECT_TRUE(dock("lineage")->isHidden());
  key(Qt::Key_4, Qt::AltModifier | Qt::ShiftModifier);
  ASSERT_FALSE(dock("lineage")->isHidden());
  raise("lineage");
  const Target target = look_at_school();
  click("top_slice", place_in("top_slice", target.voxel));
  key(Qt::Key_P, Qt::ControlModifier);
  ASSERT_TRUE(lineage().sight()) << lineage().problem();
  ASSERT_EQ(document().state().schools.size(), 1U);
  const std::int64_t first = masks().front().ping_index;
  const auto pings = static_cast<std::int64_t>(masks().size());
  ASSERT_GE(pings, 4);
  keep_picture("lineage");
  // Dragged onto the free lane it is cut.
  drag("lineage", at(0, first + 2), at(1, first + 2));
  ASSERT_EQ(document().state().schools.size(), 2U);
  EXPECT_EQ(masks().size(), 2U);
  // A marked ping of the second goes back to the first.
  drag("lineage", at(1, first + 2), {at(1, first + 2).x + 2.0, at(1, first + 2).y}, Qt::ShiftModifier);
  drag("lineage", at(1, first + 2), at(0, first + 2));
  EXPECT_EQ(masks().size(), 3U);
  EXPECT_EQ(document().state().schools.at(1)->masks.pings.size(), static_cast<std::size_t>(pings - 3));
  keep_picture("lineage-handed-over");
  // All the rest too.
  drag("lineage", at(1, first + 3), at(0, first + 3));
  ASSERT_EQ(document().state().schools.size(), 1U);
  EXPECT_EQ(masks().size(), static_cast<std::size_t>(pings));
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(document().state().schools.size(), 2U);
}

TEST_F(LineageInTheWindow, EscapeDuringADragLeavesTheSchoolWhole) {
  key(Qt::Key_4, Qt::AltModifier | Qt::ShiftModifier);
  raise("lineage");
  const Target target = look_at_school();
  click("top_slice", place_in("top_slice", target.voxel));
  key(Qt::Key_P, Qt::ControlModifier);
  ASSERT_TRUE(lineage().sight()) << lineage().problem();
  const std::int64_t first = masks().front().ping_index;
  const std::size_t pings = masks().size();
  ASSERT_GE(pings, 4U);
  const std::size_t drawn = lineage().overlays().size();
  press_on(view("lineage"), at(0, first + 2));
  move("lineage", at(1, first + 2));
  EXPECT_GT(lineage().overlays().size(), drawn) << "what letting go would do is seen";
  key(Qt::Key_Escape);
  EXPECT_EQ(lineage().overlays().size(), drawn);
  release_on(view("lineage"), at(1, first + 2));
  EXPECT_EQ(document().state().schools.size(), 1U);
  EXPECT_EQ(masks().size(), pings);
  EXPECT_TRUE(workspace().school()) << "Escape ended the drag, not the selection";
  drag("lineage", at(0, first + 2), at(1, first + 2));
  EXPECT_EQ(document().state().schools.size(), 2U) << "the next drag cuts again";
}

}  // namespace
}  // namespace sonar
