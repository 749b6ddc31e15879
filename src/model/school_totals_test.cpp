// SPDX-License-Identifier: Apache-2.0
#include "model/school_totals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace sonar {
namespace {

/// A school in pings first .. last that scatters the same in each, and its row.
void add(ObservationProduct& product, std::int64_t id, std::int64_t first, std::int64_t last, double echo_m2,
         const std::string& continues = {}, const std::string& status = "unreviewed") {
  SchoolRow& school = product.schools.emplace_back();
  school.observation = product.observation;
  school.school_id = id;
  school.continues = continues;
  school.status = status;
  school.backscatter_m2 = 0.8 * echo_m2;
  school.backscatter_total_m2 = echo_m2;
  for (std::int64_t ping = first; ping <= last; ++ping) {
    SchoolPingRow& row = product.school_pings.emplace_back();
    row.observation = product.observation;
    row.school_id = id;
    row.ping_index = ping;
    row.backscatter_m2 = 0.8 * echo_m2;
    row.backscatter_total_m2 = echo_m2;
  }
}

ObservationProduct observation(const std::string& name) {
  ObservationProduct product;
  product.observation = name;
  return product;
}

double total_m2(const std::vector<ObservationProduct>& products) {
  return total_backscatter_m2(counted_schools(products));
}

// By hand: 1 and 3 are one school of (10 * 2 + 30 * 4) / 40 = 3.5 m2, 2 is another one of 1 m2, 4 is none.
TEST(SchoolTotals, LeaveOutRejectedOnesAndCountAContinuedOneOnce) {
  ObservationProduct p = observation("obs-0001");
  add(p, 1, 0, 9, 2.0);
  add(p, 2, 0, 4, 1.0);
  add(p, 3, 10, 39, 4.0, "obs-0001/1");
  add(p, 4, 0, 8, 100.0, "", "rejected");
  do {
    const std::vector<ObservationProduct> all{p};
    const auto schools = counted_schools(all);
    ASSERT_EQ(schools.size(), 2U);
    for (const CountedSchool& school : schools) {
      if (school.rows.size() == 2) {
        EXPECT_EQ(school.rows.front()->school_id, 1);
      }
    }
    EXPECT_NEAR(total_m2(all), 4.5, 1e-12);
  } while (std::next_permutation(p.schools.begin(), p.schools.end(),
                                 [](const SchoolRow& a, const SchoolRow& b) { return a.school_id < b.school_id; }));
}

// Whatever rows a school's fish are told in, its total is that of the one row: 5 m2 in each of ten pings.
TEST(SchoolTotals, OfPartsAreThoseOfTheWhole) {
  ObservationProduct one = observation("obs-0001");
  add(one, 1, 0, 9, 5.0);
  EXPECT_NEAR(total_m2({one}), 5.0, 1e-12);
  ObservationProduct in_time = observation("obs-0001");
  add(in_time, 1, 3, 5, 5.0);
  add(in_time, 2, 0, 2, 5.0, "obs-0001/1");
  add(in_time, 3, 6, 9, 5.0, "obs-0001/2");
  EXPECT_NEAR(total_m2({in_time}), 5.0, 1e-12);
  // Two that a human selected side by side out of one that detection joins before and after them.
  ObservationProduct beside = observation("obs-0001");
  add(beside, 1, 3, 5, 3.0);
  add(beside, 2, 3, 5, 2.0, "obs-0001/1");
  add(beside, 3, 0, 2, 5.0, "obs-0001/1");
  add(beside, 4, 6, 9, 5.0, "obs-0001/1");
  EXPECT_NEAR(total_m2({beside}), 5.0, 1e-12);
  // Over a cut, in either order of products; ping 0 of one is not ping 0 of the other.
  ObservationProduct before = observation("obs-0001");
  add(before, 1, 0, 4, 5.0);
  ObservationProduct after = observation("obs-0002");
  add(after, 1, 0, 4, 5.0, "obs-0001/1");
  EXPECT_NEAR(total_m2({before, after}), 5.0, 1e-12);
  EXPECT_NEAR(total_m2({after, before}), 5.0, 1e-12);
  EXPECT_EQ(school_count(before), 1);
  EXPECT_EQ(school_count(after), 1) << "what it goes on from is in another observation";
}

// (2 + 4) / 2: the edge is in ping 1 alone, and there it holds for the school, whichever part touches it.
TEST(SchoolTotals, PingsThatTouchAnEdgeCountWhereThereAreNoOthers) {
  ObservationProduct p = observation("obs-0001");
  add(p, 1, 0, 1, 2.0);
  add(p, 2, 1, 2, 4.0, "obs-0001/1");
  p.school_pings[1].touches_edge = 1;
  EXPECT_NEAR(total_m2({p}), 3.0, 1e-12);
  for (SchoolPingRow& row : p.school_pings) row.touches_edge = 1;
  EXPECT_NEAR(total_m2({p}), (2.0 + 6.0 + 4.0) / 3.0, 1e-12);
}

// No figure is known where no edge is touched: those that are known count all the same.
TEST(SchoolTotals, AnUnknownFigureTakesNoPlaceOfAKnownOne) {
  ObservationProduct p = observation("obs-0001");
  add(p, 1, 0, 0, 2.0);
  add(p, 2, 1, 1, 4.0, "obs-0001/1");
  p.school_pings[0].touches_edge = 1;
  p.school_pings[1].backscatter_m2 = p.school_pings[1].backscatter_total_m2 = kUnknown;
  EXPECT_NEAR(total_m2({p}), 2.0, 1e-12);
}

TEST(SchoolTotals, TakeTheWholeEchoWhereItIsKnown) {
  ObservationProduct p = observation("obs-0001");
  add(p, 1, 0, 1, 2.0);
  EXPECT_NEAR(total_m2({p}), 2.0, 1e-12);
  // As in a product of 0.1.0, which knows what lies in the mask alone.
  p.schools[0].backscatter_total_m2 = kUnknown;
  EXPECT_NEAR(total_m2({p}), 1.6, 1e-12);
  add(p, 2, 2, 3, 2.0, "obs-0001/1");
  for (SchoolPingRow& row : p.school_pings) row.backscatter_total_m2 = kUnknown;
  EXPECT_NEAR(total_m2({p}), 1.6, 1e-12);
  // An unknown figure is no echo.
  for (SchoolPingRow& row : p.school_pings) row.backscatter_m2 = kUnknown;
  EXPECT_TRUE(std::isnan(counted_schools({&p, 1})[0].backscatter_m2));
  EXPECT_EQ(total_m2({p}), 0.0);
}

TEST(SchoolTotals, APartWhoseOtherPartIsRejectedOrGoneIsASchool) {
  ObservationProduct p = observation("obs-0001");
  add(p, 1, 0, 9, 2.0, "", "rejected");
  add(p, 2, 10, 19, 3.0, "obs-0001/1");
  add(p, 3, 20, 29, 5.0, "obs-0001/1");
  EXPECT_EQ(school_count(p), 1);
  EXPECT_NEAR(total_m2({p}), 4.0, 1e-12);
  p.schools = {p.schools[1]};
  EXPECT_NEAR(total_m2({p}), 3.0, 1e-12);
  // Rows of a foreign file may go round in a circle.
  ObservationProduct round = observation("obs-0001");
  add(round, 1, 0, 0, 1.0, "obs-0001/2");
  add(round, 2, 1, 1, 1.0, "obs-0001/1");
  EXPECT_EQ(school_count(round), 1);
  EXPECT_EQ(school_count(observation("obs-0001")), 0);
}

}  // namespace
}  // namespace sonar
