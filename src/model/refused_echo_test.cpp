// SPDX-License-Identifier: Apache-2.0
#include "model/refused_echo.h"

#include <gtest/gtest.h>

namespace sonar {
namespace {

RefusedEcho judged(const char* judge, double figure, double limit, const char* unit) {
  RefusedEcho echo;
  echo.judge = judge;
  echo.figure = figure;
  echo.limit = limit;
  echo.limit_unit = unit;
  return echo;
}

RefusedEcho seen(std::int64_t ping_index, std::int64_t id, double level_db) {
  RefusedEcho echo;
  echo.ping_index = ping_index;
  echo.echo_id = id;
  echo.level_db = level_db;
  return echo;
}

// Figures, limits and units as the judges in src/school/judge tell them.
TEST(RefusedEcho, EveryJudgeHasItsSentence) {
  EXPECT_EQ(why_no_school(judged("size", 3.82, 5.0, "m along range")),
            "no school: 3.82 m along range, 5 at least (judge size)");
  EXPECT_EQ(why_no_school(judged("size", 1.0, 2.0, "beams")), "no school: 1 beam, 2 at least (judge size)");
  EXPECT_EQ(why_no_school(judged("size", 2.0, 3.0, "fans")), "no school: 2 fans, 3 at least (judge size)");
  EXPECT_EQ(why_no_school(judged("prominence", 4.21, 6.0, "dB")),
            "no school: rises 4.21 dB above a stronger echo beside it, 6 at least (judge prominence)");
  EXPECT_EQ(why_no_school(judged("confirmation", 2.0, 3.0, "pings")),
            "no school: seen in 2 pings, 3 at least (judge confirmation)");
  EXPECT_EQ(why_no_school(judged("confirmation", 8.12, 10.3, "evidence over all pings")),
            "no school: evidence of 8.12 in all sightings together, 10.3 at least (judge confirmation)");
  EXPECT_EQ(why_no_school(judged("level", -82.14, -77.0, "dB re 1 m-1")),
            "no school: its Sv is -82.1 dB, -77 at least (judge level)");
  EXPECT_EQ(why_no_school(judged("surface", 14.24, 20.0, "m deep at most")),
            "no school: hangs from the surface down to 14.2 m, as bubbles do to 20 m (judge surface)");
  EXPECT_EQ(why_no_school(judged("ship", 0.031, 0.15, "share of the ship's way")),
            "no school: goes where the ship goes: drifts by 0.031 of the ship's way, 0.15 at least (judge ship)");
}

// A product may be newer than the program that shows it.
TEST(RefusedEcho, AJudgeThatIsNotKnownIsToldByItsFigure) {
  EXPECT_EQ(why_no_school(judged("shape", 0.4, 0.3, "roundness")),
            "no school: 0.4 roundness, 0.3 at most (judge shape)");
  EXPECT_EQ(why_no_school(judged("surface", 14.0, 20.0, "m")), "no school: 14 m, 20 at least (judge surface)");
  EXPECT_EQ(why_no_school(judged("shape", 0.4, kUnknown, "roundness")), "no school: 0.4 roundness (judge shape)");
  EXPECT_EQ(why_no_school(judged("shape", kUnknown, kUnknown, "")), "no school (judge shape)");
}

TEST(RefusedEcho, AnEchoIsToldByItsLoudestSighting) {
  const std::vector<RefusedEcho> rows{seen(3, 2, -50.0), seen(4, 1, -60.0), seen(5, 2, -40.0), seen(9, 2, -55.0)};
  const std::vector<RefusedSightings> sightings = refused_sightings(rows);
  ASSERT_EQ(sightings.size(), 2U);
  EXPECT_EQ(sightings[0].loudest, &rows[1]);
  EXPECT_EQ(sightings[0].pings, 1);
  EXPECT_EQ(sightings[1].loudest, &rows[2]);
  EXPECT_EQ(sightings[1].first_ping, 3);
  EXPECT_EQ(sightings[1].last_ping, 9);
  EXPECT_EQ(sightings[1].pings, 3);
  EXPECT_TRUE(refused_sightings({}).empty());
}

}  // namespace
}  // namespace sonar
