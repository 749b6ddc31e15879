// SPDX-License-Identifier: Apache-2.0
#include "session/playing/playback.h"

#include <gtest/gtest.h>

#include "session/slices/test_slices.h"

namespace sonar {
namespace {

TEST(AnimationDriver, RunsWhatHasMoreToDoAndSaysWhenItRests) {
  AnimationDriver animations;
  int changes = 0;
  const Listening heard_of(animations.changed(), [&] { ++changes; });
  int left = 2;
  animations.run("count", [&](double) { return --left > 0; });
  EXPECT_TRUE(animations.running());
  animations.tick(0.0);
  EXPECT_TRUE(animations.running());
  animations.tick(0.1);
  EXPECT_FALSE(animations.running());
  EXPECT_EQ(changes, 2);
  animations.run("again", [&](double) {
    animations.run("again", [](double) { return true; });  // by itself
    return false;
  });
  animations.tick(0.2);
  EXPECT_TRUE(animations.running()) << "the new one of that name stays";
  animations.stop("again");
  EXPECT_FALSE(animations.running());
}

class PlaybackAtWork : public testing::Test {
 protected:
  Playback& playback() { return *app_.app.playback; }
  Document& document() { return app_.document(); }
  void tick(double now_s) {
    app_.app.animations.tick(now_s);
    app_.document().settle();
  }
  SlicesApp app_;
};

// Two pings a second on the test's own clock.
TEST_F(PlaybackAtWork, TellsHowManyPingsASecondItReaches) {
  EXPECT_EQ(playback().rate_text(), "2 pings/s");
  for (int i = 0; i < 4; ++i) app_.ask("ping.faster");
  app_.ask("ping.play");
  for (int i = 0; i < 6; ++i) tick(0.5 * i);
  EXPECT_EQ(playback().rate_text(), "as fast as possible, 2.0 reached");
  app_.ask("ping.play");
  EXPECT_EQ(playback().rate_text(), "as fast as possible");
}

TEST_F(PlaybackAtWork, ShowsEveryPingInItsOrderAndThenRests) {
  std::vector<std::int64_t> arrived;
  const Listening heard_of(document().changes(), [&](DocumentChange change) {
    if (change == DocumentChange::ping) arrived.push_back(document().staged()->ping_index);
  });
  for (int i = 0; i < 4; ++i) app_.ask("ping.faster");
  EXPECT_EQ(playback().rate(), Playback::kFastest);
  app_.ask("ping.play");
  EXPECT_TRUE(playback().playing());
  for (int i = 0; i < 3 * TestSurvey::kPings && app_.app.animations.running(); ++i) tick(0.02 * i);
  std::vector<std::int64_t> all;
  for (std::int64_t i = 1; i < TestSurvey::kPings; ++i) all.push_back(i);
  EXPECT_EQ(arrived, all);
  EXPECT_FALSE(playback().playing());
  EXPECT_FALSE(app_.app.animations.running());
  playback().play();
  EXPECT_EQ(document().ping(), 0) << "from the beginning again";
}

TEST_F(PlaybackAtWork, WaitsForThePingThatItAskedFor) {
  playback().set_rate(Playback::kFastest);
  playback().play();
  document().look_at(8);  // not made ahead: on its way
  for (int i = 0; i < 100; ++i) app_.app.animations.tick(1.0 * i);
  EXPECT_EQ(document().ping(), 8) << "nothing was drained, so nothing has come";
  app_.settle();
  tick(101.0);
  EXPECT_EQ(document().ping(), 9);
}

TEST_F(PlaybackAtWork, KeepsTheTimeOfTheRecording) {
  const auto& times = document().shown()->context().times;
  const double between_s = static_cast<double>(times[1] - times[0]) / static_cast<double>(kSecondNs);
  ASSERT_GT(between_s, 1.0);
  playback().set_rate(Playback::kRealTime);
  playback().play();
  tick(0.0);
  tick(0.98 * between_s);
  EXPECT_EQ(document().ping(), 0);
  tick(1.02 * between_s);
  EXPECT_EQ(document().ping(), 1);
  playback().toggle();
  tick(100.0);
  EXPECT_EQ(document().ping(), 1);
}

TEST_F(PlaybackAtWork, ShowsTwoPingsASecondUnlessAnotherRateIsAskedFor) {
  playback().play();
  tick(0.0);
  tick(0.49);
  EXPECT_EQ(document().ping(), 0);
  tick(0.51);
  EXPECT_EQ(document().ping(), 1);
  std::string answer = "8";
  app_.app.dialogs.text = [&](const std::string&, const std::string&, const std::string&) {
    return std::optional(answer);
  };
  app_.ask("ping.rate");
  EXPECT_EQ(playback().speed_text(), "8 pings/s");
  tick(1.0);
  tick(1.12);
  EXPECT_EQ(document().ping(), 1);
  tick(1.13);
  EXPECT_EQ(document().ping(), 2);
  app_.ask("ping.slower");
  EXPECT_EQ(playback().rate(), 5.0) << "the next lower of those that the keys go through";
  answer = "many";
  app_.ask("ping.rate");
  EXPECT_EQ(playback().rate(), 5.0);
  EXPECT_EQ(document().notices().back(), "'many' is no rate: expected pings a second, up to 1000");
}

TEST_F(PlaybackAtWork, LoopsWhereThatIsAskedFor) {
  app_.ask("ping.loop");
  playback().set_rate(Playback::kFastest);
  document().look_at(TestSurvey::kPings - 2);
  app_.settle();
  playback().play();
  for (int i = 0; i < 8; ++i) tick(0.02 * i);
  EXPECT_TRUE(playback().playing());
  EXPECT_LT(document().ping(), 8);
  app_.ask("ping.loop");
  for (int i = 0; i < 3 * TestSurvey::kPings && playback().playing(); ++i) tick(1.0 + 0.02 * i);
  EXPECT_EQ(document().ping(), TestSurvey::kPings - 1);
}

// At two pings a second a quarter of a second after a ping is half of the way; whenever it rests, pings are as measured.
TEST_F(PlaybackAtWork, IsBetweenPingsOnlyWhereThatIsAskedFor) {
  const auto motion = [this]() -> const MotionBetween& { return app_.workspace().motion(); };
  const auto tick_ready = [this](double now_s) {
    tick(now_s);
    document().shown()->cache().wait();  // what is made ahead
    app_.settle();
  };
  playback().play();
  tick_ready(0.0);
  tick_ready(0.25);
  EXPECT_EQ(motion().from, nullptr) << "off by default";
  ASSERT_TRUE(app_.workspace().volume.set("interpolated", true));
  tick_ready(0.25);
  ASSERT_TRUE(motion().from && motion().to);
  EXPECT_EQ(motion().from->ping_index, 0);
  EXPECT_EQ(motion().to->ping_index, 1);
  EXPECT_DOUBLE_EQ(motion().fraction, 0.5);
  tick_ready(0.5);
  tick_ready(0.52);
  EXPECT_EQ(document().ping(), 1);
  EXPECT_EQ(motion().from, nullptr) << "a ping that has come is as measured";
  tick_ready(0.62);
  EXPECT_EQ(motion().from->ping_index, 1);
  EXPECT_NEAR(motion().fraction, 0.2, 1e-9);
  playback().pause();
  EXPECT_EQ(motion().from, nullptr);
  document().look_at(TestSurvey::kPings - 2);
  app_.settle();
  playback().set_loops(true);
  playback().play();
  for (const double now_s : {10.0, 10.5, 10.6}) tick_ready(now_s);
  ASSERT_EQ(document().ping(), TestSurvey::kPings - 1);
  tick_ready(10.8);
  EXPECT_EQ(motion().from, nullptr) << "nothing lies between the last ping and the first";
}

TEST_F(PlaybackAtWork, StepsAndEndsByKeys) {
  app_.ask("ping.next");
  EXPECT_EQ(document().ping(), 1);
  app_.ask("ping.forward");
  EXPECT_EQ(document().ping(), 11);
  app_.ask("ping.back");
  EXPECT_EQ(document().ping(), 1);
  app_.ask("ping.last");
  EXPECT_EQ(document().ping(), TestSurvey::kPings - 1);
  app_.ask("ping.next");
  EXPECT_EQ(document().ping(), TestSurvey::kPings - 1);
  app_.ask("ping.first");
  EXPECT_EQ(document().ping(), 0);
  EXPECT_TRUE(app_.app.actions.clashes().empty());
}

}  // namespace
}  // namespace sonar
