// SPDX-License-Identifier: Apache-2.0
#include "publish/movies/between_pings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/units.h"

namespace sonar {
namespace {

Array3<std::int16_t> counts_of(int seed) {
  Array3<std::int16_t> counts({3, 4, 50});
  int value = seed;
  for (std::int16_t& count : counts.all()) {
    value = (value * 75 + 74) % 65537;
    count = value % 9 == 0 ? kNoData : static_cast<std::int16_t>(-value % 9000);
  }
  return counts;
}

TEST(BetweenPings, EqualPingsStayAsTheyAre) {
  Work work(1);
  const auto counts = counts_of(5);
  for (const double fraction : {0.1, 0.5, 0.9}) EXPECT_EQ(counts_between(counts, counts, fraction, work), counts);
}

// By the definition: 10 log10 of the weighted mean of the linear values, to half a count.
TEST(BetweenPings, SvIsInterpolatedInLinearUnits) {
  Work work(2);
  const auto a = counts_of(5);
  const auto b = counts_of(17);
  for (const double fraction : {0.25, 0.5, 0.75}) {
    const auto between = counts_between(a, b, fraction, work);
    for (std::size_t i = 0; i < a.all().size(); ++i) {
      const std::int16_t from = a.all()[i];
      const std::int16_t to = b.all()[i];
      const std::int16_t here = between.all()[i];
      if (from == kNoData || to == kNoData) {
        EXPECT_EQ(here, fraction < 0.5 ? from : to);
        continue;
      }
      const double linear = (1.0 - fraction) * std::pow(10.0, db_from_counts(from) / 10.0) +
                            fraction * std::pow(10.0, db_from_counts(to) / 10.0);
      EXPECT_NEAR(db_from_counts(here), 10.0 * std::log10(linear), 0.51 * kDbPerCount);
      EXPECT_GE(here, std::min(from, to));
      EXPECT_LE(here, std::max(from, to));
    }
  }
}

TEST(BetweenPings, OtherShapesAreNotMixed) {
  Work work(1);
  const auto a = counts_of(5);
  const Array3<std::int16_t> b({3, 4, 40}, 7);
  EXPECT_EQ(counts_between(a, b, 0.4, work), a);
  EXPECT_EQ(counts_between(a, b, 0.6, work), b);
}

TEST(BetweenPings, TheShipIsOnItsWayAndTurnsTheShorterWay) {
  PingNavigation a;
  a.time = 1'000'000'000;
  a.transducer = {60.0, 179.99};
  a.heading_deg = 350.0;
  a.transducer_depth_m = 6.0;
  PingNavigation b = a;
  b.time = 3'000'000'000;
  b.transducer = {60.02, -179.97};
  b.heading_deg = 10.0;
  b.transducer_depth_m = 8.0;
  const PingNavigation half = navigation_between(a, b, 0.5);
  EXPECT_EQ(half.time, 2'000'000'000);
  EXPECT_NEAR(half.transducer.latitude_deg, 60.01, 1e-12);
  EXPECT_NEAR(half.transducer.longitude_deg, -179.99, 1e-9) << "across the date line";
  EXPECT_NEAR(half.heading_deg, 0.0, 1e-9);
  EXPECT_DOUBLE_EQ(half.transducer_depth_m, 7.0);
  EXPECT_TRUE(std::isnan(half.speed_mps)) << "what neither knows";
  b.heading_deg = std::nan("");
  EXPECT_TRUE(std::isnan(navigation_between(a, b, 0.2).heading_deg));
}

}  // namespace
}  // namespace sonar
