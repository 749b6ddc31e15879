// SPDX-License-Identifier: Apache-2.0
#include "publish/curves_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <string>
#include <vector>

namespace sonar {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Its volume doubles with each dB, its backscatter rises by a tenth, and its mask has the volume that 1 dB more gives.
SchoolCurves school(std::string name, bool from_clicks) {
  SchoolCurves out{std::move(name), {0, 108, 192, 255}};
  for (const double change : {-1.0, 0.0, 1.0}) {
    GrownSize size{change, 10.0 + change, {}};
    size.echo.volume_m3 = 100.0 * std::pow(2.0, change);
    size.echo.backscatter_m2 = 0.5 * std::pow(1.1, change);
    size.echo.sv_mean_db = -40.0 - change;
    out.sizes.push_back(size);
  }
  out.stored = out.sizes.back().echo;
  out.from_clicks = from_clicks;
  return out;
}

PanelChartData tolerance(const std::vector<SchoolCurves>& schools) {
  return tolerance_chart(schools, "obs-0001: schools over the tolerance", "ping 5", light_theme({1200, 500}));
}

TEST(ToleranceChart, ShowsTheSchoolAsItIsStoredBesideWhatGrowsAgain) {
  const PanelChartData data = tolerance({school("school 1", false)});
  ASSERT_EQ(data.panels.size(), 3U);
  // Twice the volume is 3.01 dB, 1.1 times the backscatter 0.414 dB; Sv is that of the mask.
  const std::vector<double> levels{3.0103, 0.41393, -41.0};
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(data.panels[i].curves.size(), 2U);
    const ChartCurve& stored = data.panels[i].curves.back();
    EXPECT_EQ(stored.name, "school 1 as it is stored");
    EXPECT_TRUE(stored.muted && !stored.dots);
    ASSERT_EQ(stored.points.size(), 2U);
    EXPECT_EQ(stored.points.front().x, -1.0);
    EXPECT_EQ(stored.points.back().x, 1.0);
    for (const CurvePoint& point : stored.points) EXPECT_NEAR(point.y, levels[i], 1e-4) << data.panels[i].y_label;
    EXPECT_NEAR(data.panels[i].curves.front().points[1].y, i == 2 ? -40.0 : 0.0, 1e-12) << "of the tolerance used";
  }
}

TEST(ToleranceChart, SaysWhatItGrewFrom) {
  EXPECT_THAT(tolerance({school("school 1", false)}).below, HasSubstr("from its strongest voxel, ping 5"));
  EXPECT_THAT(tolerance({school("school 1", false)}).below, Not(HasSubstr("clicks")));
  EXPECT_THAT(tolerance({school("school 1", true)}).below, HasSubstr("from the clicks that made it, ping 5"));
  const std::string both = tolerance({school("school 1", true), school("school 2", false)}).below;
  EXPECT_THAT(both, testing::AllOf(HasSubstr("clicks"), HasSubstr("strongest voxel")));
  const std::vector<SchoolCurves> painted{{"school 3", {}}, {"school 4", {}}};
  EXPECT_FALSE(any_grew(painted));
  EXPECT_THAT(why_none_grew(painted, 7), HasSubstr("school 3, school 4 cannot be grown again in ping 7: no threshold"));
}

// Each panel has axes of its own: a point that is drawn lies where these have it, and in no other panel.
TEST(PanelCharts, StandSideBySideEachWithItsOwnAxes) {
  const PanelChartData data = tolerance({school("school 1", false), school("school 2", true)});
  const PixelSize size{1200, 500};
  const auto chart = panel_chart(data, size, light_theme(size));
  ASSERT_TRUE(chart) << to_line(chart.error());
  ASSERT_EQ(chart->plots.size(), 3U);
  for (std::size_t i = 0; i + 1 < 3; ++i) {
    const PixelRect& left = chart->plots[i].place;
    EXPECT_LT(left.x + left.width, chart->plots[i + 1].place.x);
    EXPECT_EQ(left.y, chart->plots[i + 1].place.y);
  }
  EXPECT_EQ(chart->places.size(), 3U * 2U * 3U) << "panels, schools, tolerances; levels have no points";
  for (const PanelChart::Place& place : chart->places) {
    const CurvePoint& point = data.panels[place.panel].curves[place.curve].points[place.point];
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(inside(chart->plots[i].place, place.at), i == place.panel);
    EXPECT_NEAR(chart->plots[place.panel].x_at(place.at.x), point.x, 1e-9);
    EXPECT_NEAR(chart->plots[place.panel].y_at(place.at.y), point.y, 1e-9);
  }
}

TEST(PanelCharts, WithoutRoomForAllTheRestIsSaidToBeLeftOut) {
  const PanelChartData data = tolerance({school("school 1", false)});
  const PixelSize size{320, 200};
  const auto chart = panel_chart(data, size, light_theme({1200, 500}));  // the text of a larger picture
  ASSERT_TRUE(chart) << to_line(chart.error());
  ASSERT_LT(chart->plots.size(), 3U);
  for (const PanelChart::Place& place : chart->places) EXPECT_LT(place.panel, chart->plots.size());
}

// 61 m are 200 ft; 0.514 m/s are 1 kn; Sv stays.
TEST(AvoidanceChart, IsReadInTheUnitsThatAreChosen) {
  AvoidanceRow row;
  row.against = "range_m";
  row.from = 30.48;
  row.to = 91.44;
  row.depth_p50_m = 30.48;
  row.speed_smoothed_p50_mps = 1852.0 / 3600.0;
  row.sv_mean_p50_db = -40.0;
  Theme theme = light_theme({1200, 500});
  const PanelChartData si = avoidance_chart(std::span(&row, 1), AgainstShip::range, "all", theme);
  theme.units = {LengthUnit::feet, SpeedUnit::knots};
  const PanelChartData read = avoidance_chart(std::span(&row, 1), AgainstShip::range, "all", theme);
  ASSERT_EQ(read.panels.size(), 4U);
  EXPECT_EQ(si.panels[0].x_label, "range from the ship (m)");
  EXPECT_EQ(si.panels[0].y_label, "speed (m/s)");
  EXPECT_EQ(si.panels[3].y_label, "Sv (dB re 1 m\u207B\u00B9)");
  EXPECT_EQ(si.panels[2].curves[0].points[0].y, 30.48);
  EXPECT_EQ(read.panels[0].x_label, "range from the ship (ft)");
  EXPECT_EQ(read.panels[0].y_label, "speed (kn)");
  EXPECT_EQ(read.panels[2].y_label, "depth (ft)");
  EXPECT_NEAR(read.panels[0].curves[0].points[0].x, 200.0, 1e-9);
  EXPECT_NEAR(read.panels[0].curves[0].points[0].y, 1.0, 1e-12);
  EXPECT_NEAR(read.panels[2].curves[0].points[0].y, 100.0, 1e-9);
  EXPECT_EQ(read.panels[3].curves[0].points[0].y, -40.0);
}

}  // namespace
}  // namespace sonar
