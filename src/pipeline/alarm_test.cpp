// SPDX-License-Identifier: Apache-2.0
#include "pipeline/alarm.h"

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

TEST(Alarm, TellsWhatItExpected) {
  for (const char* wrong : {"", "volume_m3", "volume_m3 >", "big > 3", "time_utc > 3", "volume_m3 > 3,", "> 3"}) {
    const auto alarm = Alarm::parse(wrong);
    ASSERT_FALSE(alarm) << wrong;
    EXPECT_EQ(alarm.error().code, ErrorCode::usage);
  }
}

}  // namespace
}  // namespace sonar
