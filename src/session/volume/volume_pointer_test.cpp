// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "publish/volumes/volume_figure.h"
#include "session/volume/test_volume.h"

namespace sonar {
namespace {

class VolumePointer : public testing::Test, public VolumeApp {};

TEST_F(VolumePointer, AClickIsAPressUponTheVoxelThatIsSeenThere) {
  std::vector<Voxel> pressed;
  std::vector<bool> doubled;
  model_->hooks.press = [&](const Voxel& voxel, bool shift, bool control, bool double_press) {
    pressed.push_back(voxel);
    doubled.push_back(double_press);
    EXPECT_FALSE(shift);
    EXPECT_FALSE(control);
  };
  const PixelPoint at = seen_place();
  point(PointerAction::press, at, PointerButton::left);
  point(PointerAction::release, {at.x + 3.0, at.y}, PointerButton::left);
  ASSERT_EQ(pressed.size(), 1U) << "three pixels are no drag";
  point(PointerAction::double_press, at, PointerButton::left);
  point(PointerAction::release, at, PointerButton::left);
  ASSERT_EQ(pressed.size(), 2U);
  EXPECT_TRUE(doubled[1]);

  // By the rule: the ping's volume, the view curve, the overview of a picture with this layout.
  const StagedPing& staged = *workspace_.document.staged();
  const Sector& sector = workspace_.document.shown()->sector();
  const double depth = workspace_.document.shown()->files().navigation[0].transducer_depth_m;
  const VolumeData volume = volume_data(sector, {staged.filtered->counts, staged.filtered->flags}, kNotFiltered, depth);
  PictureOptions options;
  options.size = kVolumeTestSize;
  options.least_text_px = kLeastText_px;
  const auto place = volume_place(options);
  const auto& points = workspace_.view_curve().points();
  VolumeView view;
  view.size = place->rays;
  view.camera = overview(sector, view.size);
  const auto picked = pick(
      volume, *optical_table(workspace_.view_curve(), kMostTableEntries, points.front().sv_db, points.back().sv_db), {},
      view, {at.x - place->rect.x, at.y - place->rect.y});
  ASSERT_TRUE(picked);
  EXPECT_EQ(pressed[1], (Voxel{picked->fan, picked->beam, picked->sample}));
}

TEST_F(VolumePointer, ADragTurnsHalfWayRoundOverTheVolumesHeight) {
  int presses = 0;
  model_->hooks.press = [&](auto&&...) { ++presses; };
  const Camera before = camera();
  const PixelPoint from = seen_place();
  drag(PointerButton::left, from, {from.x + model_->shown()->place.height, from.y});
  EXPECT_EQ(presses, 0);
  const Camera after = camera();
  EXPECT_EQ(after.target, before.target);
  // Opposite, as high, as far.
  EXPECT_NEAR(after.eye.x - after.target.x, before.target.x - before.eye.x, 1e-6);
  EXPECT_NEAR(after.eye.y - after.target.y, before.target.y - before.eye.y, 1e-6);
  EXPECT_NEAR(after.eye.z, before.eye.z, 1e-6);
}

TEST_F(VolumePointer, WhatIsNearFollowsTheDragThatTurns) {
  const Camera before = camera();
  // A place between eye and target.
  const Point<Sonar> near = before.target + (before.eye - before.target) * 0.3;
  const PixelSize size = model_->shown()->view.size;
  const auto was = basis(before, size).project(near);
  drag(PointerButton::left, {100.0, 100.0}, {110.0, 106.0});
  const auto is = basis(camera(), size).project(near);
  ASSERT_TRUE(was && is);
  EXPECT_GT(is->pixel.x, was->pixel.x);
  EXPECT_GT(is->pixel.y, was->pixel.y);
}

TEST_F(VolumePointer, TheMiddleButtonMovesTheTargetWithThePointer) {
  const Camera before = camera();
  const PixelSize size = model_->shown()->view.size;
  const auto was = basis(before, size).project(before.target);
  drag(PointerButton::middle, {100.0, 100.0}, {117.0, 91.0});
  const auto is = basis(camera(), size).project(before.target);
  ASSERT_TRUE(was && is);
  EXPECT_NEAR(is->pixel.x - was->pixel.x, 17.0, 1e-6);
  EXPECT_NEAR(is->pixel.y - was->pixel.y, -9.0, 1e-6);
}

TEST_F(VolumePointer, TheWheelComesNearerToWhatIsUnderThePointer) {
  const PixelPoint at = seen_place();
  const auto picked = model_->shown()->picked_at(at);
  const Camera before = camera();
  PointerEvent wheel{PointerAction::wheel, PointerButton::none, at};
  wheel.wheel_steps = 2.0;
  model_->pointer(wheel);
  settle();
  EXPECT_LT(norm(camera().eye - picked->position), 0.8 * norm(before.eye - picked->position));
  const auto seen = model_->shown()->place_of(picked->position);
  ASSERT_TRUE(seen);
  EXPECT_NEAR(seen->x, at.x, 1e-6);
  EXPECT_NEAR(seen->y, at.y, 1e-6);
}

TEST_F(VolumePointer, TheCursorIsWhereItsVoxelIsSeen) {
  const PixelPoint at = seen_place();
  point(PointerAction::move, at);
  const auto picked = model_->shown()->picked_at(at);
  ASSERT_TRUE(workspace_.cursor());
  EXPECT_EQ(*workspace_.cursor(), (Voxel{picked->fan, picked->beam, picked->sample}));
  const auto overlays = model_->overlays();
  ASSERT_EQ(overlays.size(), 1U);
  // A cell of this sector is some pixels wide in so small a picture; the pointer was in it.
  EXPECT_NEAR(overlays[0].cross->x, at.x, 30.0);
  EXPECT_NEAR(overlays[0].cross->y, at.y, 30.0);
  point(PointerAction::leave, at);
  EXPECT_FALSE(workspace_.cursor());
  EXPECT_TRUE(model_->overlays().empty());
}

TEST_F(VolumePointer, SidesAreLookedFrom) {
  // Unit vectors towards the eye: x bow, y starboard, z down.
  const auto from = [&](VolumeSide side) {
    model_->look_from(side);
    const Camera& camera = *model_->camera();
    return (camera.eye - camera.target) * (1.0 / norm(camera.eye - camera.target));
  };
  EXPECT_LT(from(VolumeSide::above).z, -0.999);
  EXPECT_LT(from(VolumeSide::above).x, 0.0) << "the bow points up";
  EXPECT_GT(from(VolumeSide::starboard).y, 0.999);
  EXPECT_LT(from(VolumeSide::port).y, -0.999);
  EXPECT_LT(from(VolumeSide::behind).x, -0.999);
  model_->look_from(VolumeSide::overview);
  EXPECT_FALSE(model_->camera());
}

}  // namespace
}  // namespace sonar
