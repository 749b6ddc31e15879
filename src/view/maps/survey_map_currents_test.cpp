// SPDX-License-Identifier: Apache-2.0
#include "view/maps/survey_map_currents.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
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

/// Shafts of arrows: paths of an open line of two points and an open head of three.
std::vector<std::pair<PixelPoint, PixelPoint>> arrows(const FrameDescription& frame) {
  std::vector<std::pair<PixelPoint, PixelPoint>> out;
  for (const auto& item : frame.items) {
    const auto* path = std::get_if<PathItem>(&item);
    if (path == nullptr || path->parts.size() != 2 || path->parts[0].closed || path->parts[0].points.size() != 2)
      continue;
    if (path->parts[1].points.size() == 3) out.emplace_back(path->parts[0].points[0], path->parts[0].points[1]);
  }
  return out;
}

class SurveyMapCurrents : public testing::Test {
 protected:
  [[nodiscard]] FrameDescription map_with(CurrentProfiles profiles) const {
    SurveyMapStyle style;
    style.currents = std::make_shared<const CurrentProfiles>(std::move(profiles));
    auto frame = survey_map(all_, {}, nullptr, style, kSize, theme_);
    EXPECT_TRUE(frame) << to_line(frame.error());
    return frame ? std::move(*frame) : FrameDescription{};
  }
  [[nodiscard]] CurrentProfile at(std::size_t ping, std::vector<CurrentAt> bins) const {
    return {all_[0].pings[ping].time, all_[0].pings[ping].transducer, std::move(bins)};
  }
  std::vector<ObservationProduct> all_{map_example::product("obs-0001", 60)};
  Theme theme_ = light_theme(kSize);
};

// East is to the right and north is up; the fastest is 3 em long, one of half its speed half as long.
TEST_F(SurveyMapCurrents, ArrowsPointWhereTheWaterGoes) {
  const auto frame = map_with({at(5, {{20, 0.4, 0.0}}), at(50, {{20, 0.0, 0.2}})});
  const auto found = arrows(frame);
  ASSERT_EQ(found.size(), 2U);
  const double em = theme_.text_px;
  EXPECT_NEAR(found[0].second.x - found[0].first.x, 3.0 * em, 0.05 * em);
  EXPECT_NEAR(found[0].second.y - found[0].first.y, 0.0, 0.05 * em);
  EXPECT_NEAR(found[1].second.x - found[1].first.x, 0.0, 0.05 * em);
  EXPECT_NEAR(found[1].second.y - found[1].first.y, -1.5 * em, 0.05 * em);
  EXPECT_TRUE(says(frame, "20 m"));
  EXPECT_TRUE(says(frame, "0.40"));
}

TEST_F(SurveyMapCurrents, ThreeDepthsAndOnlyAsManyPlacesAsCanBeRead) {
  std::vector<CurrentAt> bins;
  for (int k = 0; k <= 10; ++k) bins.push_back({20.0 + 10.0 * k, 0.1, 0.1});
  CurrentProfiles crowded;
  for (std::size_t ping = 20; ping < 24; ++ping) crowded.push_back(at(ping, bins));
  const auto frame = map_with(crowded);
  const auto found = arrows(frame);
  for (const auto& [from, to] : found) {
    EXPECT_LT(std::hypot(from.x - found[0].first.x, from.y - found[0].first.y), 1.0) << "the first of the crowd alone";
  }
  EXPECT_EQ(found.size(), 3U);
  EXPECT_TRUE(says(frame, "30, 70, 110 m depth") || (says(frame, "30 m") && says(frame, "110 m")));
}

TEST_F(SurveyMapCurrents, NothingWithoutPlaceOrVelocity) {
  CurrentProfile placeless = at(5, {{20, 0.4, 0.0}});
  placeless.place = CurrentProfile{}.place;
  const auto frame = map_with({placeless, at(50, {{20, 0.0, 0.0}})});
  EXPECT_TRUE(arrows(frame).empty());
  EXPECT_FALSE(says(frame, "Arrows"));
}

}  // namespace
}  // namespace sonar
