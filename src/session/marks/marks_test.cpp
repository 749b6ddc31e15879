// SPDX-License-Identifier: Apache-2.0
#include "session/marks/marks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <variant>

#include "session/marks/bookmarked_view.h"
#include "session/test_app.h"

namespace sonar {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(BookmarkedView, GoesThroughATextUnchanged) {
  BookmarkedView view;
  view.slices = {3, 11, 250};
  view.slices_locked = true;
  view.plane = {PlaneSlice::Kind::oblique, 12.5, 271.25, 30.0, -4.75};
  view.school = 7;
  EXPECT_EQ(bookmarked_view(text_of(view)), view);
  view.camera = Camera{{1.5, -20.25, -300.0}, {100.0, 0.5, 40.0}, {0.0, 0.1, -1.0}};
  EXPECT_EQ(bookmarked_view(text_of(view)), view);
}

TEST(BookmarkedView, WhatNoWindowHasIsNone) {
  for (const char* text : {"", "[]", "7", R"({"fan": "three"})", R"({"fan": 1e400})", R"({"plane": []})"}) {
    EXPECT_FALSE(bookmarked_view(text)) << text;
  }
  EXPECT_EQ(bookmarked_view("{}"), BookmarkedView{});
  for (const char* camera : {R"({"eye_m": [0,0,0], "target_m": [0,0,0], "up": [0,0,-1]})",
                             R"({"eye_m": [0,0], "target_m": [0,0,0], "up": [0,0,-1]})",
                             R"({"eye_m": [0,0,1e9], "target_m": [0,0,0], "up": [0,0,-1]})", "3"}) {
    EXPECT_EQ(bookmarked_view(std::string(R"({"camera": )") + camera + "}"), BookmarkedView{}) << camera;
  }
}

class Marks : public testing::Test, protected TestApp {
 protected:
  /// With a cache, where small pictures are kept.
  void open_again() {
    DocumentOptions options = TestSurvey::options(journal_);
    options.cache.folder = cache_;
    app_ = std::make_unique<AppModel>(queue_, std::move(options));
    app_->dialogs.text = [this](const auto&, const auto&, const auto&) { return said_; };
    document().open({TestSurvey::easy().folder()});
    document().settle();
  }
  void look_at(std::int64_t ping) {
    document().look_at(ping);
    document().settle();
  }
  void mark(const std::string& action, const std::string& text) {
    said_ = text;
    press(action);
    document().settle();
  }
  [[nodiscard]] Rows& list() { return *app_->rows("marks"); }
  [[nodiscard]] std::vector<std::string> column(std::size_t at) {
    std::vector<std::string> texts;
    for (std::size_t row = 0; row < list().rows(); ++row) texts.push_back(list().cell(row, at).text);
    return texts;
  }
  std::filesystem::path cache_ = TestSurvey::easy().fresh();
  std::string said_;
};

TEST_F(Marks, StandInTheOrderOfTimeWithWhatWasWritten) {
  open_again();
  EXPECT_EQ(list().rows(), 0U);
  look_at(6);
  mark("event.trawl", "haul 12");
  app_->workspace.marked_interval.set(MarkedInterval{0, 2, 4});
  press("bad.interval");
  look_at(9);
  press("bad.ping");
  document().settle();
  EXPECT_THAT(column(0), ElementsAre("bad pings", "trawl", "bad pings"));
  EXPECT_THAT(column(1), ElementsAre(HasSubstr("to ping 4"), "haul 12", "takes no part in measures"));
  EXPECT_THAT(column(3), ElementsAre("2", "6", "9"));
  EXPECT_FALSE(list().picture(0)) << "no bookmark, no room for pictures";
  list().select(1);
  EXPECT_EQ(document().ping(), 6);
  EXPECT_EQ(list().selected(), 1U);
  press("school.delete");
  document().settle();
  EXPECT_THAT(column(0), ElementsAre("bad pings", "bad pings")) << "Delete is about the mark that was clicked";
  document().undo();
  document().settle();
  EXPECT_THAT(column(1), ElementsAre(HasSubstr("to ping 4"), "haul 12", "takes no part in measures"));
}

TEST_F(Marks, ABookmarkLeadsBackToWhatWasSeen) {
  open_again();
  const SchoolMasks masks = longest_found();
  ASSERT_FALSE(masks.pings.empty());
  ASSERT_TRUE(
      workspace().volume.set("earth_fixed", true));  // the eye of a bookmark is where it was, in its ping's frame
  look_at(masks.pings.front().ping_index);
  const auto& schools = document().state().schools;
  select(schools.front()->number);
  document().settle();
  workspace().slices_locked.set(true);
  workspace().slices.set({2, 3, 17});
  workspace().plane.assign({PlaneSlice::Kind::oblique, 20.0, 33.0, 25.0, 8.0});
  workspace().camera.set(Camera{{0.0, 10.0, -200.0}, {50.0, 0.0, 20.0}, {0.0, 0.0, -1.0}});
  LivePicture& slice = *app_->picture("top_slice");
  slice.resize({640, 400}, 1.0);
  slice.set_seen(true);
  slice.wait();
  queue_.drain();
  const std::int64_t ping = document().ping();
  const BookmarkedView seen = view_now(workspace());
  ASSERT_NE(seen.school, 0);
  mark("event.bookmark", "two in one");
  ASSERT_EQ(list().rows(), 1U);
  const auto leave = [&] {
    workspace().slices_locked.set(false);
    workspace().school.set(std::nullopt);
    look_at(ping == 0 ? 5 : 0);
    workspace().slices.set({0, 0, 0});
    workspace().plane.assign({});
    workspace().camera.set(std::nullopt);
  };
  leave();
  const LivePicture& volume = *app_->picture("volume");
  list().select(0);
  document().settle();
  EXPECT_EQ(document().ping(), ping);
  EXPECT_EQ(view_now(workspace()), seen);
  EXPECT_EQ(list().selected(), 0U) << "Delete is about it";
  const std::int64_t version = volume.version();
  workspace().camera.set(std::nullopt);
  EXPECT_GT(volume.version(), version) << "a camera that others set is drawn";
  workspace().camera.set(seen.camera);
  // Of another kind of plane alone, too.
  workspace().plane.assign({PlaneSlice::Kind::vertical, 20.0, 33.0, 25.0, 8.0});
  list().select(0);
  EXPECT_EQ(view_now(workspace()), seen);
  ASSERT_TRUE(list().picture(0));
  EXPECT_TRUE(std::filesystem::is_regular_file(*list().picture(0)));
  // Another day, and without the cache.
  open_again();
  leave();
  std::filesystem::remove_all(cache_);
  ASSERT_EQ(list().rows(), 1U);
  EXPECT_EQ(list().picture(0), std::filesystem::path{});
  EXPECT_THAT(column(1), ElementsAre("two in one"));
  list().select(0);
  document().settle();
  EXPECT_EQ(document().ping(), ping);
  EXPECT_EQ(view_now(workspace()), seen);
}

TEST_F(Marks, ABookmarkWhoseSchoolIsGoneLeadsToTheRest) {
  open_again();
  look_at(4);
  workspace().slices.set({1, 2, 30});
  BookmarkedView view = view_now(workspace());
  view.school = 99;
  view.slices.sample = 1'000'000;
  const TimeNs time = document().shown()->context().times[4];
  document().act(4, EventCommand{"bookmark", time, "", text_of(view)});
  look_at(0);
  workspace().slices.set({0, 0, 0});
  list().select(0);
  document().settle();
  EXPECT_EQ(document().ping(), 4);
  EXPECT_EQ(workspace().slices(), (SlicePlaces{1, 2, document().shown()->sector().range().count - 1}));
  EXPECT_FALSE(workspace().school());
}

TEST_F(Marks, WithoutAWordNothingIsBookmarked) {
  open_again();
  mark("event.bookmark", "");
  EXPECT_THAT(column(0), IsEmpty());
}

}  // namespace
}  // namespace sonar
