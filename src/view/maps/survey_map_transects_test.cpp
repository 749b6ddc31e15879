// SPDX-License-Identifier: Apache-2.0
#include "view/maps/survey_map_transects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "view/maps/map_example.h"

namespace sonar {
namespace {

constexpr PixelSize kSize{1000, 760};

bool says(const FrameDescription& frame, const std::string& words) {
  return std::any_of(frame.items.begin(), frame.items.end(), [&](const auto& item) {
    const auto* text = std::get_if<TextItem>(&item);
    return text != nullptr && text->text.find(words) != std::string::npos;
  });
}

/// Broad lines of a map, each with the pixels of its ends.
struct BroadLine {
  Rgba8 colour;
  PixelPoint first;
  PixelPoint last;
};
std::vector<BroadLine> broad_lines(const FrameDescription& frame, const Theme& theme) {
  std::vector<BroadLine> lines;
  for (const auto& item : frame.items) {
    const auto* path = std::get_if<PathItem>(&item);
    if (path == nullptr || path->parts.size() != 1 || path->stroke.width_px < 5.0 * theme.line_px) continue;
    const auto& points = path->parts[0].points;
    if (path->parts[0].closed || points.size() < 2) continue;
    lines.push_back({path->stroke.colour, points.front(), points.back()});
  }
  return lines;
}

TEST(SurveyMapTransects, LieAlongTheTrackFromTheirFirstPingToTheirLast) {
  const std::vector<ObservationProduct> all{map_example::product("obs-0001", 60),
                                            map_example::product("obs-0002", 60, destination({60.0, 5.0}, 1500.0, 90.0),
                                                                 180.0, map_example::kStart + 3600 * kSecondNs)};
  const Theme theme = light_theme(kSize);
  const auto time = [&](std::size_t observation, std::size_t ping) { return all[observation].pings[ping].time; };
  SurveyMapStyle style;
  style.transects = {{"T1", "north", EffortType::transect, time(0, 10), time(0, 50)},
                     {"", "", EffortType::off, time(0, 20), time(0, 25)},
                     {"T2", "south", EffortType::transect, time(1, 5), time(1, 40)},
                     {"T9", "south", EffortType::transect, time(1, 59) + 1, time(1, 59) + 2}};
  EXPECT_TRUE(broad_lines(*survey_map(all, {}, nullptr, {}, kSize, theme), theme).empty());
  const auto frame = survey_map(all, {}, nullptr, style, kSize, theme);
  ASSERT_TRUE(frame) << to_line(frame.error());
  const auto lines = broad_lines(*frame, theme);
  ASSERT_EQ(lines.size(), 3U);
  const auto chart = survey_chart(all, {}, style, kSize, theme);
  ASSERT_TRUE(chart);
  const auto lies = [&](const PixelPoint& at, std::size_t observation, std::size_t ping) {
    const PixelPoint there = chart->at(all[observation].pings[ping].transducer).value();
    EXPECT_LT(std::hypot(at.x - there.x, at.y - there.y), 2.0) << observation << ' ' << ping;
  };
  lies(lines[0].first, 0, 10);
  lies(lines[0].last, 0, 50);
  lies(lines[1].first, 1, 5);
  lies(lines[1].last, 1, 40);
  lies(lines[2].first, 0, 20);  // over the transect
  lies(lines[2].last, 0, 25);
  EXPECT_NE(lines[0].colour, lines[1].colour);
  EXPECT_TRUE(says(*frame, "T1"));
  EXPECT_TRUE(says(*frame, "T2"));
  EXPECT_FALSE(says(*frame, "T9"));
  EXPECT_TRUE(says(*frame, "off effort"));
}

}  // namespace
}  // namespace sonar
