// SPDX-License-Identifier: Apache-2.0
#include "view/charts/effort_charts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "view/charts/cause_chart.h"

namespace sonar {
namespace {

constexpr PixelSize kSize{800, 500};

EffortRow unit(const std::string& transect, std::int64_t edsu, double distance_nmi, double nasc, double se) {
  EffortRow row;
  row.transect = transect;
  row.type = edsu == 0 ? "off" : "transect";
  row.edsu = edsu;
  row.distance_nmi = distance_nmi;
  row.nasc_m2_nmi2 = nasc;
  row.nasc_se_m2_nmi2 = se;
  row.nasc_school_m2_nmi2 = 0.5 * nasc;
  return row;
}

/// Two units of a transect, a break, one unit of another.
std::vector<EffortRow> effort_by_hand() {
  return {unit("T1", 1, 1.0, 100.0, 10.0), unit("T1", 2, 0.5, 300.0, kUnknown), unit("", 0, 3.0, kUnknown, kUnknown),
          unit("T2", 1, 1.0, 50.0, 5.0)};
}

NascRow cell(const std::string& transect, std::int64_t edsu, double range_m, double depth_m, double sv_db,
             double volume_m3) {
  NascRow row;
  row.transect = transect;
  row.edsu = edsu;
  row.range_from_m = range_m;
  row.range_to_m = range_m + 50.0;
  row.depth_from_m = depth_m;
  row.depth_to_m = depth_m + 10.0;
  row.sv_mean_db = sv_db;
  row.volume_m3 = volume_m3;
  return row;
}

TEST(EffortCharts, PutUnitsOneBehindTheOtherWithoutWhatIsOffEffort) {
  const auto places = effort_places(effort_by_hand());
  ASSERT_EQ(places.size(), 3U);
  EXPECT_EQ(places[2].row, 3U);
  EXPECT_DOUBLE_EQ(places[2].from_nmi, 1.5);
  EXPECT_DOUBLE_EQ(places[2].to_nmi, 2.5);
}

TEST(NascChart, KeepsTheBandInSightAndKnowsWhichUnitIsWhere) {
  const auto effort = effort_by_hand();
  const auto chart = nasc_chart(effort, kSize, light_theme(kSize));
  ASSERT_TRUE(chart) << to_line(chart.error());
  EXPECT_GE(chart->plot.y.first, 300.0);
  EXPECT_EQ(chart->plot.y.last, 0.0);
  const auto at = chart->at(chart->plot.at(1.75, 20.0));
  ASSERT_TRUE(at);
  EXPECT_EQ(at->row, 3U);
  EXPECT_NEAR(at->share, 0.25, 1e-9);
  EXPECT_FALSE(chart->at({1.0, 1.0}));
  // 100 +/- 1.96 * 10: the band's own corners are drawn.
  const PixelPoint high = chart->plot.at(1.0, 100.0 + 19.59964);
  EXPECT_TRUE(std::any_of(chart->frame.items.begin(), chart->frame.items.end(), [&](const auto& item) {
    const auto* path = std::get_if<PathItem>(&item);
    return path != nullptr && path->fill.a > 0 && !path->parts.empty() &&
           std::any_of(path->parts[0].points.begin(), path->parts[0].points.end(),
                       [&](PixelPoint p) { return std::hypot(p.x - high.x, p.y - high.y) < 1e-6; });
  }));
  EXPECT_FALSE(nasc_chart({}, kSize, light_theme(kSize)));
  EXPECT_FALSE(nasc_chart(effort, {60, 40}, light_theme(kSize)));
}

// -50 dB in 3 m3 and -60 dB in 1 m3: (3e-5 + 1e-6) / 4 = 7.75e-6, -51.107 dB.
TEST(SvSection, IsTheLinearMeanOfRangeBinsWeightedByVolume) {
  const auto effort = effort_by_hand();
  const std::vector<NascRow> nasc{cell("T1", 2, 0.0, 20.0, -50.0, 3.0), cell("T1", 2, 50.0, 20.0, -60.0, 1.0),
                                  cell("T2", 1, 0.0, 30.0, -55.0, 1.0), cell("T2", 1, 0.0, 40.0, kUnknown, 0.0)};
  const SvColours colours = sv_colours(SvScale{});
  const auto all = sv_section(effort, nasc, {}, colours, kSize, light_theme(kSize));
  ASSERT_TRUE(all) << to_line(all.error());
  EXPECT_EQ(all->cells.size(), 2U);
  EXPECT_EQ(all->plot.y.first, 20.0);
  EXPECT_EQ(all->plot.y.last, 40.0);
  const auto* mean = all->cell(all->plot.at(1.25, 25.0));
  ASSERT_NE(mean, nullptr);
  EXPECT_NEAR(mean->sv_db, 10.0 * std::log10(7.75e-6), 1e-9);
  EXPECT_EQ(all->places[mean->place_of].row, 1U);
  EXPECT_EQ(all->cell(all->plot.at(0.5, 25.0)), nullptr) << "nothing is known there";
  const auto one = sv_section(effort, nasc, 50.0, colours, kSize, light_theme(kSize));
  ASSERT_TRUE(one);
  ASSERT_EQ(one->cells.size(), 1U);
  EXPECT_NEAR(one->cells[0].sv_db, -60.0, 1e-9);
  EXPECT_FALSE(sv_section(effort, {}, {}, colours, kSize, light_theme(kSize)));
}

TEST(CauseChart, HasABarForEachKnownCauseAndSaysWhatIsNotKnown) {
  const std::vector<CauseBar> bars{{"fading", -0.4, 0.4, {}},
                                   {"lengths", std::nan(""), std::nan(""), {}},
                                   {"relations", -3.0, 4.0, {{"a", -3.0}, {"b", 4.0}}}};
  const auto frame = cause_chart("Band", bars, kSize, light_theme(kSize));
  ASSERT_TRUE(frame) << to_line(frame.error());
  const auto said = [&](const std::string& words) {
    return std::count_if(frame->items.begin(), frame->items.end(), [&](const auto& item) {
      const auto* text = std::get_if<TextItem>(&item);
      return text != nullptr && text->text.find(words) != std::string::npos;
    });
  };
  EXPECT_EQ(said("not known"), 1);
  EXPECT_EQ(said("-3.0 to +4.0 dB"), 1);
  EXPECT_FALSE(cause_chart("Band", {{"lengths", std::nan(""), std::nan(""), {}}}, kSize, light_theme(kSize)));
}

}  // namespace
}  // namespace sonar
