// SPDX-License-Identifier: Apache-2.0
// Rows that are joined where a propagation by hand ended at its reach, and over a cut.
#include "pipeline/tasks/join_tracks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "io/product_example.h"
#include "model/school_totals.h"
#include "pipeline/tasks/merge.h"

namespace sonar {
namespace {

void beside_the_ship(ObservationProduct& product) {
  for (SchoolRow& school : product.schools) {
    school.speed_mps = example::kShip_mps;  // the masks of the example stay beside it
    school.course_deg = 0.0;
    school.length_m = 20.0;
  }
}

/// Ten pings; school 1 was carried from ping 2 to 5, its reach both ways; 2 begins two pings later, 3 is before it.
ObservationProduct cut_by_hand() {
  ObservationProduct p = example::empty("obs-0001", 10);
  const PingMask mask = example::block(1, 1, 2, 20, 10);
  example::add_school(p, 1, 2, 5, mask);
  example::add_school(p, 2, 7, 9, mask);
  example::add_school(p, 3, 0, 1, mask);
  beside_the_ship(p);
  p.schools[0].ended_at_reach = "both";
  return p;
}

std::vector<std::string> continues(const ObservationProduct& product) {
  std::vector<std::string> names;
  for (const SchoolRow& school : product.schools) names.push_back(school.continues);
  return names;
}

std::vector<std::int64_t> open_ends(const ObservationProduct& product) {
  std::vector<std::int64_t> pings;
  for (const Diagnostic& note : product.diagnostics) {
    if (note.code == DiagnosticCode::ended_at_reach) pings.push_back(note.ping_index);
  }
  return pings;
}

TEST(JoinAtReach, WhatBeginsThereIsTheSameSchool) {
  ObservationProduct p = cut_by_hand();
  join_at_reach(p, {});
  EXPECT_EQ(continues(p), (std::vector<std::string>{"obs-0001/3", "obs-0001/1", ""}));
  EXPECT_EQ(school_count(p), 1);
  EXPECT_TRUE(open_ends(p).empty());
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
  EXPECT_EQ(open_ends(p), (std::vector<std::int64_t>{2, 5}));
  // Too late is another as well.
  ObservationProduct late = cut_by_hand();
  MergeParams params;
  params.edge_pings = 0;
  join_at_reach(late, params);
  EXPECT_EQ(continues(late), (std::vector<std::string>{"obs-0001/3", "", ""}));
  EXPECT_EQ(open_ends(late), (std::vector<std::int64_t>{5}));
}

// The rest of the school that detection found goes on beyond the reach: what begins there beside it is another school.
TEST(JoinAtReach, AnEndBeyondWhichTheSchoolIsKnownToGoOnIsNone) {
  ObservationProduct p = cut_by_hand();
  const PingMask mask = example::block(1, 1, 2, 20, 10);
  example::add_school(p, 4, 6, 9, mask);
  beside_the_ship(p);
  p.schools[3].continues = "obs-0001/1";
  p.schools[0].ended_at_reach = "last";
  join_at_reach(p, {});
  EXPECT_EQ(continues(p), (std::vector<std::string>{"", "", "", "obs-0001/1"}));
  EXPECT_TRUE(open_ends(p).empty());
}

// A rejected one lies nearest: what goes on is the other one, and the rejected one's own end is nobody's.
TEST(JoinAtReach, ARejectedOneIsNoSchool) {
  ObservationProduct p = cut_by_hand();
  for (SchoolPingRow& row : p.school_pings) {
    if (row.school_id == 2) row.depth_m += 1.0;
    if (row.school_id == 2) row.latitude += 5.0 / 111'000.0;
  }
  example::add_school(p, 4, 6, 8, example::block(1, 1, 2, 20, 10));
  beside_the_ship(p);
  p.schools[3].status = "rejected";
  p.schools[3].ended_at_reach = "last";
  join_at_reach(p, {});
  EXPECT_EQ(continues(p), (std::vector<std::string>{"obs-0001/3", "obs-0001/1", "", ""}));
  EXPECT_EQ(school_count(p), 1);
  EXPECT_TRUE(open_ends(p).empty());
}

// As for totals, a chain holds together where a row in its middle is rejected; only its end is not that row's.
TEST(JoinAtReach, ARejectedRowHoldsAChainTogether) {
  ObservationProduct p = cut_by_hand();
  example::add_school(p, 4, 6, 6, example::block(1, 1, 2, 20, 10));
  beside_the_ship(p);
  p.schools[0].continues = "obs-0001/4";
  p.schools[3].status = "rejected";
  join_at_reach(p, {});
  EXPECT_EQ(continues(p), (std::vector<std::string>{"obs-0001/4", "obs-0001/1", "", "obs-0001/3"}));
  EXPECT_EQ(school_count(p), 1);
}

// The rest of a school is found before what a human selected of it, at the beginning of an observation that the clock cut:
// it is the school that goes on, in whatever order products come.
TEST(JoinOverCuts, ASchoolOfSeveralRowsIsJoinedOnce) {
  const TimeNs step = static_cast<TimeNs>(example::kPingSeconds * 1e9);
  ObservationProduct before = example::empty("obs-0001", 10);
  const PingMask mask = example::block(1, 1, 2, 20, 10);
  example::add_school(before, 1, 5, 8, mask);
  example::add_school(before, 2, 9, 9, mask);
  before.schools[1].continues = "obs-0001/1";
  const TimeNs first = example::kStart + 10 * step;
  ObservationProduct after = example::empty(
      "obs-0002", 10, destination({60.0, 5.0}, 10 * example::kPingSeconds * example::kShip_mps, 0.0), first);
  after.cut_after = first - step;
  example::add_school(after, 1, 2, 5, mask);
  example::add_school(after, 2, 0, 1, mask);
  after.schools[1].continues = "obs-0002/1";
  // One more begins near there, a little farther off: the school before the cut is taken.
  example::add_school(after, 3, 0, 5, mask);
  for (SchoolPingRow& row : after.school_pings) {
    if (row.school_id != 3) continue;
    const Geographic off = destination({row.latitude, row.longitude}, 10.0, 90.0);
    row.latitude = off.latitude_deg;
    row.longitude = off.longitude_deg;
  }
  beside_the_ship(before);
  beside_the_ship(after);
  for (const auto& products : {std::vector{before, after}, std::vector{after, before}}) {
    const auto survey = merge(products);
    ASSERT_TRUE(survey);
    EXPECT_EQ(continues(survey->observations[1]), (std::vector<std::string>{"obs-0001/2", "obs-0002/1", ""}));
    EXPECT_EQ(counted_schools(survey->observations).size(), 2U);
  }
}

}  // namespace
}  // namespace sonar
