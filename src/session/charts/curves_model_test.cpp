// SPDX-License-Identifier: Apache-2.0
#include "session/charts/curves_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "session/test_app.h"
#include "session/tools/growth.h"

namespace sonar {
namespace {

using testing::HasSubstr;

class CurvesOfSchools : public testing::Test, protected TestApp {
 protected:
  void SetUp() override {
    begin();
    chart().resize({900, 450}, 1.0);
    chart().set_seen(true);
    settle();
  }
  CurvesModel& chart() { return dynamic_cast<CurvesModel&>(*app_->picture("curves")); }
  void settle() {
    do {
      document().settle();
      chart().wait();
    } while (queue_.drain() > 0);
  }
  void ask(SchoolCurve curve) {
    ASSERT_TRUE(workspace().picture_file.set("curves.curve", Choice{static_cast<std::size_t>(curve)}));
    settle();
  }
  void look(std::int64_t ping) {
    document().look_at(ping);
    settle();
  }
  const PanelChartData& data() { return chart().sight()->data; }
  const ChartCurve& curve(std::size_t panel, std::size_t which) { return data().panels.at(panel).curves.at(which); }
};

// Bins of 1 dB: what they hold is the whole, of the school as of the water.
TEST_F(CurvesOfSchools, ShareTheVolumeOutOverSv) {
  EXPECT_THAT(idle_text(*app_, "curves"), HasSubstr("Select a school"));
  (void)longest_found();
  EXPECT_FALSE(chart().sight());
  select(document().state().schools.front()->number);
  settle();
  ASSERT_TRUE(chart().sight()) << chart().problem();
  ASSERT_EQ(data().panels.size(), 1U);
  ASSERT_EQ(data().panels[0].curves.size(), 2U) << "the water and the school";
  std::array<double, 2> mean_sv{};
  for (std::size_t i = 0; i < 2; ++i) {
    const std::vector<CurvePoint>& steps = curve(0, i).points;
    double whole = 0.0;
    for (std::size_t p = 1; p + 1 < steps.size(); p += 2) {
      whole += steps[p].y * (steps[p + 1].x - steps[p].x);
      mean_sv[i] += steps[p].y / 100.0 * std::pow(10.0, 0.1 * (steps[p].x + 0.5));
    }
    EXPECT_NEAR(whole, 100.0, 1e-6) << curve(0, i).name;
  }
  EXPECT_GT(mean_sv[1], 4.0 * mean_sv[0]) << "a clean school stands 6 dB above the water round it";
  press("school.delete");
  settle();
  EXPECT_FALSE(chart().sight()) << "what is not there has no curves";
}

// Grown again by the same clicks and the same tolerance, a school is what it is.
TEST_F(CurvesOfSchools, GrowFromTheClicksThatMadeThemElseFromTheStrongestVoxel) {
  const SchoolMasks found = longest_found();
  const auto& there = found.pings[found.pings.size() / 2];
  const auto staged = document().shown()->ping(there.ping_index);
  ASSERT_TRUE(staged);
  const auto seed = best_seed(there.mask, *(*staged)->filtered, document().shown()->grid());
  ASSERT_TRUE(seed);
  document().act(there.ping_index, DeleteCommand{key_of(found, document().shown()->context())});
  GrowCommand command;
  command.grow.tolerance_db = 7.0;
  command.seeds = {*seed};
  document().act(there.ping_index, command);
  document().settle();
  const auto made = document().state().schools.back();
  ASSERT_TRUE(made->grown);
  select(made->number);
  look(there.ping_index);
  ask(SchoolCurve::tolerance);
  ASSERT_TRUE(chart().sight()) << chart().problem();
  EXPECT_THAT(data().below, HasSubstr("clicks"));
  ASSERT_EQ(data().panels.size(), 3U);
  for (const std::size_t panel : {0U, 1U}) {
    EXPECT_NEAR(curve(panel, 1).points.front().y, 0.0, 1e-9) << data().panels[panel].y_label;
    EXPECT_NEAR(curve(panel, 0).points[12].y, 0.0, 1e-9);
  }
  for (std::size_t i = 1; i < curve(0, 0).points.size(); ++i) {
    EXPECT_GE(curve(0, 0).points[i].y, curve(0, 0).points[i - 1].y) << "more tolerance, no less volume";
  }
  EXPECT_THAT(chart().hint(chart().sight()->chart.places.front().at), HasSubstr("tolerance"));
  // One beam more by hand: what clicks made is no more what there is.
  BrushCommand stroke;
  stroke.runs.push_back({seed->channel, seed->sample, 1});
  stroke.runs.push_back({channel(0, 0), 200, 4});
  stroke.school =
      SchoolKey{document().survey()->ping_time(document().shown()->files(), static_cast<std::size_t>(there.ping_index)),
                seed->channel, seed->sample};
  document().act(there.ping_index, std::move(stroke));
  settle();
  ASSERT_TRUE(chart().sight()) << chart().problem();
  EXPECT_THAT(data().below, HasSubstr("strongest voxel"));
}

TEST_F(CurvesOfSchools, SayWhyASchoolCannotBeGrownAgain) {
  paint(3, 4, 4, 4, 200);
  document().settle();
  select(document().state().schools.back()->number);
  look(3);
  ask(SchoolCurve::tolerance);
  EXPECT_THAT(chart().problem(), HasSubstr("no threshold is known"));
  look(8);
  EXPECT_THAT(chart().problem(), HasSubstr("not in ping 8"));
  ask(SchoolCurve::distribution);
  EXPECT_TRUE(chart().sight()) << chart().problem();
  EXPECT_EQ(chart().problem(), "") << "over all of its pings it has a distribution";
}

TEST_F(CurvesOfSchools, OfTheWholeSurveyNeedNoSchoolThatIsSelected) {
  (void)longest_found();
  ask(SchoolCurve::avoidance);
  ASSERT_TRUE(chart().sight()) << chart().problem();
  EXPECT_EQ(data().panels.size(), 12U) << "three ways of being against the ship, four figures";
  ASSERT_TRUE(workspace().picture_file.set("curves.over", Choice{static_cast<std::size_t>(AgainstShip::range)}));
  settle();
  ASSERT_EQ(data().panels.size(), 4U);
  bool known = false;
  for (const CurvePoint& point : data().panels[2].curves.front().points) known = known || std::isfinite(point.y);
  EXPECT_TRUE(known) << "every school has a depth";
}

}  // namespace
}  // namespace sonar
