// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/refused_echoes.h"

#include <gtest/gtest.h>

#include <memory>

namespace sonar {
namespace {

/// 2 fans x 2 beams whose channels run backwards.
BeamGrid grid() {
  BeamGrid grid;
  grid.elevation_deg = {-20.0, -10.0};
  grid.azimuth_deg = {260.0, 280.0};
  grid.channel = {3, 2, 1, 0};
  return grid;
}

JournalState with_school(std::int64_t ping_index, const PingMask& mask) {
  auto school = std::make_shared<StateSchool>();
  school->masks.pings.push_back({ping_index, mask});
  JournalState state;
  state.schools.push_back(std::move(school));
  return state;
}

// Echo 1 is seen in pings 3 and 5, echo 2 in ping 5; channel 1 is row 2.
std::vector<RefusedEcho> echoes() {
  const auto seen = [](std::int64_t ping_index, std::int64_t id, std::int64_t channel, std::int64_t sample) {
    RefusedEcho echo;
    echo.ping_index = ping_index;
    echo.echo_id = id;
    echo.channel = channel;
    echo.sample = sample;
    return echo;
  };
  return {seen(3, 1, 1, 40), seen(5, 2, 1, 80), seen(5, 1, 2, 41)};
}

TEST(RefusedEchoes, OneThatASchoolHasInAnyPingIsRefusedNoMore) {
  const PingMask has_it{{{2, 38, 4}}, {255, 255, 255, 255}};
  const auto left = still_refused(echoes(), with_school(3, has_it), grid());
  ASSERT_EQ(left.size(), 1U);
  EXPECT_EQ(left[0].echo_id, 2);
}

TEST(RefusedEchoes, OthersStay) {
  EXPECT_EQ(still_refused(echoes(), {}, grid()).size(), 3U);
  const PingMask has_it{{{2, 38, 4}}, {255, 255, 255, 255}};
  EXPECT_EQ(still_refused(echoes(), with_school(4, has_it), grid()).size(), 3U) << "another ping";
  const PingMask other_row{{{1, 38, 4}}, {255, 255, 255, 255}};
  EXPECT_EQ(still_refused(echoes(), with_school(3, other_row), grid()).size(), 3U) << "row 1 is channel 2";
  const PingMask beside{{{2, 41, 2}}, {255, 255}};
  EXPECT_EQ(still_refused(echoes(), with_school(3, beside), grid()).size(), 3U);
}

}  // namespace
}  // namespace sonar
