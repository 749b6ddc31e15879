// SPDX-License-Identifier: Apache-2.0
// What two fingers on a touch pad do to a view: they move what is shown, and a pinch keeps what lies between them in its place.
#include <gtest/gtest.h>

#include <cmath>

#include "session/maps/map_gesture.h"
#include "session/maps/test_maps.h"
#include "session/slices/slice_places.h"
#include "session/slices/test_slices.h"
#include "session/volume/test_volume.h"

namespace sonar {
namespace {

PointerEvent pinch(PixelPoint at, double factor) { return {.action = PointerAction::zoom, .at = at, .factor = factor}; }
PointerEvent moved(PixelPoint at, PixelPoint by) { return {.action = PointerAction::pan, .at = at, .by = by}; }

TEST(TwoFingers, ZoomASliceAboutWhatLiesBetweenThem) {
  SlicesApp app;
  app.look_at_bright();
  const Voxel& voxel = SlicesApp::bright().voxel;
  lay_slices_through(app.workspace(), voxel);
  app.settle();
  const auto place = [&] { return app.top().picture()->place_of(voxel).value_or(PixelPoint{}); };
  const PixelPoint before = place();
  EXPECT_FALSE(app.top().pans()) << "all of it is shown: fingers go through the fans";
  app.top().pointer(pinch(before, 2.0));
  app.settle();
  EXPECT_TRUE(app.top().pans());
  EXPECT_NEAR(place().x, before.x, 1.0);
  EXPECT_NEAR(place().y, before.y, 1.0);
  app.top().pointer(moved(before, {30.0, -20.0}));
  app.settle();
  EXPECT_NEAR(place().x, before.x + 30.0, 1.5);
  EXPECT_NEAR(place().y, before.y - 20.0, 1.5);
  EXPECT_EQ(app.workspace().slices().fan, voxel.fan) << "the fan stays";
  app.top().pointer(pinch(before, 0.2));
  EXPECT_FALSE(app.top().zoomed()) << "there is no more than all";
}

TEST(TwoFingers, MoveAndZoomAMapAsMouseAndWheelDo) {
  const PixelRect place{10.0, 20.0, 400.0, 300.0};
  MapGesture fingers;
  MapGesture mouse;
  (void)fingers.take(pinch({100.0, 90.0}, 1.25 * 1.25), place, 3.0);
  (void)mouse.take({.action = PointerAction::wheel, .at = {100.0, 90.0}, .wheel_steps = 2.0}, place, 3.0);
  EXPECT_GT(fingers.zoom().factor, 1.5);
  EXPECT_NEAR(fingers.zoom().factor, mouse.zoom().factor, 1e-12);
  EXPECT_EQ(fingers.take(moved({0.0, 0.0}, {25.0, -40.0}), place, 3.0), MapGesture::Did::moved);
  (void)mouse.take({.action = PointerAction::press, .button = PointerButton::left, .at = {50.0, 80.0}}, place, 3.0);
  (void)mouse.take({.action = PointerAction::move, .button = PointerButton::left, .at = {75.0, 40.0}}, place, 3.0);
  EXPECT_NEAR(fingers.zoom().moved.x, mouse.zoom().moved.x, 1e-9);
  EXPECT_NEAR(fingers.zoom().moved.y, mouse.zoom().moved.y, 1e-9);
}

TEST(TwoFingers, MoveATimelineThatIsZoomed) {
  TestMaps maps;
  maps.see(maps.timeline);
  const auto time_at = [&](double x) { return maps.timeline.places()->time_at(x); };
  const PixelRect& plot = maps.timeline.places()->plot.place;
  const PixelPoint at{plot.x + 0.4 * plot.width, plot.y + 5.0};
  const TimeNs before = time_at(at.x);
  const auto second = static_cast<double>(time_at(at.x + 1.0) - before);  // of a pixel of the whole
  maps.timeline.pointer(pinch(at, 2.0));
  maps.settle();
  EXPECT_NEAR(static_cast<double>(time_at(at.x) - before), 0.0, second);
  maps.timeline.pointer(moved(at, {-20.0, 0.0}));
  maps.settle();
  EXPECT_NEAR(static_cast<double>(time_at(at.x - 20.0) - before), 0.0, second) << "it went with the fingers";
}

class TwoFingersOnAVolume : public testing::Test, public VolumeApp {};

TEST_F(TwoFingersOnAVolume, TurnItAsADragDoesAndAPinchComesNearer) {
  const PixelPoint at = seen_place();
  const Camera begun = camera();
  model_->pointer(moved(at, {40.0, 12.0}));
  const Camera turned = camera();
  workspace_.camera.set(begun);
  drag(PointerButton::left, at, {at.x + 40.0, at.y + 12.0});
  EXPECT_LT(norm(turned.eye - camera().eye), 1e-6);
  EXPECT_GT(norm(turned.eye - begun.eye), 1.0);
  workspace_.camera.set(begun);
  model_->pointer(pinch(at, 1.5));
  EXPECT_LT(norm(camera().eye - camera().target), norm(begun.eye - begun.target));
}

}  // namespace
}  // namespace sonar
