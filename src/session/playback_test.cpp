// SPDX-License-Identifier: Apache-2.0
#include "session/playback.h"

#include <gtest/gtest.h>

#include "session/slices/test_slices.h"

namespace sonar {
namespace {

TEST(Pulse, RunsWhatHasMoreToDoAndSaysWhenItRests) {
  Pulse pulse;
  int changes = 0;
  pulse.changed().add([&] { ++changes; });
  int left = 2;
  pulse.run("count", [&](double) { return --left > 0; });
  EXPECT_TRUE(pulse.running());
  pulse.tick(0.0);
  EXPECT_TRUE(pulse.running());
  pulse.tick(0.1);
  EXPECT_FALSE(pulse.running());
  EXPECT_EQ(changes, 2);
  pulse.run("again", [&](double) {
    pulse.run("again", [](double) { return true; });  // by itself
    return false;
  });
  pulse.tick(0.2);
  EXPECT_TRUE(pulse.running()) << "the new one of that name stays";
  pulse.stop("again");
  EXPECT_FALSE(pulse.running());
}

class PlaybackAtWork : public testing::Test {
 protected:
  Playback& playback() { return *desk_.desk.playback; }
  Document& document() { return desk_.document(); }
  void tick(double now_s) {
    desk_.desk.pulse.tick(now_s);
    desk_.document().settle();
  }
  SlicesDesk desk_;
};

// Two pings a second on the test's own clock.
TEST_F(PlaybackAtWork, TellsHowManyPingsASecondItReaches) {
  EXPECT_EQ(playback().rate_text(), "1x");
  for (int i = 0; i < 3; ++i) desk_.ask("ping.faster");
  desk_.ask("ping.play");
  for (int i = 0; i < 6; ++i) tick(0.5 * i);
  EXPECT_EQ(playback().rate_text(), "as fast as possible, 2.0 pings/s");
  desk_.ask("ping.play");
  EXPECT_EQ(playback().rate_text(), "as fast as possible");
}

TEST_F(PlaybackAtWork, ShowsEveryPingInItsOrderAndThenRests) {
  std::vector<std::int64_t> arrived;
  document().changes().add([&](DocumentChange change) {
    if (change == DocumentChange::ping) arrived.push_back(document().staged()->ping_index);
  });
  for (int i = 0; i < 3; ++i) desk_.ask("ping.faster");
  EXPECT_EQ(playback().speed(), PlaySpeed::fastest);
  desk_.ask("ping.play");
  EXPECT_TRUE(playback().playing());
  for (int i = 0; i < 3 * TestSurvey::kPings && desk_.desk.pulse.running(); ++i) tick(0.02 * i);
  std::vector<std::int64_t> all;
  for (std::int64_t i = 1; i < TestSurvey::kPings; ++i) all.push_back(i);
  EXPECT_EQ(arrived, all);
  EXPECT_FALSE(playback().playing());
  EXPECT_FALSE(desk_.desk.pulse.running());
  playback().play();
  EXPECT_EQ(document().ping(), 0) << "from the beginning again";
}

TEST_F(PlaybackAtWork, WaitsForThePingThatItAskedFor) {
  for (int i = 0; i < 3; ++i) playback().faster();
  playback().play();
  document().look_at(8);  // not made ahead: on its way
  for (int i = 0; i < 100; ++i) desk_.desk.pulse.tick(1.0 * i);
  EXPECT_EQ(document().ping(), 8) << "nothing was drained, so nothing has come";
  desk_.settle();
  tick(101.0);
  EXPECT_EQ(document().ping(), 9);
}

TEST_F(PlaybackAtWork, KeepsTheTimeOfTheRecording) {
  const auto& times = document().shown()->ground().times;
  const double between_s = static_cast<double>(times[1] - times[0]) / static_cast<double>(kSecondNs);
  ASSERT_GT(between_s, 1.0);
  playback().play();
  tick(0.0);
  tick(0.98 * between_s);
  EXPECT_EQ(document().ping(), 0);
  tick(1.02 * between_s);
  EXPECT_EQ(document().ping(), 1);
  playback().faster();
  playback().faster();
  EXPECT_EQ(playback().speed_text(), "5x");
  tick(2.0 * between_s);
  tick(2.19 * between_s);
  EXPECT_EQ(document().ping(), 1);
  tick(2.21 * between_s);
  EXPECT_EQ(document().ping(), 2);
  playback().toggle();
  tick(100.0);
  EXPECT_EQ(document().ping(), 2);
}

TEST_F(PlaybackAtWork, StepsAndEndsByKeys) {
  desk_.ask("ping.next");
  EXPECT_EQ(document().ping(), 1);
  desk_.ask("ping.forward");
  EXPECT_EQ(document().ping(), 11);
  desk_.ask("ping.back");
  EXPECT_EQ(document().ping(), 1);
  desk_.ask("ping.last");
  EXPECT_EQ(document().ping(), TestSurvey::kPings - 1);
  desk_.ask("ping.next");
  EXPECT_EQ(document().ping(), TestSurvey::kPings - 1);
  desk_.ask("ping.first");
  EXPECT_EQ(document().ping(), 0);
  EXPECT_TRUE(desk_.desk.actions.clashes().empty());
}

}  // namespace
}  // namespace sonar
