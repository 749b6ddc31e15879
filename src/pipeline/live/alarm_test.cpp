// SPDX-License-Identifier: Apache-2.0
#include "pipeline/live/alarm.h"

#include <gtest/gtest.h>

namespace sonar {
namespace {

TEST(Alarm, HoldsWhereAllItsComparisonsDo) {
  const auto alarm = Alarm::parse("volume_m3 > 20000,range_m<150");
  ASSERT_TRUE(alarm);
  SchoolPingRow row;
  row.volume_m3 = 20001.0;
  row.range_m = 149.0;
  EXPECT_TRUE(alarm->holds(row));
  row.range_m = 150.0;
  EXPECT_FALSE(alarm->holds(row));
  row.range_m = kUnknown;
  EXPECT_FALSE(alarm->holds(row));
}

TEST(Alarm, RingsWhenASchoolBeginsToFitAlsoBetweenTwoLooks) {
  Alarms alarms({*Alarm::parse("volume_m3 > 100")});
  LiveSchool school;
  school.newest.observation = "obs-0001";
  school.newest.school_id = 3;
  const auto seen = [&](const std::vector<double>& volumes_m3) {
    school.since.clear();
    for (const double volume_m3 : volumes_m3) {
      school.since.push_back(school.newest);
      school.since.back().volume_m3 = volume_m3;
    }
    return alarms.ring({&school, 1});
  };
  EXPECT_TRUE(seen({50.0}).empty());
  const auto ringing = seen({60.0, 120.0, 70.0});  // three pings in one look
  ASSERT_EQ(ringing.size(), 1U);
  EXPECT_EQ(ringing[0].school.newest.volume_m3, 120.0);
  EXPECT_TRUE(seen({130.0}).empty()) << "it is told already";
  EXPECT_TRUE(seen({80.0}).empty());
  EXPECT_EQ(seen({140.0}).size(), 1U) << "it fits anew";
}

TEST(Alarm, TellsWhatItExpected) {
  for (const char* wrong : {"", "volume_m3", "volume_m3 >", "big > 3", "time_utc > 3", "volume_m3 > 3,", "> 3"}) {
    const auto alarm = Alarm::parse(wrong);
    ASSERT_FALSE(alarm) << wrong;
    EXPECT_EQ(alarm.error().code, ErrorCode::usage);
  }
}

}  // namespace
}  // namespace sonar
