// SPDX-License-Identifier: Apache-2.0
#include "session/live/live_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "session/test_app.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// An app on a folder into which the small survey's files are written piece by piece.
class LiveApp : public testing::Test, protected TestApp {
 protected:
  LiveApp() {
    fs::create_directories(live_);
    for (const auto& entry : fs::directory_iterator(TestSurvey::easy().folder())) {
      if (entry.path().extension() == ".raw") raw_.push_back(entry.path());
    }
    std::sort(raw_.begin(), raw_.end());
  }

  void begin() {
    app_ = std::make_unique<AppModel>(queue_, TestSurvey::options(journal_));
    document().open({live_});
    document().settle();
  }
  [[nodiscard]] LiveWatch& live() { return *app_->live; }

  /// Writes on until so much of a file is there.
  void record(std::size_t file, double share) const {
    std::ifstream in(raw_[file], std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    const fs::path to = live_ / raw_[file].filename();
    std::error_code absent;
    const auto there = fs::exists(to) ? static_cast<std::size_t>(fs::file_size(to, absent)) : std::size_t{0};
    const auto upto = static_cast<std::size_t>(share * static_cast<double>(bytes.size()));
    std::ofstream(to, std::ios::binary | std::ios::app)
        .write(bytes.data() + there, static_cast<std::streamsize>(upto - there));
  }
  /// The window's turns until all that was written has been taken in.
  void turns() {
    for (int i = 0; i < 12; ++i) {
      app_->animations.tick(now_s_ += 0.3);
      live().settle();
      document().settle();
    }
  }
  [[nodiscard]] bool told(const std::string& words) {
    const auto& notices = document().notices();
    return std::any_of(notices.begin(), notices.end(),
                       [&](const std::string& notice) { return notice.find(words) != std::string::npos; });
  }

  fs::path live_ = TestSurvey::easy().fresh() / "live";
  std::vector<fs::path> raw_;
  double now_s_ = 10.0;
};

// What the files' ends tell comes first, and is not yet the survey that is to be followed.
TEST_F(LiveApp, TheSurveyThatIsOpenedNextIsFollowed) {
  record(0, 0.5);
  app_ = std::make_unique<AppModel>(queue_, TestSurvey::options(journal_));
  live().follow_next();
  document().open({live_});
  document().settle();
  EXPECT_TRUE(live().on());
}

TEST_F(LiveApp, ShowsTheNewestPingAndTellsOfSchools) {
  record(0, 0.3);
  begin();
  const std::int64_t before = document().shown()->pings();
  document().look_at(before - 1);
  std::string rule = "big > 3";
  app_->dialogs.text = [&](const auto&, const auto&, const auto&) { return std::optional(rule); };
  press("file.alarm");
  EXPECT_TRUE(told("'big > 3'"));
  rule = "range_m < 1000";
  press("file.alarm");
  press("file.live");
  turns();
  EXPECT_TRUE(live().at_newest());
  record(0, 0.99);
  turns();
  EXPECT_GT(document().shown()->pings(), before);
  ASSERT_TRUE(document().staged());
  EXPECT_EQ(document().staged()->ping_index, document().shown()->pings() - 1);
  EXPECT_THAT(live().text(), HasSubstr("obs-0001 ping"));
  EXPECT_TRUE(told("obs-0001/1: "));
  EXPECT_TRUE(told("ALARM range_m < 1000: "));
  EXPECT_EQ(document().state().schools.size(), 2U);
  ASSERT_TRUE(document().product(0));
  EXPECT_EQ(std::ssize(document().product(0)->pings), document().shown()->pings());
  EXPECT_EQ(document().product(0)->schools.size(), 2U);
  // The next file: another observation, shown as it begins.
  record(0, 1.0);
  record(1, 0.9);
  turns();
  EXPECT_EQ(document().shown()->name(), "obs-0002");
  EXPECT_TRUE(live().at_newest());
  EXPECT_EQ(document().state().schools.size(), 2U);
  press("file.live");
  EXPECT_FALSE(live().on());
  EXPECT_EQ(live().text(), "");
}

TEST_F(LiveApp, WhoLooksBackIsNotDisturbedAndLGoesToTheNewest) {
  record(0, 0.5);
  begin();
  document().look_at(document().shown()->pings() - 1);
  press("file.live");
  turns();
  workspace().slices.set({3, 4});
  document().look_at(1);
  turns();
  record(0, 0.95);
  turns();
  EXPECT_EQ(document().ping(), 1);
  EXPECT_EQ(document().staged()->ping_index, 1);
  EXPECT_EQ(workspace().slices(), (SlicePlaces{3, 4}));
  EXPECT_FALSE(live().at_newest());
  press("ping.live");
  turns();
  EXPECT_TRUE(live().at_newest());
  EXPECT_EQ(document().staged()->ping_index, document().shown()->pings() - 1);
}

TEST_F(LiveApp, WhatAHumanDecidedStays) {
  record(0, 0.6);
  begin();
  press("file.live");
  turns();
  ASSERT_EQ(document().state().schools.size(), 2U);
  const std::int64_t number = document().state().schools.front()->number;
  select(number);
  press("review.reject");
  turns();
  paint(0, 1, 2, 2, 400);
  turns();
  const auto decided = [&] {
    const auto& schools = document().state().schools;
    return std::count_if(schools.begin(), schools.end(),
                         [](const auto& school) { return school->masks.decided.status == "rejected"; });
  };
  ASSERT_EQ(decided(), 1);
  const std::size_t schools = document().state().schools.size();
  record(0, 0.99);
  turns();
  EXPECT_EQ(decided(), 1);
  EXPECT_EQ(document().state().schools.size(), schools);
  press("edit.undo");
  press("edit.undo");
  turns();
  EXPECT_EQ(document().state().schools.size(), schools - 1);
}

TEST_F(LiveApp, WaitsForAFolderThatIsGone) {
  record(0, 0.4);
  begin();
  document().look_at(document().shown()->pings() - 1);
  press("file.live");
  turns();
  const std::int64_t before = document().shown()->pings();
  const fs::path away = live_.parent_path() / "away";
  fs::rename(live_, away);
  turns();
  EXPECT_TRUE(told("waiting for it"));
  EXPECT_EQ(document().shown()->pings(), before);
  fs::rename(away, live_);
  record(0, 0.9);
  turns();
  EXPECT_GT(document().shown()->pings(), before);
}

TEST_F(LiveApp, BeginsInAFolderThatHoldsNothingYet) {
  begin();
  ASSERT_EQ(document().shown(), nullptr);
  press("file.live");
  turns();
  record(0, 0.5);
  turns();
  ASSERT_NE(document().shown(), nullptr);
  EXPECT_TRUE(live().at_newest());
}

}  // namespace
}  // namespace sonar
