// SPDX-License-Identifier: Apache-2.0
#include "school/evidence/place_statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "base/units.h"

namespace sonar {
namespace {

constexpr Shape3 kShape{2, 12, 40};
constexpr std::size_t kPings = 9;

struct Window {
  explicit Window(const std::vector<float>& stretch_of_ping) {
    std::mt19937 random(9);
    std::vector<std::vector<float>> stretch;
    for (std::size_t p = 0; p < kPings; ++p) {
      Array3<std::int16_t>& ping = pings.emplace_back(kShape);
      for (std::int16_t& value : ping.all()) {
        value = random() % 8 == 0 ? kNoData : static_cast<std::int16_t>(random() % 500);
      }
      Array3<std::uint8_t>& of_ping = marks.emplace_back(kShape);
      for (std::uint8_t& mark : of_ping.all()) mark = random() % 9 == 0 ? 1 : 0;
      stretch.emplace_back();
      if (!stretch_of_ping.empty()) stretch.back().assign(kShape.rows(), stretch_of_ping[p % stretch_of_ping.size()]);
    }
    places.emplace(std::move(stretch), kShape);
  }

  /// Of one place, in order.
  [[nodiscard]] std::vector<std::int16_t> values(int fan, int place) const {
    std::vector<std::int16_t> out;
    for (std::size_t p = 0; p < kPings; ++p) {
      for (int beam = 0; beam < kShape.beams; ++beam) {
        places->for_each(p, fan * kShape.beams + beam, kShape.samples, [&](int block, int at) {
          const std::int16_t value = pings[p](fan, beam, block);
          if (at == place && value != kNoData && marks[p](fan, beam, block) == 0) out.push_back(value);
        });
      }
    }
    std::ranges::sort(out);
    return out;
  }

  std::vector<Array3<std::int16_t>> pings;
  std::vector<Array3<std::uint8_t>> marks;
  std::optional<Places> places;
};

void expect_sorted_shares(const Window& window) {
  const auto told = statistics_of_places(window.pings, window.marks, *window.places, Trend::none);
  const int count = window.places->count();
  ASSERT_EQ(told.size(), static_cast<std::size_t>(kShape.fans * count));
  int looked_at = 0;
  for (int fan = 0; fan < kShape.fans; ++fan) {
    for (int place = 0; place < count; ++place) {
      const std::vector<std::int16_t> values = window.values(fan, place);
      if (values.size() < 60) continue;  // joined by those of the places beside
      const auto at = [&](double share) {
        return values[static_cast<std::size_t>(share * static_cast<double>(values.size()))];
      };
      const PlaceStatistics& here = told[static_cast<std::size_t>(fan * count + place)];
      ASSERT_EQ(here.middle, at(0.5)) << fan << " " << place;
      ASSERT_EQ(here.below, at(0.5) - at(0.16));
      ASSERT_EQ(here.above, at(0.84) - at(0.5));
      ++looked_at;
    }
  }
  EXPECT_GT(looked_at, 40);
}

TEST(place_statistics, are_shares_of_the_sorted_values_of_each_place) { expect_sorted_shares(Window({})); }

// Beams in which two blocks have one place, and beams in which some places have none.
TEST(place_statistics, of_stretched_beams_too) {
  expect_sorted_shares(Window({0.7F}));
  expect_sorted_shares(Window({1.0F, 0.63F, 1.6F, 1.2F}));
}

TEST(place_statistics, few_values_are_joined_by_those_beside_and_none_are_filled_in) {
  Window window({});
  // of place 10 to 12 one ping tells alone, of 20 to 30 none
  for (std::size_t p = 0; p < kPings; ++p) {
    for (int row = 0; row < static_cast<int>(kShape.rows()); ++row) {
      const auto marks = window.marks[p].view().row(row);
      for (std::size_t block = 10; block <= 12; ++block) marks[block] = p == 0 ? 0 : 1;
      for (std::size_t block = 20; block <= 30; ++block) marks[block] = 1;
    }
  }
  const auto told = statistics_of_places(window.pings, window.marks, *window.places, Trend::none);
  std::vector<std::int16_t> joined;
  for (const int place : {9, 10, 11, 12, 13}) {
    const auto values = window.values(0, place);
    joined.insert(joined.end(), values.begin(), values.end());
  }
  std::ranges::sort(joined);
  EXPECT_EQ(told[11].middle, joined[joined.size() / 2]);
  // three places on, the nearest that tells something still lends it
  EXPECT_EQ(told[22].middle, told[19].middle);
  EXPECT_EQ(told[28].middle, told[31].middle);
  EXPECT_EQ(told[25].middle, told[22].middle + (told[28].middle - told[22].middle) * 3 / 6);
}

}  // namespace
}  // namespace sonar
