// SPDX-License-Identifier: Apache-2.0
// The chart by mouse: brushing, going to a ping, its columns in the controls.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QComboBox>
#include <QTreeView>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "session/charts/chart_model.h"
#include "session/slices/school_layers.h"
#include "window_at_work.h"

namespace sonar {
namespace {

class Charts : public WindowAtWork {
 protected:
  ChartModel& chart() { return dynamic_cast<ChartModel&>(*app_->picture("chart")); }
  /// In the window's units.
  PixelPoint place_of(std::size_t row) { return chart().sight()->places.points.at(row); }
  QComboBox& column(const char* name) { return *window_->findChild<QComboBox*>(name); }
  void show_schools() {
    key(Qt::Key_D, Qt::ControlModifier);
    raise("chart");
    ASSERT_TRUE(chart().sight());
    ASSERT_GT(chart().sight()->data.rows.size(), 3U);
  }
};

TEST_F(Charts, ADragSelectsTheSchoolsOfItsPointsInTheTableAndAClickGoesToAPing) {
  show_schools();
  const PixelRect plot = chart().sight()->places.plot.place;
  std::set<SchoolName> all;
  for (std::size_t row = 0; row < chart().sight()->data.rows.size(); ++row) all.insert(chart().sight()->name_of(row));
  ASSERT_GT(all.size(), 1U);
  drag("chart", {plot.x + 1.0, plot.y + 1.0}, {plot.x + plot.width - 1.0, plot.y + plot.height - 1.0});
  EXPECT_EQ(workspace().chosen_schools(), all);
  const auto& rows = *view("schools")->findChild<QTreeView*>("rows");
  EXPECT_EQ(static_cast<std::size_t>(rows.selectionModel()->selectedRows().size()), all.size());
  keep_picture("chart-brushed");
  const std::size_t row = chart().sight()->data.rows.size() / 2;
  const SchoolName name = chart().sight()->name_of(row);
  const std::int64_t ping = chart().sight()->data.rows[row].ping_index;
  click("chart", place_of(row));
  EXPECT_EQ(workspace().school(), name);
  EXPECT_EQ(document().staged()->ping_index, ping);
  key(Qt::Key_Escape);
  EXPECT_FALSE(workspace().school());
}

TEST_F(Charts, ADragOverSomePointsSelectsTheirSchoolsAlone) {
  show_schools();
  std::map<SchoolName, double> begins;
  for (std::size_t row = 0; row < chart().sight()->data.rows.size(); ++row) {
    const auto first = begins.emplace(chart().sight()->name_of(row), place_of(row).x).first;
    first->second = std::min(first->second, place_of(row).x);
  }
  double last = 0.0;
  for (const auto& [name, x] : begins) last = std::max(last, x);
  const double end = std::floor(last) - 2.0;  // a pointer is at whole pixels
  std::set<SchoolName> before;
  for (const auto& [name, x] : begins) {
    if (x <= end) before.insert(name);
  }
  ASSERT_FALSE(before.empty());
  ASSERT_LT(before.size(), begins.size());
  const PixelRect plot = chart().sight()->places.plot.place;
  drag("chart", {plot.x + 1.0, plot.y + 1.0}, {end, plot.y + plot.height - 1.0});
  EXPECT_EQ(workspace().chosen_schools(), before);
  std::size_t rings = 0;
  raise("survey_map");
  for (const Overlay& one : app_->picture("survey_map")->overlays())
    if (one.circle_at) ++rings;
  EXPECT_EQ(rings, before.size()) << "the map marks them all";
  const SchoolName& shown = *before.begin();
  const auto& schools = document().state(shown.observation).schools;
  const auto school = std::ranges::find_if(schools, [&](const auto& one) { return one->number == shown.number; });
  ASSERT_NE(school, schools.end());
  ASSERT_TRUE(document().show(shown.observation, (*school)->masks.pings.front().ping_index));
  settle();
  const auto layers = school_layers(workspace(), document().ping(), light_theme({800, 600}));
  ASSERT_FALSE(layers.empty());
  for (const SchoolLayer& layer : layers) {
    EXPECT_EQ(layer.selected, before.contains({document().shown()->index(), layer.number})) << layer.title;
  }
}

TEST_F(Charts, ItsColumnsAreChosenInTheControls) {
  show_schools();
  QComboBox& y = column("chart.y");
  ASSERT_GE(y.findData("depth_m"), 0);
  y.setCurrentIndex(y.findData("depth_m"));
  settle();
  EXPECT_EQ(workspace().picture_file.values().kind.chart.y, "depth_m");
  ASSERT_TRUE(chart().sight()->data.y);
  EXPECT_EQ(chart().sight()->data.y->name, "depth_m");
  y.setCurrentIndex(y.findData(""));
  settle();
  EXPECT_FALSE(chart().sight()->places.bars.empty()) << "a histogram";
  keep_picture("chart-histogram");
  workspace().dark.set(true);
  settle();
  keep_picture("chart-dark");
  workspace().dark.set(false);
  settle();
}

}  // namespace
}  // namespace sonar
