// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "view/charts/leg_chart.h"
#include "view/charts/sphere_chart.h"
#include "view/slices/slice_steps.h"

namespace sonar {
namespace {

using testing::HasSubstr;

constexpr PixelSize kSize{1200, 800};

/// Two fans of three beams; of the second fan two were crossed: +1 dB and -0.5 dB.
SphereChartData by_hand() {
  SphereChartData data{"obs-0001", "by hand", 2, 3, {}, {{4, 2.0, 0.3}, {5, 1.0, -0.2}}};
  for (int row = 0; row < 6; ++row) {
    SphereChartBeam beam;
    beam.channel = 10 + row;
    beam.fan = row / 3;
    beam.beam = row % 3;
    if (row >= 4) beam.state = SphereChartBeam::State::crossed;
    beam.figures[0] = {20.0, row == 4 ? 21.0 : 19.5, 0.04};
    data.beams.push_back(beam);
  }
  return data;
}

bool says(const FrameDescription& frame, const std::string& words) {
  return std::any_of(frame.items.begin(), frame.items.end(), [&](const auto& item) {
    const auto* text = std::get_if<TextItem>(&item);
    return text != nullptr && text->text.find(words) != std::string::npos;
  });
}

const Image& map_of(const SphereChart& chart) {
  const auto at = std::find_if(chart.frame.items.begin(), chart.frame.items.end(),
                               [](const auto& item) { return std::holds_alternative<ImageItem>(item); });
  return *std::get<ImageItem>(*at).image;
}

TEST(SphereChart, ColoursBeamsByTheirChangeAndLeavesTheOthersGrey) {
  const SphereChartData data = by_hand();
  const Theme theme = light_theme(kSize);
  const auto chart = sphere_chart(data, {}, kSize, theme);
  ASSERT_TRUE(chart) << chart.error().text;
  const Image& map = map_of(*chart);
  ASSERT_EQ(map.size, (PixelSize{3, 2}));
  EXPECT_EQ(map.at(0, 0), theme.no_data);
  // 1 dB is the largest change: the scale's upper end; -0.5 dB lies a quarter up it.
  EXPECT_EQ(map.at(1, 1), difference_colours(theme).at(1.0));
  EXPECT_EQ(map.at(2, 1), difference_colours(theme).at(0.25));
  EXPECT_TRUE(says(chart->frame, "2 of 6 beams crossed"));
  EXPECT_EQ(chart->crossed, (std::vector<std::size_t>{4, 5}));
  EXPECT_EQ(chart->beam_at(data, chart->map.at(1.2, 0.9)), 4U);
  EXPECT_EQ(chart->beam_at(data, chart->figures.at(1.1, 20.0)), 5U);
  EXPECT_FALSE(chart->beam_at(data, {1.0, 1.0}));
}

TEST(SphereChart, SaysWhatItCannotShow) {
  SphereChartData none = by_hand();
  for (SphereChartBeam& beam : none.beams) beam.state = SphereChartBeam::State::left;
  EXPECT_EQ(sphere_chart(none, {}, kSize, light_theme(kSize)).error().code, ErrorCode::not_found);
  EXPECT_EQ(sphere_chart(by_hand(), {}, {200, 100}, light_theme(kSize)).error().code, ErrorCode::bad_parameter);
  EXPECT_THAT(sphere_beam_text(by_hand().beams[4]), HasSubstr("gain: 20.00 -> 21.00 \u00B1 0.04 dB"));
  EXPECT_THAT(sphere_beam_text(by_hand().beams[0]), HasSubstr("stays as it was"));
}

TEST(LegChart, KeepsZeroAndEveryBarInSightAndFindsLegs) {
  const LegChartData data{"Setup check",
                          {{"2020-01-01 08:00:00", 45.0, 5.0, 12, 0.1, 0.02, -0.6, 0.1},
                           {"2020-01-01 09:00:00", 135.0, 5.0, 9, 0.2, 0.03, -0.5, 0.1}},
                          {"Mounting angle 270.00 -> 263.00"}};
  const auto chart = leg_chart(data, kSize, light_theme(kSize));
  ASSERT_TRUE(chart) << chart.error().text;
  EXPECT_LE(chart->plot.y.last, -0.7) << "upwards";
  EXPECT_GE(chart->plot.y.first, 0.23);
  EXPECT_EQ(chart->leg_at(data, chart->plot.at(1.9, 0.0)), 1U);
  EXPECT_FALSE(chart->leg_at(data, {0.0, 0.0}));
  EXPECT_TRUE(says(chart->frame, "course 045"));
  EXPECT_TRUE(says(chart->frame, "263.00"));
  EXPECT_THAT(leg_text(data.legs[0]), HasSubstr("to starboard -0.600"));
  EXPECT_EQ(leg_chart({}, kSize, light_theme(kSize)).error().code, ErrorCode::not_found);
}

}  // namespace
}  // namespace sonar
