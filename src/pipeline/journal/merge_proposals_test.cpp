// SPDX-License-Identifier: Apache-2.0
// Constructed states in the small sea: what is proposed follows from where the blocks were laid.
#include "pipeline/journal/merge_proposals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/commands/test_context.h"

namespace sonar {
namespace {

using test::Block;
using test::kA;
using test::kB;
using testing::ElementsAre;
using testing::IsEmpty;

class MergeProposals : public testing::Test {
 protected:
  MergeProposals() {
    limits_.track.max_lost_pings = 2;
    limits_.placement = [](std::int64_t) {
      Placement still;
      still.transducer = {60.0, 5.0};
      return still;
    };
  }
  /// A school that is one block in pings first to last.
  void lay(const Block& block, std::int64_t first, std::int64_t last, const char* status = "unreviewed") {
    SchoolMasks school;
    for (std::int64_t ping = first; ping <= last; ++ping)
      school.pings.push_back({ping, test::block_mask(block), -50.0});
    school.decided.status = status;
    schools_.push_back(std::move(school));
  }
  std::vector<MergeProposal> proposed(const std::set<std::int64_t>& of = {}) {
    return merge_proposals(state(), sea_.context(), limits_, of);
  }
  JournalState state() { return state_of_detected(schools_); }

  static Block moved(Block block, int samples) {
    block.first_sample += samples;
    block.last_sample += samples;
    return block;
  }

  test::SmallSea sea_;
  ProposalLimits limits_;
  std::vector<SchoolMasks> schools_;
};

TEST_F(MergeProposals, SchoolsApartAreTwo) {
  lay(kA, 0, 4);
  lay(kB, 0, 4);
  EXPECT_THAT(proposed(), IsEmpty());
}

TEST_F(MergeProposals, SchoolsThatTouchInAPingMayBeOne) {
  lay(kA, 0, 4);
  lay(moved(kA, 8), 2, 6);  // A ends with sample 37, this begins with 38
  EXPECT_THAT(proposed(), ElementsAre(MergeProposal{1, 2, 2, 2}));
  EXPECT_TRUE(proposed().front().touching());
}

TEST_F(MergeProposals, OneSampleBetweenThemIsEnoughToTellThemApart) {
  lay(kA, 0, 4);
  lay(moved(kA, 9), 0, 4);
  EXPECT_THAT(proposed(), IsEmpty());
}

TEST_F(MergeProposals, TouchingCountsOverFansAndBeamsToo) {
  lay({1, 2, 2, 4, 30, 37}, 0, 3);
  lay({3, 4, 2, 4, 30, 37}, 0, 3);  // the next fan
  EXPECT_EQ(proposed().size(), 1U);
  schools_.pop_back();
  lay({1, 2, 5, 6, 30, 37}, 0, 3);  // the next beam
  EXPECT_EQ(proposed().size(), 1U);
  schools_.pop_back();
  // The last beam of a fan and the first of the next are neighbours in the list of rows, and nowhere else.
  schools_.clear();
  lay({1, 1, 7, 7, 30, 37}, 0, 3);
  lay({2, 2, 0, 0, 30, 37}, 0, 3);
  EXPECT_THAT(proposed(), IsEmpty());
}

TEST_F(MergeProposals, ACornerIsNoMoreThanAGlance) {
  lay({1, 3, 2, 4, 30, 49}, 0, 3);  // 9 beams of 20 samples
  lay({3, 5, 4, 6, 50, 69}, 0, 3);  // they meet in one voxel's face
  EXPECT_THAT(proposed(), IsEmpty());
}

TEST_F(MergeProposals, WhatBeginsWhereTheOtherEndsMayBeOne) {
  lay(kA, 0, 3);
  lay(kA, 5, 8);
  EXPECT_THAT(proposed(), ElementsAre(MergeProposal{1, 2, 3, 5}));
  EXPECT_FALSE(proposed().front().touching());
}

TEST_F(MergeProposals, NotLongerLostThanTheTrackerWaits) {
  lay(kA, 0, 2);
  lay(kA, 6, 8);  // three pings are between them, two may be
  EXPECT_THAT(proposed(), IsEmpty());
  limits_.track.max_lost_pings = 3;
  EXPECT_EQ(proposed().size(), 1U);
  limits_.track.max_lost_s = 7.0;  // the pings are two seconds apart: eight have passed
  EXPECT_THAT(proposed(), IsEmpty());
}

TEST_F(MergeProposals, NotFartherThanTheTrackerLooks) {
  limits_.track.initial_speed_mps = 0.1;
  lay(kA, 0, 3);
  lay(moved(kA, 30), 5, 8);  // 15 m on, while A stood still
  EXPECT_THAT(proposed(), IsEmpty());
}

TEST_F(MergeProposals, AShipThatSailsOnMovesThePlaceAndNotTheSchool) {
  // A stays where it is in the sector, and the ship makes 300 m between the two: it is other water.
  limits_.placement = [](std::int64_t ping) {
    Placement sailing;
    sailing.transducer = {60.0 + (ping > 3 ? 300.0 / 111'000.0 : 0.0), 5.0};
    return sailing;
  };
  lay(kA, 0, 3);
  lay(kA, 5, 8);
  EXPECT_THAT(proposed(), IsEmpty());
}

TEST_F(MergeProposals, RejectedSchoolsAreInNoPair) {
  lay(kA, 0, 4);
  lay(moved(kA, 8), 2, 6, "rejected");
  lay(kB, 0, 2);
  lay(kB, 4, 6, "rejected");
  EXPECT_THAT(proposed(), IsEmpty());
}

TEST_F(MergeProposals, OnlyPairsOfTheSchoolsThatAreAskedFor) {
  lay(kA, 0, 4);
  lay(moved(kA, 8), 2, 6);
  lay({1, 3, 6, 7, 30, 37}, 0, 4);
  lay({1, 3, 6, 7, 38, 45}, 0, 4);
  EXPECT_EQ(proposed().size(), 2U);
  EXPECT_THAT(proposed({4}), ElementsAre(MergeProposal{3, 4, 0, 0}));
}

TEST_F(MergeProposals, HoldsAsLongAsNeitherMaskChangesWhereTheyMeet) {
  lay(kA, 0, 4);
  lay(moved(kA, 8), 2, 6);
  const JournalState told = state();
  const MergeProposal one = proposed().front();
  schools_[0].pings.back().mask = test::block_mask(kB);  // another ping
  EXPECT_TRUE(still_holds(one, told, state()));
  schools_[0].decided.status = "rejected";
  EXPECT_FALSE(still_holds(one, told, state()));
  schools_[0].decided.status = "accepted";
  schools_[0].pings[2].mask.runs.pop_back();
  EXPECT_FALSE(still_holds(one, told, state()));
  schools_.pop_back();
  EXPECT_FALSE(still_holds(one, told, state()));
}

}  // namespace
}  // namespace sonar
