// SPDX-License-Identifier: Apache-2.0
// The range slice and the plane slice by mouse and keys.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QAction>
#include <QApplication>
#include <QMenu>
#include <QWheelEvent>

#include "gui/action_menus.h"
#include "session/slices/slice_places.h"
#include "window_at_work.h"

namespace sonar {
namespace {

class FourSlicesInTheWindow : public WindowAtWork {};

TEST_F(FourSlicesInTheWindow, TwoAreOffUntilTheyAreAskedForAndThenStandInFront) {
  for (const char* id : {"range_slice", "plane_slice"}) {
    EXPECT_TRUE(dock(id)->isHidden()) << id;
    EXPECT_FALSE(app_->picture(id)->seen()) << id;
  }
  const QSize window = window_->size();
  key(Qt::Key_9, Qt::AltModifier);
  EXPECT_TRUE(app_->picture("range_slice")->seen());
  key(Qt::Key_0, Qt::AltModifier);
  EXPECT_TRUE(app_->picture("plane_slice")->seen());
  EXPECT_EQ(window_->size(), window);
  const auto tabs = window_->tabifiedDockWidgets(dock("side_slice"));
  EXPECT_TRUE(tabs.contains(dock("range_slice")) && tabs.contains(dock("plane_slice")));
}

TEST_F(FourSlicesInTheWindow, AClickInEachSelectsTheSameSchool) {
  const Target target = look_at_school();
  click("top_slice", place_in("top_slice", target.voxel));
  const auto school = workspace().school();
  ASSERT_TRUE(school);
  for (const char* id : {"range_slice", "plane_slice"}) {
    key(id == std::string("range_slice") ? Qt::Key_9 : Qt::Key_0, Qt::AltModifier);
    lay_slices_through(workspace(), target.voxel);
    settle();
    key(Qt::Key_Escape);
    ASSERT_FALSE(workspace().school());
    const PixelPoint at = place_in(id, target.voxel);
    move(id, at);
    // A pixel of a plane is some samples wide.
    ASSERT_TRUE(workspace().cursor());
    EXPECT_EQ(workspace().cursor()->fan, target.voxel.fan) << id;
    EXPECT_EQ(workspace().cursor()->beam, target.voxel.beam) << id;
    EXPECT_NEAR(workspace().cursor()->sample, target.voxel.sample, 8) << id;
    click(id, at);
    EXPECT_EQ(workspace().school(), school) << id;
    EXPECT_EQ(document().state().schools.size(), 1U) << "selected, not grown anew";
    keep_picture(std::string("FourSlices.") + id);
  }
}

TEST_F(FourSlicesInTheWindow, WheelAndKeysMoveThem) {
  const Target target = look_at_school();
  key(Qt::Key_9, Qt::AltModifier);
  key(Qt::Key_0, Qt::AltModifier);
  raise("range_slice");
  lay_slices_through(workspace(), target.voxel);
  settle();
  const std::int64_t pictures = app_->picture("range_slice")->pictures();
  wheel("range_slice", place_in("range_slice", target.voxel), 1);
  EXPECT_GT(workspace().slices().sample, target.voxel.sample);
  EXPECT_GT(app_->picture("range_slice")->pictures(), pictures);
  key(Qt::Key_Down, Qt::ControlModifier);
  EXPECT_EQ(workspace().slices().sample, target.voxel.sample);
  raise("plane_slice");
  const double depth_m = workspace().plane.values().depth_m;
  key(Qt::Key_Up, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_LT(workspace().plane.values().depth_m, depth_m);
  wheel("plane_slice", {100.0, 100.0}, -1);
  EXPECT_NEAR(workspace().plane.values().depth_m, depth_m, 1e-9);
}

TEST_F(FourSlicesInTheWindow, ASectionIsDraggedInTheSliceFromAbove) {
  const Target target = look_at_school();
  const Sector& sector = document().shown()->sector();
  const int beam = target.voxel.beam + (target.voxel.beam + 4 < sector.beams() ? 4 : -4);
  find_action(*window_, "slice.section")->trigger();
  settle();
  drag("top_slice", place_in("top_slice", target.voxel),
       place_in("top_slice", {target.voxel.fan, beam, target.voxel.sample}));
  EXPECT_EQ(workspace().plane.values().lies, PlaneSlice::Kind::vertical);
  EXPECT_TRUE(app_->picture("plane_slice")->seen());
  EXPECT_EQ(app_->picture("plane_slice")->problem(), "");
  EXPECT_TRUE(document().state().schools.empty());
  keep_picture("FourSlices.section");
  workspace().dark.set(true);
  settle();
  keep_picture("FourSlices.section.dark");
  workspace().dark.set(false);
}

}  // namespace
}  // namespace sonar
