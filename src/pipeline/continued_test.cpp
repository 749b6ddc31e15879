// SPDX-License-Identifier: Apache-2.0
// Rows that are joined where a propagation by hand ended at its reach.
#include "pipeline/continued.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "io/product_example.h"
#include "model/school_totals.h"
#include "pipeline/merge.h"

namespace sonar {
namespace {

/// Ten pings; school 1 was carried from ping 2 to 5, its reach both ways; 2 begins two pings later, 3 is before it.
ObservationProduct cut_by_hand() {
  ObservationProduct p = example::empty("obs-0001", 10);
  const PingMask mask = example::block(1, 1, 2, 20, 10);
  example::add_school(p, 1, 2, 5, mask);
  example::add_school(p, 2, 7, 9, mask);
  example::add_school(p, 3, 0, 1, mask);
  for (SchoolRow& school : p.schools) {
    school.speed_mps = example::kShip_mps;  // the masks stay beside the ship
    school.course_deg = 0.0;
    school.length_m = 20.0;
  }
  p.schools[0].ended_at_reach = "both";
  return p;
}

std::vector<std::string> continues(const ObservationProduct& product) {
  std::vector<std::string> names;
  for (const SchoolRow& school : product.schools) names.push_back(school.continues);
  return names;
}

int open_ends(const ObservationProduct& product) {
  return static_cast<int>(std::count_if(product.diagnostics.begin(), product.diagnostics.end(),
                                        [](const auto& note) { return note.code == DiagnosticCode::ended_at_reach; }));
}

TEST(JoinAtReach, WhatBeginsThereIsTheSameSchool) {
  ObservationProduct p = cut_by_hand();
  join_at_reach(p, {});
  EXPECT_EQ(continues(p), (std::vector<std::string>{"obs-0001/3", "obs-0001/1", ""}));
  EXPECT_EQ(totals_of(p.schools).schools, 1);
  EXPECT_EQ(open_ends(p), 0);
}

TEST(JoinAtReach, AnEndOfItsOwnIsNoCut) {
  ObservationProduct p = cut_by_hand();
  p.schools[0].ended_at_reach = "last";
  join_at_reach(p, {});
  EXPECT_EQ(continues(p), (std::vector<std::string>{"", "obs-0001/1", ""}));
  ObservationProduct ended = cut_by_hand();
  ended.schools[0].ended_at_reach = "";
  join_at_reach(ended, {});
  EXPECT_EQ(continues(ended), (std::vector<std::string>{"", "", ""}));
}

TEST(JoinAtReach, WhatLiesElsewhereIsAnotherAndTheEndIsNoted) {
  ObservationProduct p = cut_by_hand();
  for (SchoolPingRow& row : p.school_pings) {
    if (row.school_id != 1) row.depth_m += 50.0;
  }
  join_at_reach(p, {});
  EXPECT_EQ(continues(p), (std::vector<std::string>{"", "", ""}));
  EXPECT_EQ(open_ends(p), 2);
  // Too late is another as well.
  ObservationProduct late = cut_by_hand();
  MergeParams params;
  params.edge_pings = 0;
  join_at_reach(late, params);
  EXPECT_EQ(continues(late), (std::vector<std::string>{"obs-0001/3", "", ""}));
  EXPECT_EQ(open_ends(late), 1);
}

// The rest of a school is found before what a human selected of it, at the beginning of an observation that the clock cut:
// it is the school that goes on, in whatever order products come.
TEST(JoinAtReach, ACutJoinsTheWholeSchoolOnce) {
  const TimeNs step = static_cast<TimeNs>(example::kPingSeconds * 1e9);
  ObservationProduct before = example::empty("obs-0001", 10);
  const PingMask mask = example::block(1, 1, 2, 20, 10);
  example::add_school(before, 1, 5, 9, mask);
  const TimeNs first = example::kStart + 10 * step;
  ObservationProduct after = example::empty(
      "obs-0002", 10, destination({60.0, 5.0}, 10 * example::kPingSeconds * example::kShip_mps, 0.0), first);
  after.cut_after = first - step;
  example::add_school(after, 1, 2, 5, mask);
  example::add_school(after, 2, 0, 1, mask);
  after.schools[1].continues = "obs-0002/1";
  for (ObservationProduct* p : {&before, &after}) {
    for (SchoolRow& school : p->schools) {
      school.speed_mps = example::kShip_mps;
      school.course_deg = 0.0;
      school.length_m = 20.0;
    }
  }
  for (const auto& products : {std::vector{before, after}, std::vector{after, before}}) {
    const auto survey = merge(products);
    ASSERT_TRUE(survey);
    EXPECT_EQ(survey->schools[1].continues, "obs-0001/1");
    EXPECT_EQ(survey->schools[2].continues, "obs-0002/1");
    EXPECT_EQ(totals_of(survey->schools).schools, 1);
    EXPECT_EQ(totals_of(survey->schools).continued, 2);
  }
}

}  // namespace
}  // namespace sonar
