// SPDX-License-Identifier: Apache-2.0
#include "view/charts/frequency_chart.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace sonar {
namespace {

constexpr PixelSize kSize{800, 500};

FrequencyChartData by_hand() {
  FrequencySeries water{"water round school 1", {120, 120, 120, 255}, true, {}};
  FrequencySeries school{"school 1", {0, 108, 192, 255}, false, {}};
  for (int fan = 0; fan < 5; ++fan) {
    const double khz = 75.0 + 5.0 * fan;
    school.points.push_back({fan, khz, -40.0 - fan, -42.0 - fan, -38.0 - fan, 9, 100 + fan, 12.5});
    water.points.push_back({fan, khz, fan == 2 ? std::numeric_limits<double>::quiet_NaN() : -70.0});
  }
  return {"obs-0001: schools over frequency", "9 pings", {water, school}};
}

TEST(FrequencyChart, PutsEachFanAtItsFrequencyAndItsSv) {
  const FrequencyChartData data = by_hand();
  const auto chart = frequency_chart(data, kSize, light_theme(kSize));
  ASSERT_TRUE(chart) << to_line(chart.error());
  ASSERT_EQ(chart->places.size(), 9U) << "one fan of the water is not above the background";
  for (const PanelChart::Place& place : chart->places) {
    const FrequencyPoint& point = data.series[place.curve].points[place.point];
    EXPECT_NEAR(chart->plots.front().x_at(place.at.x), point.frequency_khz, 1e-9);
    EXPECT_NEAR(chart->plots.front().y_at(place.at.y), point.sv_db, 1e-9);
    EXPECT_TRUE(inside(chart->plots.front().place, place.at));
    EXPECT_EQ(chart->at({place.at.x + 2.0, place.at.y}, 8.0), &place);
  }
  EXPECT_EQ(chart->at({1.0, 1.0}, 8.0), nullptr);
  EXPECT_GT(chart->plots.front().y.first, chart->plots.front().y.last) << "loud is above";
  EXPECT_LE(chart->plots.front().y.last, -70.0);
  EXPECT_GE(chart->plots.front().y.first, -38.0) << "quartiles are in sight";
}

TEST(FrequencyChart, SaysWhatKeepsItFromBeingTheFishAlone) {
  const auto chart = frequency_chart(by_hand(), kSize, light_theme(kSize));
  ASSERT_TRUE(chart);
  const auto said = [&](const std::string& words) {
    return std::any_of(chart->frame.items.begin(), chart->frame.items.end(), [&](const auto& item) {
      const auto* text = std::get_if<TextItem>(&item);
      return text != nullptr && text->text.find(words) != std::string::npos;
    });
  };
  EXPECT_TRUE(said("Fans differ in tilt"));
  EXPECT_TRUE(said("frequency (kHz)"));
  EXPECT_TRUE(said("water round school 1"));
  EXPECT_TRUE(said("9 pings"));
}

/// As a dock of a few hundred pixels has it: in more lines, and whole.
TEST(FrequencyChart, ANarrowOneTellsAllThatAWideOneDoes) {
  const auto words = [](PixelSize size) {
    const auto chart = frequency_chart(by_hand(), size, light_theme(size));
    EXPECT_TRUE(chart);
    std::string all;
    double lowest = 0.0;
    for (const auto& item : chart->frame.items) {
      const auto* text = std::get_if<TextItem>(&item);
      if (text == nullptr) continue;
      all += text->text + " ";
      lowest = std::max(lowest, text->at.y);
    }
    EXPECT_LT(lowest, size.height);
    return all;
  };
  const std::string wide = words({1600, 900});
  const std::string narrow = words({330, 360});
  EXPECT_EQ(narrow.find("\u2026"), std::string::npos) << narrow;
  for (const char* told : {"mean Sv of each fan over its frequency, 9 pings", "Fans differ in tilt"}) {
    EXPECT_NE(wide.find(told), std::string::npos) << told;
    EXPECT_NE(narrow.find(told), std::string::npos) << narrow;
  }
}

TEST(FrequencyChart, TellsWhatAPointRestsOn) {
  const FrequencyChartData data = by_hand();
  EXPECT_EQ(frequency_point_text(data.series[1], data.series[1].points[1]),
            "school 1\nfan 1, 80.0 kHz: -41.0 dB re 1 m\u207B\u00B9\nhalf of the pings: -43.0 to -39.0 dB\n"
            "9 pings, 101 samples, 12.5 m\u00B3");
}

TEST(FrequencyChart, IsRefusedWhereNothingIsKnownOrThereIsNoRoom) {
  FrequencyChartData data = by_hand();
  EXPECT_FALSE(frequency_chart(data, {60, 40}, light_theme(kSize)));
  for (FrequencySeries& series : data.series) {
    for (FrequencyPoint& point : series.points) point.sv_db = std::nan("");
  }
  const auto none = frequency_chart(data, kSize, light_theme(kSize));
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::not_found);
}

}  // namespace
}  // namespace sonar
