// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "publish/echograms/echogram_cache.h"
#include "session/app_parts.h"
#include "session/listening.h"
#include "session/maps/test_maps.h"
#include "session/pictures/exports.h"
#include "session/timelines/timeline_painter.h"

namespace sonar {
namespace {

/// Where a timeline shows a ping.
PixelPoint place_of(const TimelineModel& timeline, const Document& document, std::size_t observation,
                    std::int64_t ping) {
  const auto& places = *timeline.places();
  const TimeNs time = document.survey()->observations[observation].navigation[static_cast<std::size_t>(ping)].time;
  return {places.x_of(time), places.plot.place.y + 20.0};
}

TEST(TimelineModel, AClickAndDraggingGoToThePingOfThatTime) {
  TestMaps maps;
  maps.see(maps.timeline);
  Document& document = maps.workspace.document;
  TestMaps::click(maps.timeline, place_of(maps.timeline, document, 0, 7));
  EXPECT_EQ(document.ping(), 7);
  TestMaps::drag(maps.timeline, place_of(maps.timeline, document, 0, 7), place_of(maps.timeline, document, 0, 3));
  EXPECT_EQ(document.ping(), 3);
  maps.see(maps.survey_timeline, {900, 300});
  TestMaps::click(maps.survey_timeline, place_of(maps.survey_timeline, document, 1, 5));
  EXPECT_EQ(document.shown()->index(), 1U);
  EXPECT_EQ(document.ping(), 5);
}

TEST(TimelineModel, ThePlayheadIsNoNewPicture) {
  TestMaps maps;
  maps.see(maps.timeline);
  const auto pictures = maps.timeline.pictures();
  maps.workspace.document.look_at(6);
  maps.settle();
  EXPECT_EQ(maps.timeline.pictures(), pictures);
  const auto overlays = maps.timeline.overlays();
  ASSERT_EQ(overlays.size(), 1U);
  EXPECT_NEAR(overlays[0].line.front().x, place_of(maps.timeline, maps.workspace.document, 0, 6).x, 1e-6);
}

TEST(TimelineModel, TheEchogramIsThatOfEveryPingReadAtOnce) {
  TestMaps maps;
  EXPECT_FALSE(maps.echograms->of(0));
  maps.see(maps.timeline);
  const auto filled = maps.echograms->of(0);
  ASSERT_TRUE(filled);
  EXPECT_TRUE(maps.echograms->complete(0));
  EXPECT_FALSE(maps.echograms->of(1)) << "only what somebody looks at is read";
  const auto& shown = *maps.workspace.document.shown();
  Engine engine(shown.survey(), shown.files(), maps.workspace.document.recipe());
  const EchogramRange range = echogram_range(shown.sector().range());
  EchogramPyramid whole(range);
  for (std::int64_t i = 0; i < shown.pings(); ++i) {
    const auto ping = engine.staged(i);
    ASSERT_TRUE(ping);
    whole.add_ping(shown.files().navigation[static_cast<std::size_t>(i)].time,
                   echogram_column(shown.sector(), {ping->sv.counts, ping->filtered->flags}, kNotFiltered, range));
  }
  ASSERT_EQ(filled->levels(), whole.levels());
  for (int level = 0; level < whole.levels(); ++level) EXPECT_EQ(filled->level(level), whole.level(level));
  maps.see(maps.survey_timeline, {900, 300});
  EXPECT_TRUE(maps.echograms->complete(1));
}

TEST(TimelineModel, FilteredDataAreAnEchogramOfTheirOwnWhichIsReadWhenItIsAskedFor) {
  TestMaps maps;
  maps.see(maps.timeline, {900, 400});
  const auto filtered = EchogramName::of_all_beams(0, true);
  EXPECT_FALSE(maps.echograms->of(filtered));
  const Image as_recorded = maps.timeline.image();
  ASSERT_TRUE(maps.workspace.timelines.set("filtered", true));
  maps.settle();
  EXPECT_TRUE(maps.timeline.incomplete().empty());
  const auto filled = maps.echograms->of(filtered);
  ASSERT_TRUE(filled && maps.echograms->complete(filtered));
  const auto& shown = *maps.workspace.document.shown();
  Engine engine(shown.survey(), shown.files(), maps.workspace.document.recipe());
  Work work;
  ASSERT_TRUE(engine.estimate_background(0, shown.pings() - 1, work));
  const EchogramRange range = echogram_range(shown.sector().range());
  EchogramPyramid whole(range);
  for (std::int64_t i = 0; i < shown.pings(); ++i) {
    const auto ping = engine.staged(i);
    ASSERT_TRUE(ping);
    whole.add_ping(shown.files().navigation[static_cast<std::size_t>(i)].time,
                   echogram_column(shown.sector(), *ping->filtered, kNotFiltered, range));
  }
  EXPECT_EQ(filled->level(0), whole.level(0));
  EXPECT_NE(maps.timeline.image(), as_recorded);
  ASSERT_TRUE(maps.workspace.timelines.set("filtered", false));
  maps.settle();
  EXPECT_EQ(maps.timeline.image(), as_recorded) << "both are kept";
  ASSERT_TRUE(maps.workspace.timelines.set("maximum", false));
  maps.settle();
  EXPECT_NE(maps.timeline.image(), as_recorded) << "the mean";
}

TEST(TimelineLimits, OfMeansBeginLowerUnlessTheyAreItsOwn) {
  SvScale slices;
  slices.low_db = -50.0;
  slices.map = ColourMapName::ek500;
  slices.threshold_db = -90.0;
  TimelineLimits limits;
  EXPECT_EQ(limits.scale(slices), slices) << "a beam's own Sv, as in slices";
  limits.maximum = false;
  SvScale means = slices;
  means.low_db = -75.0;
  EXPECT_EQ(limits.scale(slices), means);
  limits.own_limits = true;
  limits.low_db = -82.0;
  limits.span_db = 20.0;
  means.low_db = -82.0;
  means.span_db = 20.0;
  EXPECT_EQ(limits.scale(slices), means);
}

TEST(TimelineModel, OwnLimitsAreTheSlicesUntilTheyAreSwitchedOnAndThenNotTheirs) {
  TestMaps maps;
  Workspace& workspace = maps.workspace;
  maps.see(maps.timeline);
  const auto seen = [&] {
    maps.settle();
    return maps.timeline.image();
  };
  const Image usual = seen();
  ASSERT_TRUE(workspace.timelines.set("low_db", -75.0));
  EXPECT_EQ(seen(), usual) << "off";
  ASSERT_TRUE(workspace.timelines.set("own_limits", true));
  const Image own = seen();
  EXPECT_NE(own, usual);
  DisplayParams display = workspace.display.values();
  display.scale.low_db = -75.0;
  workspace.display.assign(display);
  EXPECT_EQ(seen(), own) << "the slices' limits are not its own";
  ASSERT_TRUE(workspace.timelines.set("own_limits", false));
  EXPECT_EQ(seen(), own) << "the same limits, now of the slices";
}

TEST(TimelineLimits, AreThoseOfAPictureInAFileAndOfNoOtherKind) {
  TestMaps maps;
  Workspace& workspace = maps.workspace;
  ASSERT_TRUE(workspace.timelines.set("own_limits", true));
  ASSERT_TRUE(workspace.timelines.set("low_db", -80.0));
  ASSERT_TRUE(workspace.timelines.set("span_db", 50.0));
  ASSERT_TRUE(workspace.timelines.set("filtered", true));
  const auto timeline = picture_options(workspace, PictureKind::timeline);
  const auto slice = picture_options(workspace, PictureKind::slice_top);
  ASSERT_TRUE(timeline && slice);
  EXPECT_EQ(timeline->display.scale.low_db, -80.0);
  EXPECT_EQ(timeline->display.scale.high_db(), -30.0);
  EXPECT_TRUE(timeline->display.filtered);
  EXPECT_FALSE(slice->display.filtered);
  EXPECT_EQ(slice->display.scale, workspace.display.values().scale);
  Preferences kept;
  kept.take(workspace);
  Workspace next(maps.queue, {});
  kept.apply(next);
  EXPECT_EQ(next.timelines.values().low_db, -80.0);
}

TEST(TimelineModel, AClickMovesPlayheadsMapAndStripBeforeThePingHasArrived) {
  TestMaps maps;
  for (LivePicture* picture :
       std::vector<LivePicture*>{&maps.map, &maps.strip, &maps.timeline, &maps.survey_timeline}) {
    maps.see(*picture, {600, 300});
  }
  const Document& document = maps.workspace.document;
  for (const bool whole_survey : {false, true}) {
    const std::int64_t ping = whole_survey ? 4 : 9;
    TimelineModel& clicked = whole_survey ? maps.survey_timeline : maps.timeline;
    ASSERT_FALSE(document.shown()->cache().held(ping));
    int playheads = 0;
    Listening listening;
    listening.to(maps.timeline.changed(), [&] { ++playheads; });
    listening.to(maps.survey_timeline.changed(), [&] { ++playheads; });
    const Image map = maps.map.image();
    const Image strip = maps.strip.image();
    TestMaps::click(clicked, place_of(clicked, document, 0, ping));
    // Nothing has been drained yet: this is what a window shows while the ping is read.
    EXPECT_EQ(document.ping(), ping);
    EXPECT_GE(playheads, 2);
    for (TimelineModel* timeline : {&maps.timeline, &maps.survey_timeline}) {
      ASSERT_FALSE(timeline->overlays().empty());
      EXPECT_NEAR(timeline->overlays()[0].line[0].x, place_of(*timeline, document, 0, ping).x, 1e-9);
    }
    maps.map.wait();
    maps.strip.wait();
    maps.queue.drain();
    EXPECT_NE(maps.map.image(), map) << "the map marks the ping that is looked at";
    EXPECT_NE(maps.strip.image(), strip);
    maps.settle();
    EXPECT_EQ(document.staged()->ping_index, ping);
  }
}

TEST(TimelineModel, ShiftAndDraggingMarksAnInterval) {
  TestMaps maps;
  maps.see(maps.timeline);
  const Document& document = maps.workspace.document;
  TestMaps::drag(maps.timeline, place_of(maps.timeline, document, 0, 8), place_of(maps.timeline, document, 0, 4), true);
  EXPECT_EQ(maps.workspace.marked_interval(), (MarkedInterval{0, 4, 8}));
  EXPECT_EQ(document.ping(), 0) << "marking looks nowhere";
  EXPECT_EQ(maps.timeline.overlays().size(), 2U);
}

TEST(TimelineModel, TheWheelZoomsAboutThePointerTheMiddleButtonPansAndADoublePressShowsAll) {
  TestMaps maps;
  maps.see(maps.timeline, {900, 300});
  const Document& document = maps.workspace.document;
  const TimelineInterval all = maps.timeline.places()->all;
  const PixelPoint at = place_of(maps.timeline, document, 0, 7);
  maps.timeline.pointer({.action = PointerAction::wheel, .at = at, .wheel_steps = 2.0});
  maps.timeline.pointer({.action = PointerAction::wheel, .at = at, .wheel_steps = 1.0});
  maps.settle();
  EXPECT_TRUE(maps.timeline.zoomed());
  EXPECT_NEAR(place_of(maps.timeline, document, 0, 7).x, at.x, 0.01) << "the time under the pointer stays";
  const auto span_s = [&] {
    const PlotFrame& plot = maps.timeline.places()->plot;
    return plot.x.last - plot.x.first;
  };
  const double whole_s = static_cast<double>(all.last - all.first) / 1e9;
  EXPECT_NEAR(span_s(), std::max(10.0, whole_s / (1.25 * 1.25 * 1.25)), 0.01);

  const double before = place_of(maps.timeline, document, 0, 7).x;
  maps.timeline.pointer({.action = PointerAction::press, .button = PointerButton::middle, .at = at});
  maps.timeline.pointer({.action = PointerAction::move, .button = PointerButton::middle, .at = {at.x + 5.0, at.y}});
  maps.timeline.pointer({.action = PointerAction::release, .button = PointerButton::middle, .at = {at.x + 5.0, at.y}});
  maps.settle();
  EXPECT_NEAR(place_of(maps.timeline, document, 0, 7).x, before + 5.0, 0.01);
  EXPECT_EQ(document.ping(), 0) << "panning looks nowhere";
  // However far it is dragged, it stays on the survey's time.
  for (const double far : {1e6, -1e6}) {
    maps.timeline.pointer({.action = PointerAction::press, .button = PointerButton::middle, .at = at});
    maps.timeline.pointer({.action = PointerAction::move, .button = PointerButton::middle, .at = {at.x + far, at.y}});
    maps.settle();
    const PlotFrame& plot = maps.timeline.places()->plot;
    EXPECT_NEAR(far > 0.0 ? plot.x.first : plot.x.last, far > 0.0 ? 0.0 : whole_s, 1e-6);
  }
  // What is looked at from elsewhere comes into sight.
  maps.workspace.document.look_at(0);
  maps.settle();
  maps.workspace.document.look_at(11);
  maps.settle();
  const double last_x = place_of(maps.timeline, document, 0, 11).x;
  const PixelRect& place = maps.timeline.places()->plot.place;
  EXPECT_TRUE(last_x > place.x && last_x <= place.x + place.width + 0.5);

  maps.timeline.pointer({.action = PointerAction::double_press, .button = PointerButton::left, .at = at});
  maps.settle();
  EXPECT_FALSE(maps.timeline.zoomed());
  EXPECT_NEAR(place_of(maps.timeline, document, 0, 7).x, at.x, 0.01);
  for (int i = 0; i < 60; ++i) {
    maps.timeline.pointer({.action = PointerAction::wheel, .at = at, .wheel_steps = 1.0});
  }
  maps.settle();
  EXPECT_NEAR(span_s(), 10.0, 0.01);
  for (int i = 0; i < 60; ++i) {
    maps.timeline.pointer({.action = PointerAction::wheel, .at = at, .wheel_steps = -1.0});
  }
  EXPECT_FALSE(maps.timeline.zoomed());
}

TEST(TimelineModel, AClickChoosesTheMarkThatLiesThere) {
  TestMaps maps;
  Document& document = maps.workspace.document;
  const auto& times = document.shown()->context().times;
  const EventCommand trawl{"trawl", times[3], "haul 1"};
  const BadPingsCommand bad{times[6], times[8]};
  document.act(3, trawl);
  document.act(6, bad);
  maps.see(maps.timeline);
  TestMaps::click(maps.timeline, place_of(maps.timeline, document, 0, 3));
  EXPECT_EQ(maps.workspace.mark(), (ChosenMark{0, trawl}));
  EXPECT_EQ(maps.timeline.overlays().size(), 2U);
  TestMaps::click(maps.timeline, place_of(maps.timeline, document, 0, 7));
  EXPECT_EQ(maps.workspace.mark(), (ChosenMark{0, bad}));
  maps.timeline.aim(place_of(maps.timeline, document, 0, 3));
  EXPECT_EQ(maps.workspace.mark(), (ChosenMark{0, trawl})) << "a context menu is about what lies under it";
  maps.workspace.school.set(SchoolName{0, 1});  // Delete is about the school again
  EXPECT_FALSE(maps.workspace.mark());
  TestMaps::click(maps.timeline, place_of(maps.timeline, document, 0, 7));
  TestMaps::click(maps.timeline, place_of(maps.timeline, document, 0, 10));
  EXPECT_FALSE(maps.workspace.mark()) << "nothing lies there";
  TestMaps::click(maps.timeline, place_of(maps.timeline, document, 0, 3));
  document.undo();
  document.undo();
  maps.settle();
  EXPECT_FALSE(maps.workspace.mark()) << "it is gone";
}

}  // namespace
}  // namespace sonar
