// SPDX-License-Identifier: Apache-2.0
// The keys of the volume: round a school, earth-fixed, with trails.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "session/volume/volume_model.h"
#include "window_at_work.h"

namespace sonar {
namespace {

class VolumeKeys : public WindowAtWork {
 protected:
  /// With a school that is selected and followed.
  void SetUp() override {
    WindowAtWork::SetUp();
    const Target target = look_at_school();
    double_click("top_slice", place_in("top_slice", target.voxel));
    ASSERT_TRUE(workspace().selected());
    raise("volume");
    ASSERT_TRUE(model().shown());
  }
  VolumeModel& model() { return dynamic_cast<VolumeModel&>(*app_->picture("volume")); }
  Camera camera() { return model().shown()->view.camera; }
  /// How far a place is outside the box of the selected school's voxels in the ping on show, m.
  double outside_m(const Point<Sonar>& place) {
    const auto* there = in_ping(document().state().schools.front()->masks, document().ping());
    EXPECT_NE(there, nullptr);
    if (there == nullptr) return std::numeric_limits<double>::infinity();
    const Sector& sector = document().shown()->sector();
    constexpr double kFar = 1e9;
    Point<Sonar> low;
    low.x = low.y = low.z = kFar;
    Point<Sonar> high;
    high.x = high.y = high.z = -kFar;
    for (const sonar::Run& run : there->mask.runs) {
      for (const int sample : {run.first_sample, run.end() - 1}) {
        const auto at = sector.centre(run.row / sector.beams(), run.row % sector.beams(), sample);
        low.x = std::min(low.x, at.x);
        low.y = std::min(low.y, at.y);
        low.z = std::min(low.z, at.z);
        high.x = std::max(high.x, at.x);
        high.y = std::max(high.y, at.y);
        high.z = std::max(high.z, at.z);
      }
    }
    return std::max(
        {low.x - place.x, place.x - high.x, low.y - place.y, place.y - high.y, low.z - place.z, place.z - high.z, 0.0});
  }
  /// Where the ship's sonar is seen.
  PixelPoint ship() {
    const auto at = model().shown()->place_of({});
    EXPECT_TRUE(at);
    return at.value_or(PixelPoint{});
  }
  double away_px(PixelPoint from) { return std::hypot(ship().x - from.x, ship().y - from.y); }
};

TEST_F(VolumeKeys, Ctrl6LooksAtTheSchoolAndADragGoesRoundIt) {
  ASSERT_GT(outside_m(camera().target), 0.5) << "else nothing is shown here";
  const double distance_m = norm(camera().eye - camera().target);
  key(Qt::Key_6, Qt::ControlModifier);
  const Camera centred = camera();
  EXPECT_LT(outside_m(centred.target), 0.5);
  EXPECT_NEAR(norm(centred.eye - centred.target), distance_m, 1e-6) << "from as far as before";
  const PixelRect& place = model().shown()->place;
  const PixelPoint middle{place.x + 0.5 * place.width, place.y + 0.5 * place.height};
  drag("volume", middle, {middle.x + 60.0, middle.y + 20.0});
  EXPECT_GT(norm(camera().eye - centred.eye), 10.0);
  EXPECT_LT(norm(camera().target - centred.target), 1e-6);
}

TEST_F(VolumeKeys, Ctrl7HasTheShipSailThroughAViewThatStandsStill) {
  const PixelPoint there = ship();
  key(Qt::Key_Right);
  EXPECT_LT(away_px(there), 0.5) << "the view goes with the ship";
  key(Qt::Key_Left);
  key(Qt::Key_7, Qt::ControlModifier);
  EXPECT_LT(away_px(there), 0.5) << "nobody sails yet";
  key(Qt::Key_Right);
  EXPECT_GT(away_px(there), 0.5);
  key(Qt::Key_Left);
  EXPECT_LT(away_px(there), 0.5);
  key(Qt::Key_7, Qt::ControlModifier);
  EXPECT_FALSE(workspace().volume.values().earth_fixed);
}

TEST_F(VolumeKeys, Ctrl8DrawsTracksAndTrails) {
  key(Qt::Key_Right);
  ASSERT_GT(document().ping(), 0) << "a trail has a past";
  const Image without = model().image();
  key(Qt::Key_8, Qt::ControlModifier);
  EXPECT_GT(workspace().volume.values().trail_pings, 0);
  EXPECT_NE(model().image(), without);
  keep_picture("trails");
  key(Qt::Key_8, Qt::ControlModifier);
  EXPECT_EQ(workspace().volume.values().trail_pings, 0);
}

}  // namespace
}  // namespace sonar
