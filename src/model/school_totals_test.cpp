// SPDX-License-Identifier: Apache-2.0
#include "model/school_totals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace sonar {
namespace {

SchoolRow row(std::int64_t id, double backscatter_m2, std::int64_t pings, std::int64_t whole,
              const std::string& continues = {}, const std::string& status = "unreviewed") {
  SchoolRow made;
  made.observation = "obs-0001";
  made.school_id = id;
  made.backscatter_m2 = backscatter_m2;
  made.n_pings = pings;
  made.n_pings_whole = whole;
  made.continues = continues;
  made.status = status;
  return made;
}

// By hand: 1 with 3 and 4 is one school of (10 * 2 + 30 * 4) / 40 = 3.5 m2 over its whole pings, for 4 has none; 2 is
// another one; 5 is none.
TEST(SchoolTotals, LeaveOutRejectedOnesAndCountAContinuedOneOnce) {
  std::vector<SchoolRow> rows{row(1, 2.0, 12, 10), row(2, 1.0, 5, 0), row(3, 4.0, 30, 30, "obs-0001/1"),
                              row(4, 9.0, 7, 0, "obs-0001/3"), row(5, 100.0, 9, 9, "", "rejected")};
  do {
    const SchoolTotals totals = totals_of(rows);
    EXPECT_EQ(totals.schools, 2);
    EXPECT_EQ(totals.rejected, 1);
    EXPECT_EQ(totals.continued, 2);
    EXPECT_NEAR(totals.backscatter_m2, 4.5, 1e-12);
  } while (std::next_permutation(rows.begin(), rows.end(),
                                 [](const SchoolRow& a, const SchoolRow& b) { return a.school_id < b.school_id; }));
}

TEST(SchoolTotals, APartWhoseOtherPartIsRejectedOrGoneIsASchool) {
  const std::vector<SchoolRow> rejected{row(1, 2.0, 10, 10, "", "rejected"), row(2, 3.0, 10, 10, "obs-0001/1")};
  EXPECT_EQ(totals_of(rejected).schools, 1);
  EXPECT_EQ(totals_of(rejected).continued, 0);
  EXPECT_NEAR(totals_of(rejected).backscatter_m2, 3.0, 1e-12);
  EXPECT_EQ(totals_of(std::vector{row(2, 3.0, 10, 10, "obs-0000/1")}).schools, 1);
  // Rows of a foreign file may go round in a circle.
  EXPECT_EQ(totals_of(std::vector{row(1, 1.0, 1, 1, "obs-0001/2"), row(2, 1.0, 1, 1, "obs-0001/1")}).schools, 1);
  EXPECT_EQ(totals_of({}).schools, 0);
}

}  // namespace
}  // namespace sonar
