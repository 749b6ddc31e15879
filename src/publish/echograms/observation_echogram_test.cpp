// SPDX-License-Identifier: Apache-2.0
#include "publish/echograms/observation_echogram.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace sonar {
namespace {

/// Four range bins; a ping for each number, with that many of them at -40 dB and the others at -70 dB.
EchogramPyramid echogram_of(const std::vector<int>& loud) {
  EchogramPyramid out({0.0, 1.0, 4});
  for (std::size_t ping = 0; ping < loud.size(); ++ping) {
    std::array<EchogramCell, 4> column;
    for (int bin = 0; bin < 4; ++bin) {
      const auto count = static_cast<std::int16_t>(std::lround(counts_from_db(bin < loud[ping] ? -40.0 : -70.0)));
      column[static_cast<std::size_t>(bin)] = {1.0F, 1.0F, count, count};
    }
    out.add_ping(static_cast<TimeNs>(ping), column);
  }
  return out;
}

TEST(FullestPing, IsTheOneWithTheMostRangesAtTheLevel) {
  const std::vector<PingNavigation> pings(4);
  EXPECT_EQ(fullest_ping(echogram_of({1, 3, 2, 3}), pings, -50.0), 1) << "the first of two alike";
  EXPECT_EQ(fullest_ping(echogram_of({1, 3, 2, 3}), pings, -80.0), 0) << "all reach it everywhere";
  EXPECT_FALSE(fullest_ping(echogram_of({1, 3, 2, 3}), pings, -30.0));
  EXPECT_FALSE(fullest_ping(echogram_of({0, 0, 0, 0}), pings, -50.0));
}

TEST(FullestPing, IsNoBadOneAndNoneThatTheObservationHasNot) {
  std::vector<PingNavigation> pings(4);
  pings[1].bad = true;
  EXPECT_EQ(fullest_ping(echogram_of({1, 4, 2, 1}), pings, -50.0), 2);
  pings.resize(1);
  EXPECT_EQ(fullest_ping(echogram_of({1, 4, 2, 1}), pings, -50.0), 0) << "columns of another survey";
}

}  // namespace
}  // namespace sonar
