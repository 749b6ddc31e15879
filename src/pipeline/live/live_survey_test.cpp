// SPDX-License-Identifier: Apache-2.0
#include "pipeline/live/live_survey.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "io/simrad/test_bytes.h"

namespace sonar {
namespace {

using std::chrono::seconds;
using test::Bytes;
using test::kStart;
using testing::ElementsAre;

constexpr TimeNs kMinute = 60 * kSecondNs;

Bytes echo_sounder(TimeNs start, int pings) {
  Bytes bytes = test::con0({.sounder = "ER60", .beams = {{38'000.0F}}}, start);
  for (int i = 0; i < pings; ++i) bytes.add(test::raw0(start + i * kSecondNs, {.channel = 1}, {1, 2, 3}));
  return bytes;
}

class Recording : public testing::Test {
 protected:
  void append(const std::string& name, std::span<const std::byte> bytes) const {
    std::ofstream(folder_.path() / name, std::ios::binary | std::ios::app)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
  LiveSurvey::News look(int later_s = 1) {
    now_ += seconds(later_s);
    auto news = live_.look(now_, work_);
    EXPECT_TRUE(news);
    return news ? *news : LiveSurvey::News{};
  }
  /// "obs-0001 3": name and pings.
  [[nodiscard]] std::vector<std::string> observations() const { return told(*live_.survey()); }
  static std::vector<std::string> told(const SurveyFiles& survey) {
    std::vector<std::string> names;
    for (const auto& one : survey.observations) names.push_back(one.name + " " + std::to_string(one.pings.size()));
    return names;
  }
  [[nodiscard]] bool over(const std::string& name) const { return live_.over(*live_.survey()->find(name)); }
  [[nodiscard]] SurveyFiles finished() const {
    Work work(1);
    return *open_survey(std::vector{folder_.path()}, {}, {}, {}, work);
  }

  test::TemporaryFolder folder_;
  Work work_{1};
  LiveSurvey live_{{folder_.path()}, {}, {}, {}};
  LiveClock::time_point now_ = LiveClock::time_point{} + seconds(1000);
};

TEST_F(Recording, AnyChoppingOfTheBytesGivesTheSurveyOfTheFinishedFiles) {
  const std::vector<std::pair<std::string, Bytes>> files{{"a.raw", test::small_file(3)},
                                                         {"b.raw", test::small_file(2, kStart + kMinute)},
                                                         {"c.raw", test::small_file(2, kStart + 10 * kMinute)}};
  for (const std::size_t piece : {std::size_t{1}, std::size_t{7}, std::size_t{4096}}) {
    LiveSurvey live({folder_.path()}, {}, {}, {});
    for (const auto& [name, bytes] : files) {
      std::filesystem::remove(folder_.path() / name);
    }
    for (const auto& [name, bytes] : files) {
      for (std::size_t at = 0; at < bytes.size(); at += piece) {
        append(name, std::span(bytes.data).subspan(at, std::min(piece, bytes.size() - at)));
        ASSERT_TRUE(live.look(now_ += seconds(1), work_));
      }
    }
    live.end();
    ASSERT_TRUE(live.look(now_ += seconds(1), work_));
    const SurveyFiles expected = finished();
    EXPECT_EQ(told(*live.survey()), told(expected));
    EXPECT_EQ(told(expected), (std::vector<std::string>{"obs-0001 5", "obs-0002 2"}));
    for (std::size_t f = 0; f < files.size(); ++f) {
      EXPECT_EQ(live.survey()->files[f].index.hash, expected.files[f].index.hash);
      EXPECT_EQ(live.survey()->files[f].index.diagnostics.size(), expected.files[f].index.diagnostics.size());
    }
  }
}

TEST_F(Recording, IsOverWhenTheNextHasBegunAndItsFileRests) {
  append("a.raw", test::small_file(3).data);
  look();
  EXPECT_THAT(observations(), ElementsAre("obs-0001 3"));
  EXPECT_FALSE(over("obs-0001"));
  append("b.raw", test::small_file(2, kStart + 10 * kMinute).data);
  look(1);
  look(3);
  EXPECT_THAT(observations(), ElementsAre("obs-0001 3", "obs-0002 2"));
  EXPECT_TRUE(over("obs-0001"));
  EXPECT_FALSE(over("obs-0002"));
  live_.let_go_before("obs-0002");
  EXPECT_THAT(observations(), ElementsAre("obs-0002 2"));
  append("c.raw", test::small_file(4, kStart + 20 * kMinute).data);
  look(1);
  EXPECT_THAT(observations(), ElementsAre("obs-0002 2", "obs-0003 4"));
}

TEST_F(Recording, AnotherSoundersFileKeepsNoneOpen) {
  append("ms.raw", test::small_file(3).data);
  append("ek.raw", echo_sounder(kStart, 2).data);
  look();
  for (int i = 0; i < 130; ++i) {  // the echo sounder goes on, the sonar rests
    append("ek.raw", test::raw0(kStart + (10 + i) * kSecondNs, {.channel = 1}, {1, 2, 3}).data);
    look();
  }
  EXPECT_TRUE(over("obs-0001"));
  EXPECT_FALSE(over("obs-0002"));
}

TEST_F(Recording, AFileThatIsTakenAwayIsNoPartOfIt) {
  append("a.raw", test::small_file(1).data);
  append("b.raw", test::small_file(2, kStart + 10 * kMinute).data);
  look();
  std::filesystem::remove(folder_.path() / "a.raw");
  EXPECT_FALSE(look().cannot);
  EXPECT_THAT(observations(), ElementsAre("obs-0001 2"));
  // Where none is left, it is the disk that is away.
  std::filesystem::rename(folder_.path() / "b.raw", folder_.path() / "b.away");
  EXPECT_TRUE(look().cannot);
  EXPECT_THAT(observations(), ElementsAre("obs-0001 2"));
}

TEST_F(Recording, AFileThatJoinsTwoMakesOneObservation) {
  append("a.raw", test::small_file(2).data);
  append("c.raw", test::small_file(2, kStart + 3 * kMinute).data);
  look();
  EXPECT_THAT(observations(), ElementsAre("obs-0001 2", "obs-0002 2"));
  append("b.raw", test::small_file(2, kStart + 90 * kSecondNs).data);
  look();
  EXPECT_THAT(observations(), ElementsAre("obs-0001 6"));
}

TEST_F(Recording, TheFileThatAppearedLastIsTheOneWrittenWhateverItsClock) {
  append("a.raw", test::small_file(2, kStart + kMinute * 60).data);
  look();
  append("b.raw", test::small_file(2).data);  // the recorder's clock was set back
  look();
  look(3);
  EXPECT_THAT(observations(), ElementsAre("obs-0001 2", "obs-0002 2"));
  EXPECT_FALSE(over("obs-0001"));  // of b.raw
  EXPECT_TRUE(std::any_of(live_.survey()->files.begin(), live_.survey()->files.end(),
                          [](const SurveyFile& file) { return !file.index.hash.empty(); }));
}

TEST_F(Recording, WhatComesBeforeWhatIsFollowedIsTold) {
  append("b.raw", test::small_file(2, kStart + 20 * kMinute).data);
  look();
  append("c.raw", test::small_file(2, kStart + 40 * kMinute).data);
  look(1);
  look(3);
  live_.let_go_before("obs-0002");
  append("a.raw", test::small_file(2).data);
  const LiveSurvey::News news = look();
  ASSERT_TRUE(news.cannot);
  EXPECT_THAT(news.cannot->text, testing::HasSubstr("a run over all"));
  EXPECT_THAT(observations(), ElementsAre("obs-0002 2"));
  EXPECT_FALSE(look().cannot);
}

TEST_F(Recording, AnotherFileOfTheSameNameIsReadFromItsBeginning) {
  append("a.raw", test::small_file(2).data);
  look();
  std::filesystem::remove(folder_.path() / "a.raw");
  append("a.raw", test::small_file(3, kStart + 10 * kMinute).data);
  EXPECT_TRUE(look().replaced);
  ASSERT_THAT(observations(), ElementsAre("obs-0001 3"));
  EXPECT_EQ(live_.survey()->ping_time(live_.survey()->observations.front(), 0), kStart + 10 * kMinute);
}

}  // namespace
}  // namespace sonar
