// SPDX-License-Identifier: Apache-2.0
// Playing through pings, on a clock that the test turns.
#include <gtest/gtest.h>

#include "clocked_window.h"
#include "session/playback.h"

namespace sonar {
namespace {

class Playing : public ClockedWindow {
 protected:
  /// Seconds from a ping to the next, as they were recorded.
  double between_s(std::int64_t ping) {
    const auto& pings = document().shown()->files().navigation;
    const auto i = static_cast<std::size_t>(ping);
    return static_cast<double>(pings[i + 1].time - pings[i].time) / 1e9;
  }
};

// Keys go through the rates, down to that of the recording.
TEST_F(Playing, InRealTimeEveryPingComesAtItsTimeAndSpaceStopsIt) {
  for (int i = 0; i < 3; ++i) press(Qt::Key_Minus);
  press(Qt::Key_Space);
  ASSERT_TRUE(app_->playback->playing());
  tick(0.0);
  std::int64_t pictures = app_->picture("top_slice")->pictures();
  for (std::int64_t ping = 0; ping < 3; ++ping) {
    tick(0.9 * between_s(ping));
    EXPECT_EQ(document().ping(), ping) << "too early";
    tick(0.2 * between_s(ping));
    EXPECT_EQ(document().ping(), ping + 1);
    EXPECT_EQ(document().staged()->ping_index, ping + 1);
    EXPECT_GT(app_->picture("top_slice")->pictures(), pictures) << "the slice follows";
    pictures = app_->picture("top_slice")->pictures();
    tick(0.0);  // the ping is seen from now on
  }
  press(Qt::Key_Space);
  EXPECT_FALSE(app_->playback->playing());
  tick(100.0);
  EXPECT_EQ(document().ping(), 3);
}

TEST_F(Playing, SpaceShowsTwoPingsASecondPlusFiveAndTheEndStops) {
  press(Qt::Key_Space);
  tick(0.0);
  tick(0.45);
  EXPECT_EQ(document().ping(), 0);
  tick(0.1);
  EXPECT_EQ(document().ping(), 1);
  press(Qt::Key_Plus);
  tick(0.0);
  tick(0.18);
  EXPECT_EQ(document().ping(), 1);
  tick(0.04);
  EXPECT_EQ(document().ping(), 2);
  press(Qt::Key_End);
  tick(0.0);
  tick(0.0);
  EXPECT_FALSE(app_->playback->playing());
  EXPECT_EQ(document().ping(), TestSurvey::kPings - 1);
}

TEST_F(Playing, NGoesToASchoolAndStopsIt) {
  press(Qt::Key_D, Qt::ControlModifier);
  press(Qt::Key_Space);
  ASSERT_TRUE(app_->playback->playing());
  press(Qt::Key_N);
  EXPECT_FALSE(app_->playback->playing());
  ASSERT_TRUE(workspace().selected());
  const std::int64_t ping = document().ping();
  EXPECT_NE(in_ping(document().state().schools[*workspace().selected()]->masks, ping), nullptr);
  tick(0.0);
  tick(100.0);
  EXPECT_EQ(document().ping(), ping);
}

TEST_F(Playing, CtrlSpaceHasTheFirstPingComeAfterTheLast) {
  press(Qt::Key_Space, Qt::ControlModifier);
  press(Qt::Key_End);
  press(Qt::Key_Left);
  press(Qt::Key_Space);
  for (const std::int64_t next : {TestSurvey::kPings - 1, std::int64_t{0}, std::int64_t{1}}) {
    tick(0.0);  // the ping is seen from now on
    tick(0.55);
    EXPECT_EQ(document().ping(), next);
  }
  EXPECT_TRUE(app_->playback->playing());
  press(Qt::Key_Space);
}

}  // namespace
}  // namespace sonar
