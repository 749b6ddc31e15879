// SPDX-License-Identifier: Apache-2.0
// The view in three dimensions under a real mouse.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "gui/about.h"
#include "gui/action_menus.h"
#include "session/volume/volume_model.h"
#include "window_at_work.h"

namespace sonar {
namespace {

class VolumeInTheWindow : public WindowAtWork {
 protected:
  void SetUp() override {
    WindowAtWork::SetUp();
    target_ = look_at_school();
    raise("volume");
  }
  VolumeModel& model() { return dynamic_cast<VolumeModel&>(*app_->picture("volume")); }
  PixelPoint middle() {
    const PixelRect& place = model().shown()->place;
    return {place.x + 0.5 * place.width, place.y + 0.5 * place.height};
  }
  /// Where the school is seen.
  PixelPoint seen() {
    const Sector& sector = document().shown()->sector();
    const auto at =
        model().shown()->place_of(sector.centre(target_.voxel.fan, target_.voxel.beam, target_.voxel.sample));
    EXPECT_TRUE(at && model().shown()->picked_at(*at));
    return at ? PixelPoint{std::floor(at->x), std::floor(at->y)} : PixelPoint{};
  }
  Target target_;
};

TEST_F(VolumeInTheWindow, ADragTurnsItAndTheWheelComesNearer) {
  ASSERT_TRUE(model().shown());
  const Camera first = model().shown()->view.camera;
  const PixelPoint at = middle();
  drag("volume", at, {at.x + 60.0, at.y + 20.0});
  const Camera turned = model().shown()->view.camera;
  EXPECT_GT(norm(turned.eye - first.eye), 10.0);
  EXPECT_NEAR(norm(turned.eye - turned.target), norm(first.eye - first.target), 1e-6);
  wheel("volume", at, 2);
  const Camera nearer = model().shown()->view.camera;
  EXPECT_LT(norm(nearer.eye - nearer.target), norm(turned.eye - turned.target));
  find_action(*window_, "volume.overview")->trigger();
  settle();
  EXPECT_EQ(model().shown()->view.camera, first);
}

TEST_F(VolumeInTheWindow, HoverPreviewsAndAClickSelectsWhatIsSeen) {
  const PixelPoint at = seen();
  // A pointer that stays where it is tells nothing, and the X server's own may take it away from the new window once.
  const auto hovered = [&] {
    move("volume", middle());
    move("volume", at);
    return workspace().cursor().has_value();
  };
  ASSERT_TRUE(QTest::qWaitFor(hovered));
  const Voxel voxel = *workspace().cursor();
  ASSERT_TRUE(workspace().preview().mask) << workspace().preview().text;
  click("volume", at);
  ASSERT_EQ(document().state().schools.size(), 1U);
  const auto& seeds = (*document().choices().lines->back().args)["seeds"];
  EXPECT_EQ(seeds[0]["sample"], voxel.sample);
  double_click("volume", at);
  EXPECT_GT(masks().size(), 1U);
}

TEST_F(VolumeInTheWindow, WhatDrewItIsTold) {
  ASSERT_TRUE(model().shown());
  EXPECT_THAT(about_text(*app_).toStdString(), testing::EndsWith("drawn by: " + model().shown()->renderer));
  EXPECT_THAT(model().shown()->renderer, testing::AnyOf(testing::StartsWith("cpu ("), testing::StartsWith("gl (")));
}

// The panel's own control, by hand: unfolded by a click, changed by a key. Then a key moves the slice, and the cut with it.
TEST_F(VolumeInTheWindow, IsCutOpenFromThePanel) {
  QComboBox& clip = control<QComboBox>("Volume", "clip");
  const auto known = [&] {
    const auto all = model().shown()->volume->sv.all();
    return std::count_if(all.begin(), all.end(), [](std::int16_t count) { return count != kNoData; });
  };
  const auto whole = known();
  QTest::keyClick(&clip, Qt::Key_Down);
  settle();
  ASSERT_EQ(workspace().volume.values().clip, VolumeClip::top_slice);
  const auto cut = known();
  EXPECT_LT(cut, whole);
  keep_picture("cut-open");
  view("volume")->setFocus(Qt::TabFocusReason);
  const int fan = workspace().slices().fan;
  key(Qt::Key_Up);
  ASSERT_GT(workspace().slices().fan, fan);
  EXPECT_GT(known(), cut) << "the eye is above: a fan more is left";
  clip.setFocus(Qt::TabFocusReason);
  QTest::keyClick(&clip, Qt::Key_Up);
  settle();
  EXPECT_EQ(known(), whole);
}

// The panel's own switches, by hand: each changes the picture, and back.
TEST_F(VolumeInTheWindow, ShowsWhatThePanelSwitches) {
  EXPECT_TRUE(workspace().volume.values().lighting) << "by default";
  for (const char* name : {"lighting", "slice_planes", "seabed", "context"}) {
    QCheckBox& box = control<QCheckBox>("Volume", name);
    const Image before = model().image();
    box.setFocus(Qt::TabFocusReason);
    QTest::keyClick(&box, Qt::Key_Space);
    settle();
    EXPECT_NE(model().image(), before) << name;
    QTest::keyClick(&box, Qt::Key_Space);
    settle();
    EXPECT_EQ(model().image(), before) << name;
  }
}

TEST_F(VolumeInTheWindow, ComesNearerByKeysAsEveryViewDoes) {
  const Camera first = model().shown()->view.camera;
  view("volume")->setFocus(Qt::TabFocusReason);
  key(Qt::Key_Plus, Qt::ControlModifier);
  const Camera nearer = model().shown()->view.camera;
  EXPECT_LT(norm(nearer.eye - nearer.target), norm(first.eye - first.target));
  key(Qt::Key_Minus, Qt::ControlModifier);
  EXPECT_NEAR(norm(model().shown()->view.camera.eye - first.eye), 0.0, 1.0);
}

// A school without a mouse: the slices are moved to it by keys, which the tests of slices hold.
TEST_F(VolumeInTheWindow, ASchoolGrowsWhereTheSlicesCross) {
  workspace().slices.set({target_.voxel.fan, target_.voxel.beam, target_.voxel.sample});
  settle();
  view("volume")->setFocus(Qt::TabFocusReason);
  key(Qt::Key_S, Qt::ShiftModifier);
  ASSERT_EQ(document().state().schools.size(), 1U);
  EXPECT_EQ(workspace().selected(), std::size_t{0});
  const auto& seeds = (*document().choices().lines->back().args)["seeds"];
  EXPECT_EQ(seeds[0]["sample"], target_.voxel.sample);
  document().look_at(document().ping() + 1);
  settle();
  EXPECT_FALSE(workspace().preview().mask) << "no pointer is there";
}

// A school that is clicked has its number and its drop line: what is drawn differs from the school without them.
TEST_F(VolumeInTheWindow, TheSelectedSchoolHasADropLine) {
  click("volume", seen());
  ASSERT_EQ(document().state().schools.size(), 1U);
  ASSERT_TRUE(workspace().selected());
  const Image with = model().image();
  VolumeParams params = workspace().volume.values();
  params.drop_lines = DropLines::none;
  workspace().volume.assign(params);
  settle();
  EXPECT_NE(model().image(), with);
  params.drop_lines = DropLines::selected;
  workspace().volume.assign(params);
  settle();
  EXPECT_EQ(model().image(), with);
}

}  // namespace
}  // namespace sonar
