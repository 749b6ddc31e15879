// SPDX-License-Identifier: Apache-2.0
#include "session/charts/chart_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "session/maps/test_maps.h"
#include "session/test_app.h"

namespace sonar {
namespace {

/// Three schools by hand: 1 in pings 2 to 4, 2 in ping 2 alone, farther off; 3 in pings 7 to 8.
class Charts : public testing::Test, protected TestApp {
 protected:
  void SetUp() override {
    begin();
    paint(2, 4, 5, 5, 200);
    paint(2, 2, 10, 10, 300);
    paint(7, 8, 3, 12, 400);
    document().settle();
    workspace().school.set(std::nullopt);
    chart().resize({640, 400}, 1.0);
    chart().set_seen(true);
    settle();
  }
  ChartModel& chart() { return dynamic_cast<ChartModel&>(*app_->picture("chart")); }
  void settle() {
    do {
      document().settle();
      chart().wait();
    } while (queue_.drain() > 0);
  }
  void show(const std::string& x, const std::string& y) {
    ASSERT_TRUE(workspace().picture_file.set("chart.x", x));
    ASSERT_TRUE(workspace().picture_file.set("chart.y", y));
    settle();
    ASSERT_EQ(chart().problem(), "");
  }
  std::size_t row_of(std::int64_t school, std::int64_t ping) {
    const auto& rows = chart().sight()->data.rows;
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const ChartRow& row) {
      return row.school.number == school && row.ping_index == ping;
    });
    EXPECT_NE(found, rows.end());
    return static_cast<std::size_t>(found - rows.begin());
  }
  PixelPoint place_of(std::int64_t school, std::int64_t ping) {
    return chart().sight()->places.points[row_of(school, ping)];
  }
  void drag(PixelPoint from, PixelPoint to, bool shift = false) {
    TestMaps::drag(chart(), from, to, shift);
    settle();
  }
  void click(PixelPoint at) {
    TestMaps::click(chart(), at);
    settle();
  }
  /// From left of one place to right of another, over the whole plot's height.
  void brush(PixelPoint first, PixelPoint last, bool shift = false) {
    const PixelRect& plot = chart().sight()->places.plot.place;
    drag({first.x - 3.0, plot.y + 1.0}, {last.x + 3.0, plot.y + plot.height - 1.0}, shift);
  }
};

TEST_F(Charts, ShowTheTablesFiguresAsTheyAreMeasured) {
  show("ping_index", "depth_m");
  const ChartData& data = chart().sight()->data;
  const ProductPtr product = document().product(0);
  ASSERT_EQ(data.rows.size(), product->school_pings.size());
  ASSERT_EQ(data.rows.size(), 6U);
  for (std::size_t row = 0; row < data.rows.size(); ++row) {
    EXPECT_EQ(data.y_values[row], product->school_pings[row].depth_m);
  }
  // And follow what is done.
  select(2);
  press("school.delete");
  settle();
  EXPECT_EQ(chart().sight()->data.rows.size(), 5U);
  document().undo();
  settle();
  EXPECT_EQ(chart().sight()->data.rows.size(), 6U);
}

TEST_F(Charts, DraggingOverPointsSelectsTheirSchoolsInTablesToo) {
  show("ping_index", "depth_m");
  document().look_at(8);
  settle();
  brush(place_of(1, 2), place_of(1, 2));
  EXPECT_EQ(workspace().chosen_schools(), (std::set<SchoolName>{{0, 1}, {0, 2}}));
  EXPECT_EQ(workspace().school(), (SchoolName{0, 1}));
  EXPECT_EQ(app_->rows("schools")->chosen(), (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(document().ping(), 4) << "views come to the nearest ping in which the first is seen";
  brush(place_of(1, 4), place_of(1, 4));
  EXPECT_TRUE(workspace().chosen_schools().empty()) << "one alone";
  EXPECT_EQ(workspace().school(), (SchoolName{0, 1}));
  brush(place_of(3, 7), place_of(3, 8), true);
  EXPECT_EQ(workspace().chosen_schools(), (std::set<SchoolName>{{0, 1}, {0, 3}})) << "Shift adds";
  // The review acts on all that are brushed.
  press("review.accept");
  settle();
  const auto& schools = document().state().schools;
  EXPECT_EQ(schools.at(0)->masks.decided.status, "accepted");
  EXPECT_EQ(schools.at(1)->masks.decided.status, "unreviewed");
  EXPECT_EQ(schools.at(2)->masks.decided.status, "accepted");
  const PixelRect& plot = chart().sight()->places.plot.place;
  click({plot.x + 2.0, plot.y + 2.0});
  EXPECT_FALSE(workspace().school()) << "a click on nothing selects nothing";
  brush(place_of(1, 2), place_of(1, 2));
  press("tool.cancel");
  EXPECT_FALSE(workspace().school()) << "so does Esc";
  EXPECT_TRUE(workspace().chosen_schools().empty());
}

TEST_F(Charts, AClickOnAPointGoesToItsPing) {
  show("time_utc", "depth_m");
  click(place_of(3, 8));
  EXPECT_EQ(document().ping(), 8);
  EXPECT_EQ(workspace().school(), (SchoolName{0, 3}));
  const auto overlays = chart().overlays();
  ASSERT_EQ(overlays.size(), 1U) << "the ping on show has a ring";
  ASSERT_TRUE(overlays[0].circle_at);
  EXPECT_NEAR(overlays[0].circle_at->x, place_of(3, 8).x, 1e-9);
  ASSERT_TRUE(workspace().picture_file.set("chart.table", Choice{1}));
  show("time_utc", "depth_m");
  click(place_of(1, -1));
  EXPECT_EQ(workspace().school(), (SchoolName{0, 1}));
  EXPECT_EQ(document().ping(), 3) << "the middle one of a whole school";
}

TEST_F(Charts, BarsAreBrushedAsPointsAre) {
  show("n_voxels", "");
  const auto& bars = chart().sight()->places.bars;
  ASSERT_FALSE(bars.empty());
  std::set<SchoolName> all;
  for (const std::size_t row : bars.front().rows) all.insert(chart().sight()->name_of(row));
  const PixelRect bar = bars.front().place;
  click({bar.x + bar.width / 2.0, bar.y + bar.height / 2.0});
  if (all.size() > 1) {
    EXPECT_EQ(workspace().chosen_schools(), all);
  } else {
    EXPECT_EQ(workspace().school(), *all.begin());
  }
  EXPECT_THAT(chart().hint({bar.x + bar.width / 2.0, bar.y + bar.height / 2.0}), testing::HasSubstr("school ping"));
}

TEST_F(Charts, TellWhatAPointIs) {
  show("ping_index", "depth_m");
  const double depth = document().product(0)->school_pings.at(1).depth_m;
  EXPECT_EQ(chart().hint(place_of(1, 3)),
            fmt::format("obs-0001, school 1, ping 3\nping index: 3\ndepth: {:.4g} m", depth));
  EXPECT_EQ(chart().hint({1.0, 1.0}), "");
}

TEST_F(Charts, ZoomAboutThePointerPanAndShowAllAgain) {
  show("ping_index", "depth_m");
  const PixelPoint at = place_of(1, 3);
  chart().pointer({.action = PointerAction::wheel, .at = at, .wheel_steps = 2.0});
  settle();
  EXPECT_TRUE(chart().zoomed());
  EXPECT_NEAR(place_of(1, 3).x, at.x, 0.01);
  EXPECT_NEAR(place_of(1, 3).y, at.y, 0.01);
  chart().pointer({.action = PointerAction::press, .button = PointerButton::middle, .at = at});
  chart().pointer({.action = PointerAction::move, .button = PointerButton::middle, .at = {at.x + 9.0, at.y - 4.0}});
  chart().pointer({.action = PointerAction::release, .button = PointerButton::middle, .at = {at.x + 9.0, at.y - 4.0}});
  settle();
  EXPECT_NEAR(place_of(1, 3).x, at.x + 9.0, 0.01);
  EXPECT_NEAR(place_of(1, 3).y, at.y - 4.0, 0.01);
  chart().pointer({.action = PointerAction::double_press, .button = PointerButton::left, .at = at});
  settle();
  EXPECT_FALSE(chart().zoomed());
  EXPECT_NEAR(place_of(1, 3).x, at.x, 0.01);
  for (int i = 0; i < 3; ++i) chart().pointer({.action = PointerAction::wheel, .at = at, .wheel_steps = 1.0});
  settle();
  const PlotFrame& plot = chart().sight()->places.plot;
  const ChartPart& whole = chart().sight()->whole;
  EXPECT_NEAR((whole.x_high - whole.x_low) / (plot.x.last - plot.x.first), 1.25 * 1.25 * 1.25, 1e-9)
      << "notches that come faster than pictures all count";
  for (int i = 0; i < 4; ++i) chart().pointer({.action = PointerAction::wheel, .at = at, .wheel_steps = -1.0});
  settle();
  EXPECT_FALSE(chart().zoomed()) << "there is no more than everything";
  for (int i = 0; i < 300; ++i) chart().pointer({.action = PointerAction::wheel, .at = at, .wheel_steps = 3.0});
  settle();
  EXPECT_EQ(chart().problem(), "") << "however far";
}

TEST_F(Charts, SayWhatTheTableHasNot) {
  ASSERT_TRUE(workspace().picture_file.set("chart.table", Choice{1}));
  ASSERT_TRUE(workspace().picture_file.set("chart.x", std::string("ping_index")));
  settle();
  EXPECT_THAT(chart().problem(), testing::HasSubstr("schools has no column ping_index"));
  for (const PanelSection::Words& one : picture_words()) {
    EXPECT_THAT(one.words, testing::IsSupersetOf({"depth_m", "ping_index", "first_time_utc"})) << one.name;
    EXPECT_EQ(one.words.front().empty(), one.name == "chart.y") << "none: a histogram";
  }
}

TEST(ChartBeforeSchools, SaysThatThereAreNone) {
  ChangeQueue queue;
  AppModel app(queue, TestSurvey::options(TestSurvey::easy().fresh()));
  app.workspace.document.open({TestSurvey::easy().folder()});
  app.workspace.document.settle();
  EXPECT_THAT(idle_text(app, "chart"), testing::HasSubstr("as soon as schools are measured"));
}

}  // namespace
}  // namespace sonar
