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

#include "base/units.h"
#include "geo/geodesic.h"
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

/// Shafts of arrows: paths of an open line of two points and open heads of three.
std::vector<std::pair<PixelPoint, PixelPoint>> arrows(const FrameDescription& frame, std::size_t heads = 1) {
  std::vector<std::pair<PixelPoint, PixelPoint>> out;
  for (const auto& item : frame.items) {
    const auto* path = std::get_if<PathItem>(&item);
    if (path == nullptr || path->parts.size() != 1 + heads || path->parts[0].closed ||
        path->parts[0].points.size() != 2) {
      continue;
    }
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
  /// A tenth of the ship's way.
  [[nodiscard]] double apart_m() const {
    return geodesic(all_[0].pings.front().transducer, all_[0].pings.back().transducer).distance_m / 10.0;
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

// Ten of eleven lie below 0.3 m/s, which nine tenths keep below; half as much again is 0.45 m/s, 3 em. One at 5 m/s is cut there
// and told; the others are 0.3 / 0.45 of that, and would have been 0.3 / 5.
TEST_F(SurveyMapCurrents, OneWildBinMakesTheOthersNoShorter) {
  CurrentProfiles profiles;
  for (std::size_t k = 0; k < 11; ++k) {
    profiles.push_back(at(0, {{20, k == 4 ? -5.0 : -0.3, 0.0}}));
    profiles.back().place = destination(all_[0].pings[0].transducer, static_cast<double>(k) * apart_m(), 0.0);
  }
  const auto frame = map_with(profiles);
  const double em = theme_.text_px;
  const auto plain = arrows(frame);
  ASSERT_EQ(plain.size(), 10U);
  for (const auto& [from, to] : plain) EXPECT_NEAR(from.x - to.x, 2.0 * em, 0.05 * em);
  const auto cut = arrows(frame, 2);
  ASSERT_EQ(cut.size(), 1U);
  EXPECT_NEAR(cut[0].first.x - cut[0].second.x, 3.0 * em, 0.05 * em);
  EXPECT_TRUE(says(frame, "0.45"));
  EXPECT_TRUE(says(frame, "two heads: faster"));
}

// Profiles all over the map and beyond it: what flows towards the border ends before it.
TEST_F(SurveyMapCurrents, NoArrowIsCutByTheBorder) {
  for (const double towards : {0.0, 90.0, 180.0, 270.0}) {
    CurrentProfiles profiles;
    const CurrentAt flow{20, 0.3 * std::sin(rad_from_deg(towards)), 0.3 * std::cos(rad_from_deg(towards))};
    for (double north_m = -900.0; north_m < 2100.0; north_m += 50.0) {
      for (double east_m = -2500.0; east_m < 2500.0; east_m += 50.0) {
        profiles.push_back(at(0, {flow}));
        profiles.back().place = to_geographic(Point<Enu>{east_m, north_m, 0.0}, all_[0].pings[0].transducer);
      }
    }
    const auto frame = map_with(profiles);
    const auto found = arrows(frame);
    ASSERT_FALSE(found.empty());
    const auto* clip = std::get_if<ClipItem>(&*std::find_if(
        frame.items.begin(), frame.items.end(), [](const auto& i) { return std::holds_alternative<ClipItem>(i); }));
    bool near_border = false;
    for (const auto& [from, to] : found) {
      EXPECT_TRUE(inside(clip->place, to)) << towards;
      const PixelPoint twice{2.0 * to.x - from.x, 2.0 * to.y - from.y};
      near_border = near_border || !inside(clip->place, twice);
    }
    EXPECT_TRUE(near_border) << "the border is to be reached";
  }
}

// Of two bins both are shown, of three all three; each by the number that the unit has for it.
TEST_F(SurveyMapCurrents, ShownDepthsAreThoseThatAreTold) {
  EXPECT_EQ(arrows(map_with({at(30, {{20, 0.2, 0.0}, {60, 0.2, 0.0}})})).size(), 2U);
  EXPECT_EQ(arrows(map_with({at(30, {{20, 0.2, 0.0}, {60, 0.2, 0.0}, {100, 0.2, 0.0}})})).size(), 3U);
  theme_.units.lengths = LengthUnit::fathoms;
  // 20 and 21 m are both 11 fathoms.
  const auto frame = map_with({at(30, {{20, 0.2, 0.0}, {21, 0.2, 0.0}})});
  EXPECT_EQ(arrows(frame).size(), 1U);
  EXPECT_TRUE(says(frame, "11 "));
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
