// SPDX-License-Identifier: Apache-2.0
// Playing through pings, on a clock that the test turns.
#include <gtest/gtest.h>

#include <QAction>
#include <QLineEdit>

#include "clocked_window.h"
#include "gui/action_menus.h"
#include "session/pictures/picture_sentence.h"
#include "session/playing/playback.h"
#include "session/volume/volume_model.h"

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

TEST_F(Playing, AnyRateIsTypedInAndWhatIsNoneIsRefused) {
  const auto type_rate = [this](const char* typed) {
    with_dialog([this] { find_action(*window_, "ping.rate")->trigger(); },
                [typed](QDialog& dialog) {
                  auto* line = dialog.findChild<QLineEdit*>();
                  ASSERT_NE(line, nullptr);
                  line->selectAll();
                  QTest::keyClicks(line, typed);
                  QTest::keyClick(line, Qt::Key_Return);
                });
    settle_jobs();
  };
  type_rate("4");
  EXPECT_EQ(app_->playback->rate(), 4.0);
  type_rate("fast");
  EXPECT_EQ(app_->playback->rate(), 4.0);
  EXPECT_NE(document().notices().back().find("'fast' is no rate"), std::string::npos) << document().notices().back();
  view("top_slice")->setFocus();
  press(Qt::Key_Space);
  tick(0.0);
  tick(0.23);
  EXPECT_EQ(document().ping(), 0);
  tick(0.04);
  EXPECT_EQ(document().ping(), 1);
  press(Qt::Key_Space);
}

// Off at first. Between two pings the volume is of neither, says so, and is measured again as soon as nothing plays.
TEST_F(Playing, MotionIsInterpolatedWhereThatIsAskedForAndMarked) {
  raise("volume");
  const auto& volume = dynamic_cast<VolumeModel&>(*app_->picture("volume"));
  const auto half_way = [&] {
    press(Qt::Key_Space);
    tick(0.0);
    tick(0.25);
    ASSERT_EQ(document().ping(), 0);
    ASSERT_TRUE(volume.shown());
  };
  ASSERT_NO_FATAL_FAILURE(half_way());
  const Image measured = volume.image();
  EXPECT_EQ(volume.shown()->ping_index, 0);
  press(Qt::Key_Space);
  press(Qt::Key_9, Qt::ControlModifier);
  ASSERT_NO_FATAL_FAILURE(half_way());
  EXPECT_EQ(volume.shown()->ping_index, -1);
  EXPECT_NE(volume.image(), measured);
  const auto said = [this] { return picture_sentence(*app_, "volume").find("interpolated") != std::string::npos; };
  EXPECT_TRUE(said());
  keep_picture("interpolated");
  press(Qt::Key_Space);
  EXPECT_EQ(volume.shown()->ping_index, 0);
  EXPECT_EQ(volume.image(), measured);
  EXPECT_FALSE(said());
}

}  // namespace
}  // namespace sonar
