// SPDX-License-Identifier: Apache-2.0
#include "pipeline/integrate/transects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace sonar {
namespace {

using testing::HasSubstr;

const std::string kHeader = "name,stratum,type,start_utc,stop_utc\n";

Result<std::vector<Transect>> read(const std::string& text) {
  const auto table = parse_csv(text, "t.csv");
  if (!table) return pass_on(table);
  return transects_of(*table);
}

TEST(Transects, come_in_the_order_of_time_whatever_that_of_lines_and_columns) {
  const auto read_ones = read(
      "stop_utc,name,type,start_utc,stratum\n"
      "2026-11-21T12:00:00Z,B,transect,2026-11-21T11:00:00Z,north\n"
      "2026-11-21T11:20:00Z,trawl 1,off,2026-11-21T11:10:00Z,\n"
      "2026-11-21T10:30:00.5Z,A,transect,2026-11-21T10:00:00Z,south\n");
  ASSERT_TRUE(read_ones) << to_line(read_ones.error());
  const TimeNs ten = *time_from_iso("2026-11-21T10:00:00Z");
  const TimeNs minute = 60 * kSecondNs;
  const std::vector<Transect> expected{{"A", "south", EffortType::transect, ten, ten + 30 * minute + kSecondNs / 2},
                                       {"B", "north", EffortType::transect, ten + 60 * minute, ten + 120 * minute},
                                       {"trawl 1", "", EffortType::off, ten + 70 * minute, ten + 80 * minute}};
  EXPECT_EQ(*read_ones, expected);
}

TEST(Transects, what_is_wrong_is_told_with_its_line) {
  const struct {
    std::string text;
    std::string told;
  } cases[] = {
      {"name,stratum,type,start_utc\n", "no column 'stop_utc'"},
      {"stratum,type,start_utc,stop_utc\ns,transect,2026-11-21T10:00:00Z,2026-11-21T11:00:00Z\n", "no column 'name'"},
      {"name,stratum,type,start_utc,stop_utc,speed\n", "'speed' is none of"},
      {kHeader, "found none"},
      {kHeader + "A,s,transit,2026-11-21T10:00:00Z,2026-11-21T11:00:00Z\n", "line 2: type 'transit'"},
      {kHeader + ",s,transect,2026-11-21T10:00:00Z,2026-11-21T11:00:00Z\n", "no name"},
      {kHeader + "A,s,transect,10:00,2026-11-21T11:00:00Z\n", "'10:00'"},
      {kHeader + "A,s,transect,,2026-11-21T11:00:00Z\n", "line 2: start_utc and stop_utc"},
      {kHeader + "A,s,transect,2026-11-21T11:00:00Z,2026-11-21T10:00:00Z\n", "lies before"},
      {kHeader + "A,s,transect,2026-11-21T10:00:00Z,2026-11-21T11:00:00Z\n"
                 "B,s,transect,2026-11-21T10:59:00Z,2026-11-21T12:00:00Z\n",
       "line 3: transect 'B' begins before 'A' of line 2"},
      {kHeader + "A,s,transect,2026-11-21T10:00:00Z,2026-11-21T11:00:00Z\n"
                 "A,s,transect,2026-11-21T11:59:00Z,2026-11-21T12:00:00Z\n",
       "line 3: transect 'A' stands in line 2 too"},
  };
  for (const auto& c : cases) {
    const auto refused = read(c.text);
    ASSERT_FALSE(refused) << c.text;
    EXPECT_EQ(refused.error().code, ErrorCode::format);
    EXPECT_EQ(refused.error().where.file, "t.csv");
    EXPECT_THAT(refused.error().text, HasSubstr(c.told));
  }
}

TEST(Transects, one_may_begin_where_another_stops) {
  EXPECT_TRUE(read(kHeader + "A,s,transect,2026-11-21T10:00:00Z,2026-11-21T11:00:00Z\n"
                             "B,s,transect,2026-11-21T11:00:00Z,2026-11-21T12:00:00Z\n"));
}

TEST(Transects, off_effort_needs_no_name_and_may_lie_anywhere) {
  EXPECT_TRUE(read(kHeader + ",,off,2026-11-21T10:00:00Z,2026-11-21T11:00:00Z\n"
                             ",,off,2026-11-21T10:30:00Z,2026-11-21T11:30:00Z\n"));
}

}  // namespace
}  // namespace sonar
