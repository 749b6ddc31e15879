// SPDX-License-Identifier: Apache-2.0
// The timeline by mouse: going to a ping, events, bad intervals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QCheckBox>
#include <QDoubleSpinBox>

#include "session/timelines/timeline_model.h"
#include "window_at_work.h"

namespace sonar {
namespace {

class Timeline : public WindowAtWork {
 protected:
  static constexpr const char* kDock = "observation_timeline";
  TimelineModel& timeline() { return dynamic_cast<TimelineModel&>(*app_->picture(kDock)); }
  TimeNs time_of(std::int64_t ping) {
    return document().shown()->files().navigation[static_cast<std::size_t>(ping)].time;
  }
  PixelPoint place_of(std::int64_t ping) {
    const PixelRect& plot = timeline().places()->plot.place;
    return {timeline().places()->x_of(time_of(ping)), plot.y + 0.5 * plot.height};
  }
};

TEST_F(Timeline, AClickGoesToItsPingAndADragFollowsThePointer) {
  click(kDock, place_of(7));
  EXPECT_EQ(document().ping(), 7);
  EXPECT_EQ(document().staged()->ping_index, 7);
  press_on(view(kDock), place_of(7));
  move(kDock, place_of(4));
  EXPECT_EQ(document().ping(), 4);
  move(kDock, place_of(2));
  EXPECT_EQ(document().ping(), 2);
  release_on(view(kDock), place_of(2));
  move(kDock, place_of(9));
  EXPECT_EQ(document().ping(), 2) << "a pointer that holds nothing moves nothing";
}

TEST_F(Timeline, AJumpTakesEveryViewWithItAsStepsDo) {
  const auto pictures = [this] {
    std::vector<Image> all;
    for (const char* id : {"top_slice", "side_slice", "volume", "observation_map"})
      all.push_back(app_->picture(id)->image());
    return all;
  };
  // Step by step first, for what each view shows of a ping.
  for (int i = 0; i < 9; ++i) key(Qt::Key_Right);
  ASSERT_EQ(document().ping(), 9);
  const auto at_nine = pictures();
  for (int i = 0; i < 7; ++i) key(Qt::Key_Left);
  const auto at_two = pictures();
  click(kDock, place_of(9));
  const auto jumped = pictures();
  for (std::size_t i = 0; i < jumped.size(); ++i) {
    EXPECT_EQ(jumped[i], at_nine[i]) << i;
    EXPECT_NE(jumped[i], at_two[i]) << i;
  }
  raise("survey_timeline");
  auto& survey = dynamic_cast<TimelineModel&>(*app_->picture("survey_timeline"));
  const PixelRect& plot = survey.places()->plot.place;
  click("survey_timeline", {survey.places()->x_of(time_of(2)), plot.y + 0.5 * plot.height});
  EXPECT_EQ(document().staged()->ping_index, 2);
  EXPECT_EQ(pictures(), at_two);
}

TEST_F(Timeline, TheWheelZoomsAMiddleDragMovesAndADoubleClickShowsAll) {
  const PixelPoint at = place_of(6);
  const double apart = place_of(7).x - at.x;
  wheel(kDock, at, 2);
  ASSERT_TRUE(timeline().zoomed());
  EXPECT_NEAR(place_of(6).x, at.x, 1.0) << "what is pointed at stays";
  EXPECT_GT(place_of(7).x - place_of(6).x, 1.3 * apart);
  middle_drag(kDock, at, {at.x + 15.0, at.y});
  EXPECT_NEAR(place_of(6).x, at.x + 15.0, 1.0);
  EXPECT_EQ(document().ping(), 0) << "moving it looks at no other ping";
  double_click(kDock, place_of(6));
  EXPECT_FALSE(timeline().zoomed());
  EXPECT_NEAR(place_of(6).x, at.x, 1.0);
}

TEST_F(Timeline, SchoolsLieOverItsEchoesAndTheControlsGiveItLimitsOfItsOwn) {
  const Target target = look_at_school();
  const Image bare = timeline().image();
  double_click("top_slice", place_in("top_slice", target.voxel));
  EXPECT_NE(timeline().image(), bare) << "the school's line";
  const Image with = timeline().image();
  const Image slice = app_->picture("top_slice")->image();
  QTest::keyClick(&control<QCheckBox>("Timelines", "own_limits"), Qt::Key_Space);
  ASSERT_TRUE(workspace().timelines.values().own_limits);
  QTest::keyClick(&control<QDoubleSpinBox>("Timelines", "low_db.box"), Qt::Key_PageDown);
  settle();
  EXPECT_LT(workspace().timelines.values().low_db, workspace().display.values().scale.low_db);
  EXPECT_NE(timeline().image(), with);
  EXPECT_EQ(app_->picture("top_slice")->image(), slice) << "the slices keep theirs";
}

TEST_F(Timeline, ShiftF8ShowsFilteredDataAndControlF8TheMean) {
  const Image usual = timeline().image();
  const TimelineLimits limits = workspace().timelines.values();
  const bool slices = workspace().display.values().filtered;
  key(Qt::Key_F8, Qt::ShiftModifier);
  EXPECT_NE(workspace().timelines.values().filtered, limits.filtered);
  EXPECT_NE(timeline().image(), usual);
  key(Qt::Key_F8, Qt::ShiftModifier);
  EXPECT_EQ(timeline().image(), usual);
  key(Qt::Key_F8, Qt::ControlModifier);
  EXPECT_NE(workspace().timelines.values().maximum, limits.maximum);
  EXPECT_NE(timeline().image(), usual);
  key(Qt::Key_F8, Qt::ControlModifier);
  EXPECT_EQ(timeline().image(), usual);
  EXPECT_EQ(workspace().display.values().filtered, slices) << "F8 alone is the slices'";
}

TEST_F(Timeline, AnEventStandsAtThePingThatWasClicked) {
  std::string asked;
  app_->dialogs.text = [&](const std::string& title, const std::string&, const std::string&) {
    asked = title;
    return std::string("trawl 12");
  };
  click(kDock, place_of(5));
  const Image before = timeline().image();
  key(Qt::Key_T);
  EXPECT_EQ(asked, "Mark trawl");
  ASSERT_EQ(document().state().events.size(), 1U);
  const EventCommand& event = document().state().events[0];
  EXPECT_EQ(event.kind, "trawl");
  EXPECT_EQ(event.text, "trawl 12");
  EXPECT_EQ(event.time, document().shown()->context().times[5]);
  EXPECT_FALSE(timeline().image() == before) << "the mark is drawn";
  EXPECT_THAT(timeline().hint(place_of(5)), testing::HasSubstr("trawl: trawl 12"));
  click(kDock, place_of(1));
  key(Qt::Key_BracketRight, Qt::ControlModifier);
  EXPECT_EQ(document().ping(), 5) << "the next event";
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_TRUE(document().state().events.empty());
}

TEST_F(Timeline, AnIntervalThatIsMarkedBadTakesNoPartInMeasures) {
  const Target target = look_at_school();
  double_click("top_slice", place_in("top_slice", target.voxel));
  const auto& product = document().product(0);
  ASSERT_TRUE(product);
  ASSERT_EQ(product->schools.size(), 1U);
  const auto measured = product->schools[0].n_pings;
  const std::int64_t first = masks().front().ping_index;
  const std::int64_t last = masks().back().ping_index;
  ASSERT_GT(last, first);
  drag(kDock, place_of(first), place_of(first + 1), Qt::ShiftModifier);
  ASSERT_TRUE(workspace().marked_interval());
  EXPECT_EQ(*workspace().marked_interval(), (MarkedInterval{0, first, first + 1}));
  key(Qt::Key_X, Qt::ShiftModifier);
  ASSERT_EQ(document().state().bad_pings.size(), 1U);
  const auto& times = document().shown()->context().times;
  EXPECT_TRUE(is_bad(document().state(), times[static_cast<std::size_t>(first)]));
  EXPECT_TRUE(is_bad(document().state(), times[static_cast<std::size_t>(first + 1)]));
  EXPECT_EQ(document().product(0)->schools.at(0).n_pings, measured - 2);
}

}  // namespace
}  // namespace sonar
