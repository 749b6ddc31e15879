// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "base/units.h"
#include "geo/geodesic.h"
#include "publish/movies/between_pings.h"
#include "session/volume/test_volume.h"

namespace sonar {
namespace {

class VolumeOnEarth : public testing::Test, public VolumeApp {
 protected:
  void fix(bool on) {
    ASSERT_TRUE(workspace_.volume.set("earth_fixed", on));
    settle();
  }
  [[nodiscard]] const PingNavigation& ping(std::int64_t index) const {
    return workspace_.document.shown()->files().navigation[static_cast<std::size_t>(index)];
  }
  /// A place 150 m abeam of ping 0 and 40 m deep, in the frame of the ping on show.
  [[nodiscard]] Point<Sonar> buoy() const { return buoy_from(ping(model_->shown()->ping_index)); }
  [[nodiscard]] Point<Sonar> buoy_from(const PingNavigation& now) const {
    const PingNavigation& first = ping(0);
    const double side = model_->shown()->volume->sector.centre(0, 0, 100).y < 0.0 ? -90.0 : 90.0;
    const Geographic there = destination(first.transducer, 150.0, first.heading_deg + side);
    Point<Sonar> out = to_sonar(to_enu(there, now.transducer), rad_from_deg(now.heading_deg));
    out.z = 40.0 - now.transducer_depth_m;
    return out;
  }
  [[nodiscard]] PixelPoint pixel(const Point<Sonar>& place) const {
    const auto at = model_->shown()->place_of(place);
    EXPECT_TRUE(at);
    return at.value_or(PixelPoint{1e9, 1e9});
  }
  static double away(PixelPoint a, PixelPoint b) { return std::hypot(a.x - b.x, a.y - b.y); }
};

// Law: a place on the earth keeps its pixel while the ship sails on, and the ship does not; in the ship's view it is the
// other way round.
TEST_F(VolumeOnEarth, APlaceOnTheEarthKeepsItsPixelWhilePingsPass) {
  fix(true);
  const PixelPoint there = pixel(buoy());
  const PixelPoint ship = pixel({});
  for (const std::int64_t next : {1, 4, 7, 2}) {
    look_at(next);
    ASSERT_EQ(model_->shown()->ping_index, next);
    EXPECT_LT(away(pixel(buoy()), there), 0.5) << next;
    EXPECT_GT(away(pixel({}), ship), 0.5 * static_cast<double>(next)) << next;
  }
  look_at(0);
  EXPECT_LT(away(pixel({}), ship), 0.5) << "back where it was";
  fix(false);
  look_at(7);
  EXPECT_LT(away(pixel({}), ship), 0.5);
  EXPECT_GT(away(pixel(buoy()), there), 2.0);
}

// The same law on the way from one ping to the next.
TEST_F(VolumeOnEarth, APlaceOnTheEarthKeepsItsPixelBetweenPings) {
  fix(true);
  const PixelPoint there = pixel(buoy());
  const PixelPoint ship = pixel({});
  const StagedPingPtr from = workspace_.document.staged();
  const StagedPingPtr to = *workspace_.document.shown()->ping(1);
  for (const double fraction : {0.3, 0.7}) {
    workspace_.motion.set({from, to, fraction});
    settle();
    EXPECT_LT(away(pixel(buoy_from(navigation_between(ping(0), ping(1), fraction))), there), 0.5) << fraction;
    EXPECT_GT(away(pixel({}), ship), 0.5 * fraction) << fraction;
  }
}

TEST_F(VolumeOnEarth, AnotherLookStandsStillFromThereOn) {
  fix(true);
  look_at(5);
  model_->look_from(VolumeSide::port);
  settle();
  const PixelPoint there = pixel(buoy());
  look_at(6);
  EXPECT_LT(away(pixel(buoy()), there), 0.5);
  model_->look_from(VolumeSide::overview);
  settle();
  EXPECT_FALSE(model_->camera());
}

// While a button is held down pings may pass.
TEST_F(VolumeOnEarth, ADragGoesOnWhereItWas) {
  fix(true);
  const PixelRect& place = model_->shown()->place;
  const PixelPoint middle{place.x + 0.5 * place.width, place.y + 0.5 * place.height};
  point(PointerAction::press, middle, PointerButton::middle);
  point(PointerAction::move, {middle.x + 20.0, middle.y}, PointerButton::middle);
  settle();
  const PixelPoint there = pixel(buoy());
  look_at(3);
  EXPECT_LT(away(pixel(buoy()), there), 0.5);
  point(PointerAction::move, {middle.x + 20.0, middle.y + 1.0}, PointerButton::middle);
  settle();
  EXPECT_LT(away(pixel(buoy()), there), 4.0) << "a pixel of the drag, not a jump to the ship";
}

TEST_F(VolumeOnEarth, TrailsOfNoPingChangeNoPixel) {
  look_at(6);
  const Image plain = model_->image();
  ASSERT_TRUE(workspace_.volume.set("trail_pings", 0));
  settle();
  EXPECT_EQ(model_->image(), plain);
  ASSERT_TRUE(workspace_.volume.set("ship_track", true));
  settle();
  const Image track = model_->image();
  EXPECT_NE(track, plain);
  ASSERT_TRUE(workspace_.volume.set("context", false));
  settle();
  const Image bare = model_->image();
  ASSERT_TRUE(workspace_.volume.set("ship_track", false));
  settle();
  EXPECT_EQ(model_->image(), bare) << "a track is a part of what stands round the volume";
}

}  // namespace
}  // namespace sonar
