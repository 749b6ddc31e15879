// SPDX-License-Identifier: Apache-2.0
#include "pipeline/imports/import_echoview.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "pipeline/imports/test_import.h"

namespace sonar {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace)
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Whether a place lies in a polygon, by the angle that it is seen under: all round, or not at all.
bool inside(const std::vector<std::pair<double, double>>& polygon, double x, double y) {
  double turned = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto [ax, ay] = polygon[i];
    const auto [bx, by] = polygon[(i + 1) % polygon.size()];
    turned += std::atan2((ax - x) * (by - y) - (bx - x) * (ay - y), (ax - x) * (bx - x) + (ay - y) * (by - y));
  }
  return std::abs(turned) > 3.0;
}

TEST_F(Import, APolygonHoldsTheSamplesWhoseMiddlesLieInIt) {
  place_.fan = 2;
  place_.beams = BeamSpan{1, 4};
  // Drawn by hand, with a bay; no sample lies nearer than 2 cm to a side.
  const std::vector<std::pair<double, double>> polygon{{1.0, 12.0}, {7.0, 9.1},   {15.5, 14.25},
                                                       {9.0, 21.3}, {11.3, 30.4}, {3.0, 27.7}};
  std::vector<Corner> corners;
  for (const auto& [seconds, depth_m] : polygon) {
    corners.push_back({kBegin + kOffset + static_cast<TimeNs>(seconds * 1e9), depth_m});
  }
  Voxels expected;
  for (int ping = 0; ping < kPings; ++ping) {
    for (int sample = 5; sample < kSamples; ++sample) {
      if (!inside(polygon, 2.0 * ping, -0.2 + 0.5 * sample)) continue;
      for (int beam = 1; beam <= 4; ++beam) expected.insert({ping, 2 * kBeams + beam, sample});
    }
  }
  ASSERT_GT(expected.size(), 300U);
  const JournalState state = carried_out(read(evr({region(1, corners, "north wall", {"dense"})})));
  ASSERT_EQ(state.schools.size(), 1U);
  EXPECT_EQ(voxels_of(state.schools[0]->masks), expected);
  const SchoolRow& row = state.schools[0]->masks.decided;
  EXPECT_EQ(std::tuple(row.name, row.species, row.comment), std::tuple("north wall", "herring", "dense"));
  EXPECT_EQ(std::tuple(row.origin, row.operator_name), std::tuple("manual", "someone"));
}

// Samples 0 to 4 are near field: no brush takes them, and the import says the same as what is replayed.
TEST_F(Import, VoxelsThatCannotBelongToASchoolAreLeftOut) {
  place_.fan = 0;
  place_.beams = BeamSpan{0, 0};
  const Imported imported = read(evr({region(3, box(0, 1, -9999.99, 2.55)), region(1, box(3, 3, 0.0, 1.0))}));
  ASSERT_EQ(imported.schools.size(), 2U);
  const auto lines = school_lines(imported.schools[0], sea_.context(), {"", kBegin}, 7);
  ASSERT_TRUE(lines.has_value());
  EXPECT_EQ(lines->voxels, 2U) << "sample 5, at 2.3 m, in two pings";
  ASSERT_EQ(lines->lines.size(), 3U);
  for (const JournalLine& line : lines->lines) EXPECT_EQ(line.step, 7) << "undone together";
  EXPECT_EQ(lines->lines.back().n, 9);
  const auto none = school_lines(imported.schools[1], sea_.context(), {"", kBegin}, 1);
  ASSERT_TRUE(none.has_value());
  EXPECT_THAT(none->lines, IsEmpty());
  EXPECT_EQ(none->pings_left_out, 1U);
}

TEST_F(Import, TheBrushTakesVoxelsFromWhatWasDetected) {
  place_.fan = 2;
  place_.beams = BeamSpan{3, 3};
  const JournalState state = carried_out(read(evr({region(1, box(2, 3, 16.8, 25.0))})), SmallSea::detected());
  ASSERT_EQ(state.schools.size(), 3U);
  EXPECT_THAT(state.notes, IsEmpty());
  EXPECT_EQ(voxels_of(state.schools[2]->masks).size(), 2U * 17U) << "samples 34 to 50, at 16.8 to 24.8 m";
}

// The told cells are samples 20 to 29 of beam 2 and 26 to 31 of beam 4; the polygon was cut at 24 and drawn out to 33.
TEST_F(Import, AnOutlineThatWasChangedElsewhereIsFollowed) {
  const std::vector<std::string> notes{"fan 3", "beams 2 4", "cells " + text_of(shown_time(2)) + " 2 20 10 4 26 6"};
  const double near_m = -0.2 + 0.5 * 23.5;
  const double far_m = -0.2 + 0.5 * 33.5;
  const JournalState state = carried_out(read(evr({region(1, box(2, 3, near_m, far_m), "obs-0001/3", notes)})));
  ASSERT_EQ(state.schools.size(), 1U);
  Voxels expected;
  for (int sample = 24; sample <= 33; ++sample) {
    if (sample < 30) expected.insert({2, 3 * kBeams + 2, sample});
    if (sample >= 26 && sample < 32) expected.insert({2, 3 * kBeams + 4, sample});
    for (int beam = 2; beam <= 4; ++beam) {
      if (sample >= 32) expected.insert({2, 3 * kBeams + beam, sample});
      expected.insert({3, 3 * kBeams + beam, sample});  // a ping of which nothing is told
    }
  }
  EXPECT_EQ(voxels_of(state.schools[0]->masks), expected);
  EXPECT_EQ(state.schools[0]->masks.decided.name, "") << "the name of an export is none";
  const JournalState renamed = carried_out(read(evr({region(1, box(2, 3, near_m, far_m), "north wall", notes)})));
  ASSERT_EQ(renamed.schools.size(), 1U);
  EXPECT_EQ(renamed.schools[0]->masks.decided.name, "north wall");
}

TEST_F(Import, MarksAndBadPingsAreOnTheClockOfTheDatagrams) {
  const Imported imported = read(
      evr({region(2, {{shown_time(0), 5.0}}, "haul 12", {"cod"}), region(2, {{shown_time(3) + kSecondNs, 5.0}}, ""),
           region(0, box(2, 4, -9999.99, 9999.99)), region(0, box(5, 5, 0.0, 9999.99))}));
  EXPECT_THAT(imported.left_out, IsEmpty());
  ASSERT_EQ(imported.events.size(), 2U);
  EXPECT_EQ(imported.events[0], (EventCommand{"other", ping_time(0), "haul 12: cod"}));
  EXPECT_NEAR(static_cast<double>(imported.events[1].time - ping_time(3)), 1e9, 1e5);
  EXPECT_THAT(imported.bad,
              ElementsAre(BadPingsCommand{ping_time(2), ping_time(4)}, BadPingsCommand{ping_time(5), ping_time(5)}));
}

TEST_F(Import, WhatAJournalHasNoChoiceForIsTold) {
  place_.fan = 2;
  const TimeNs later = shown_time(kPings) + 60 * kSecondNs;
  const Imported imported = read(evr({region(0, box(2, 4, 10.0, 9999.99), "part"),
                                      region(4, box(2, 4, -1.0, 50.0), "empty"), region(2, {{later, 1.0}}, "late"),
                                      region(1, {{later, 1.0}, {later + kSecondNs, 1.0}, {later, 2.0}}, "never"),
                                      region(0, {{later, -1.0}, {later, 99.0}}, "gone")}));
  ASSERT_EQ(imported.left_out.size(), 5U);
  EXPECT_EQ(imported.left_out[0],
            "a.evr: line 4: region part: bad data of a part of the range; expected all of it, as only whole pings can "
            "be bad");
  EXPECT_THAT(imported.left_out[1], HasSubstr("region empty: bad data (empty water)"));
  EXPECT_THAT(imported.left_out[2], HasSubstr("region late: no observation of the survey was made at its time"));
  EXPECT_THAT(imported.left_out[3], HasSubstr("region never: no sample of the survey lies in it"));
  EXPECT_THAT(imported.left_out[4], HasSubstr("region gone: no ping of the survey lies in it"));
  EXPECT_TRUE(imported.schools.empty() && imported.events.empty() && imported.bad.empty());
}

TEST_F(Import, ARegionThatSaysTooLittleOrTooMuchIsRefused) {
  EXPECT_EQ(refused(evr({region(1, box(2, 4, 10.0, 20.0))})),
            "a.evr: line 4: region Region 1: its notes name no fan; name it with --fan");
  EXPECT_THAT(refused(evr({region(1, box(2, 4, 10.0, 20.0), "x", {"fan 6"})})),
              HasSubstr("fan 6: obs-0001 has fans 0 to 5"));
  EXPECT_THAT(refused(evr({region(1, box(2, 4, 10.0, 20.0), "x", {"fan 1", "beams 3 8"})})),
              HasSubstr("beam 8: obs-0001 has beams 0 to 7"));
  const std::string cells = "cells " + text_of(shown_time(2)) + " 9 20 10";
  EXPECT_THAT(refused(evr({region(1, box(2, 4, 10.0, 20.0), "x", {"fan 1", cells})})), HasSubstr("beam 9: "));
  EXPECT_THAT(refused("EVRG 7 13.0\n1\n"), HasSubstr("the file ends"));
}

// Three pings and eight beams are 24 runs; the second region is one too many.
TEST_F(Import, RegionsOfMoreRunsThanMemoryIsMeantForAreRefused) {
  place_.fan = 2;
  const std::string one = region(1, box(2, 4, 10.0, 20.0), "one");
  const std::string two = region(1, box(2, 4, 30.0, 40.0), "two");
  place_.most_runs = 48;
  EXPECT_EQ(refused(evr({one, two})), "");
  place_.most_runs = 47;
  EXPECT_THAT(refused(evr({one, two})), HasSubstr("region two: the regions up to here hold over 47 runs"));
}

}  // namespace
}  // namespace sonar
