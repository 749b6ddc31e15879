// SPDX-License-Identifier: Apache-2.0
// What is selected grows anew while the tolerance moves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "session/tools/test_seed_tool.h"

namespace sonar {
namespace {

class SeedToolAnew : public testing::Test, protected SeedToolApp {
 protected:
  void SetUp() override { app_.look_at_bright(); }
  void undo() {
    document().undo();
    app_.settle();
  }
  void redo() {
    document().redo();
    app_.settle();
  }
  double tolerance_db() { return workspace().select.values().tolerance_db; }
};

TEST_F(SeedToolAnew, AChangeOfToleranceGrowsTheLastSchoolAnew) {
  press();
  app_.settle();
  const PingMask at_ten = mask_of(0);
  tool().leave();
  for (const double db : {9.0, 8.0, 7.0, 6.0}) {
    set_tolerance(db);
    app_.app.animations.tick(db);  // not yet at rest
    app_.app.animations.tick(db + 0.5 * SeedTool::kRest_s);
  }
  app_.settle();
  ASSERT_TRUE(workspace().preview().mask);
  EXPECT_EQ(workspace().preview().instead_of, 1);
  EXPECT_EQ(*workspace().preview().mask, fresh(bright()));
  EXPECT_EQ(mask_of(0), at_ten) << "so far it is only looked at";
  rest();
  ASSERT_EQ(document().state().schools.size(), 1U);
  EXPECT_EQ(mask_of(0), fresh(bright()));
  EXPECT_LT(mask_of(0).voxels(), at_ten.voxels());
  EXPECT_EQ(document().state().schools[0]->number, 1);
  EXPECT_EQ(journal(), (std::vector<std::string>{"grow", "undo", "grow"}));
  EXPECT_FALSE(app_.app.animations.running());
  EXPECT_FALSE(workspace().preview().mask);
  EXPECT_EQ(document().choices().undo_text, "Undo grow school 1 anew");
  undo();
  EXPECT_EQ(mask_of(0), at_ten) << "as it was clicked";
  EXPECT_EQ(tolerance_db(), 10.0);
  EXPECT_FALSE(app_.app.animations.running()) << "the slider that goes back grows nothing";
  undo();
  EXPECT_TRUE(document().state().schools.empty()) << "the click is a step of its own";
  redo();
  EXPECT_EQ(mask_of(0), at_ten);
  redo();
  EXPECT_EQ(tolerance_db(), 6.0);
  EXPECT_EQ(mask_of(0), fresh(bright()));
  EXPECT_TRUE(document().choices().redo_text.empty());
}

TEST_F(SeedToolAnew, WhileAHandHoldsTheSliderNothingIsDone) {
  press();
  app_.settle();
  tool().leave();
  workspace().select.hold(true);
  for (const double db : {8.0, 6.0, 7.0}) {
    set_tolerance(db);
    rest();
    EXPECT_EQ(journal().size(), 1U) << db;
  }
  workspace().select.hold(false);
  rest();
  EXPECT_EQ(journal(), (std::vector<std::string>{"grow", "undo", "grow"}));
  EXPECT_EQ(mask_of(0), fresh(bright()));
  undo();
  EXPECT_EQ(tolerance_db(), 10.0) << "one step, however the hand went";
}

TEST_F(SeedToolAnew, EachDragIsAStepAndAllComeBackAlsoFromTheFile) {
  press();
  app_.settle();
  tool().leave();
  std::vector<PingMask> masks{mask_of(0)};
  for (const double db : {8.0, 6.0}) {
    set_tolerance(db);
    rest();
    masks.push_back(mask_of(0));
  }
  const auto from_file = [&] {
    const auto read = read_journal(document().journal_path().string());
    const JournalState state = fold(effective_lines(read->lines), {}, document().shown()->context());
    const auto* there = state.schools.empty() ? nullptr : in_ping(state.schools[0]->masks, document().ping());
    return there == nullptr ? PingMask{} : there->mask;
  };
  const std::vector<double> tolerances{10.0, 8.0, 6.0};
  for (const std::size_t at : {1U, 0U}) {
    undo();
    EXPECT_EQ(mask_of(0), masks[at]) << at;
    EXPECT_EQ(from_file(), masks[at]) << at;
    EXPECT_EQ(tolerance_db(), tolerances[at]);
  }
  undo();
  EXPECT_TRUE(from_file().empty());
  for (const std::size_t at : {0U, 1U, 2U}) {
    redo();
    EXPECT_EQ(mask_of(0), masks[at]) << at;
    EXPECT_EQ(from_file(), masks[at]) << at;
    EXPECT_EQ(document().state().schools.size(), 1U);
  }
  undo();
  undo();
  EXPECT_EQ(mask_of(0), masks[0]);
}

TEST_F(SeedToolAnew, ADragAfterAnAdditionBringsTheAdditionBack) {
  press();
  app_.settle();
  const PingMask first = mask_of(0);
  set_tolerance(3.0);
  rest();
  const PingMask small = mask_of(0);
  ASSERT_LT(small.voxels(), first.voxels());
  set_tolerance(9.0);
  rest();
  const PingMask before = mask_of(0);
  tool().press(bright(), true, false, false);  // joins what it grows to the school
  app_.settle();
  const PingMask joined = mask_of(0);
  tool().leave();
  set_tolerance(12.0);
  rest();
  EXPECT_EQ(mask_of(0), fresh(bright())) << "the wider growth holds the smaller";
  undo();
  EXPECT_EQ(mask_of(0), joined);
  EXPECT_EQ(tolerance_db(), 9.0);
  undo();
  EXPECT_EQ(mask_of(0), before);
}

TEST_F(SeedToolAnew, WhatIsDoneNextComesAfterTheGrowthAnew) {
  press();
  app_.settle();
  set_tolerance(6.0);
  tool().press({bright().fan, bright().beam, 0}, false, false, false);  // grows nothing
  app_.settle();
  EXPECT_EQ(mask_of(0), fresh(bright()));
  EXPECT_EQ(journal(), (std::vector<std::string>{"grow", "undo", "grow"}));
}

TEST_F(SeedToolAnew, AToleranceThatMovesAfterSomethingElseWasDoneChangesOnlyWhatIsSelected) {
  press();
  app_.settle();
  const PingMask before = mask_of(0);
  document().undo();
  document().redo();
  app_.settle();
  workspace().school.set(std::nullopt);
  set_tolerance(6.0);
  rest();
  EXPECT_EQ(mask_of(0), before);
  EXPECT_EQ(journal(), (std::vector<std::string>{"grow", "undo", "redo"}));
  tool().leave();
  workspace().school.set(SchoolName{0, 1});
  set_tolerance(7.0);
  rest();
  EXPECT_EQ(mask_of(0), fresh(bright()));
  EXPECT_EQ(journal().size(), 4U);
  document().undo();
  app_.settle();
  EXPECT_EQ(mask_of(0), before) << "an act of its own";
}

/// A school that was clicked twice: grown and carried both ways.
class SeedToolOnFollowed : public SeedToolAnew {
 protected:
  void SetUp() override {
    SeedToolAnew::SetUp();
    ASSERT_TRUE(workspace().select.set("reach_pings", 2));
    press();
    press(false, false, true);
    app_.settle();
    tool().leave();
    ASSERT_EQ(journal(), (std::vector<std::string>{"grow", "propagate"}));
  }
  std::vector<SchoolMasks::InPing> pings() { return document().state().schools.at(0)->masks.pings; }
  /// The masks, and the journal's file read by itself gives the same.
  void expect_same(const std::vector<SchoolMasks::InPing>& wanted, const char* why) {
    const auto read = read_journal(document().journal_path().string());
    ASSERT_TRUE(read);
    const JournalState replayed = fold(effective_lines(read->lines), {}, document().shown()->context());
    ASSERT_EQ(pings().size(), wanted.size()) << why;
    ASSERT_EQ(replayed.schools.at(0)->masks.pings.size(), wanted.size()) << why;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      EXPECT_EQ(pings()[i].ping_index, wanted[i].ping_index) << why;
      EXPECT_EQ(pings()[i].mask, wanted[i].mask) << why;
      EXPECT_EQ(replayed.schools[0]->masks.pings[i].mask, wanted[i].mask) << why;
    }
  }
  /// What a double press under this tolerance gives where nothing was before.
  std::vector<SchoolMasks::InPing> double_pressed(double db) {
    GrowCommand grow;
    grow.grow = grow_params(workspace().select.values());
    grow.grow.tolerance_db = db;
    grow.growth_curve = workspace().growth_curve();
    grow.seeds = {seed_key(*document().shown(), bright())};
    PropagateCommand on = propagation_as_set(workspace());
    on.grow = grow.grow;
    on.tracked.tolerance_db = db;
    const CommandContext& context = document().shown()->context();
    const TimeNs time = context.times[static_cast<std::size_t>(SlicesApp::bright().ping)];
    on.school = SchoolKey{time, grow.seeds[0].channel, grow.seeds[0].sample};
    const std::vector<JournalLine> lines{line_of({1, 0, "", time, grow}), line_of({2, 0, "", time, on})};
    const JournalState state = fold(lines, {}, context);
    return state.schools.at(0)->masks.pings;
  }
};

TEST_F(SeedToolOnFollowed, ToleranceGrowsItAnewAndCarriesItOnInOneStep) {
  const auto before = pings();
  for (const double db : {9.0, 7.0, 6.0}) set_tolerance(db);
  app_.settle();
  ASSERT_TRUE(workspace().preview().mask) << "seen at once, in the ping that is looked at";
  EXPECT_EQ(*workspace().preview().mask, fresh(bright()));
  EXPECT_EQ(workspace().preview().instead_of, 1);
  expect_same(before, "so far it is only looked at");
  rest();
  EXPECT_EQ(mask_of(0), fresh(bright()));
  expect_same(double_pressed(6.0), "as a double press under this tolerance gives it");
  SchoolMasks earlier;
  earlier.pings = before;
  EXPECT_LT(mask_of(0).voxels(), in_ping(earlier, document().ping())->mask.voxels());
  EXPECT_EQ(journal(), (std::vector<std::string>{"grow", "propagate", "grow", "propagate"}));
  EXPECT_EQ(document().choices().undo_text, "Undo grow school 1 anew");
  // The next drag is a step of its own.
  set_tolerance(8.0);
  rest();
  expect_same(double_pressed(8.0), "the next drag");
  EXPECT_EQ(workspace().school(), (SchoolName{0, 1}));
  undo();
  expect_same(double_pressed(6.0), "one drag back");
  EXPECT_EQ(tolerance_db(), 6.0);
  undo();
  expect_same(before, "two drags back");
  EXPECT_EQ(tolerance_db(), 10.0);
  redo();
  redo();
  expect_same(double_pressed(8.0), "and forth");
  EXPECT_EQ(tolerance_db(), 8.0);
}

TEST_F(SeedToolOnFollowed, AfterADecisionAndFromAnotherPingItStillGrowsAnew) {
  Decision decision;
  decision.school = key_of(document().state().schools[0]->masks, document().shown()->context());
  decision.status = "accepted";
  document().act(DecideCommand{{decision}, {}});
  document().look_at(document().ping() + 1);
  app_.settle();
  set_tolerance(6.0);
  app_.settle();
  EXPECT_THAT(workspace().preview().text, testing::HasSubstr("grows anew from ping"));
  rest();
  expect_same(double_pressed(6.0), "from the seed that it was made from");
  EXPECT_EQ(document().state().schools[0]->masks.decided.status, "accepted");
}

TEST_F(SeedToolOnFollowed, WhatWasShapedAfterwardsStays) {
  EraseCommand erase;
  erase.runs = {{seed_key(*document().shown(), bright()).channel, bright().sample + 1, 1}};
  document().act(erase);
  app_.settle();
  const auto before = pings();
  set_tolerance(6.0);
  rest();
  expect_same(before, "shaped by hand");
  EXPECT_THAT(workspace().preview().text, testing::HasSubstr("was shaped by hand"));
}

/// A school that was found without a human, selected in a ping that it is in.
class SeedToolOnDetected : public SeedToolAnew {
 protected:
  void SetUp() override {
    SeedToolAnew::SetUp();
    document().detect({0});
    app_.settle();
    const auto under = tool().school_under(bright());
    ASSERT_TRUE(under);
    school_ = *under;
    number_ = document().state().schools[school_]->number;
    workspace().school.set(SchoolName{0, number_});
  }
  /// What the school's loudest voxel gives, by the science's own function.
  PingMask from_loudest(const PingMask& mask) {
    const Volume& filtered = *document().staged()->filtered;
    Voxel loudest;
    int most = kNoData;
    const int beams = document().shown()->sector().beams();
    for (const sonar::Run& run : mask.runs) {
      for (int s = run.first_sample; s < run.end(); ++s) {
        const Voxel voxel{run.row / beams, run.row % beams, s};
        const int count = filtered.counts(voxel.fan, voxel.beam, voxel.sample);
        if (count > most) loudest = voxel;
        most = std::max(most, count);
      }
    }
    return fresh(loudest);
  }
  const SchoolRow& decided() { return document().state().schools[school_]->masks.decided; }

  std::size_t school_ = 0;
  std::int64_t number_ = 0;
};

TEST_F(SeedToolOnDetected, ToleranceGrowsItAnewInThisPingAsOneActThatIsUndone) {
  const PingMask found = mask_of(school_);
  const JournalStatePtr before = state_of(document(), 0);
  const std::size_t lines = journal().size();
  for (const double db : {9.0, 6.0, 4.0}) set_tolerance(db);
  app_.settle();
  EXPECT_EQ(workspace().preview().instead_of, number_);
  ASSERT_TRUE(workspace().preview().mask);
  const PingMask wanted = from_loudest(found);
  EXPECT_EQ(*workspace().preview().mask, wanted);
  EXPECT_EQ(mask_of(school_), found) << "so far it is only looked at";
  rest();
  EXPECT_EQ(mask_of(school_), wanted);
  EXPECT_NE(wanted.runs, found.runs);
  EXPECT_EQ(decided().status, "corrected");
  EXPECT_EQ(journal().size(), lines + 1);
  EXPECT_EQ(document().choices().undo_text, fmt::format("Undo grow school {} anew", number_));
  const auto& pings = document().state().schools[school_]->masks.pings;
  ASSERT_EQ(pings.size(), before->schools[school_]->masks.pings.size());
  for (std::size_t i = 0; i < pings.size(); ++i) {
    if (pings[i].ping_index == document().ping()) continue;
    EXPECT_EQ(pings[i].mask, before->schools[school_]->masks.pings[i].mask) << "other pings stay";
  }
  // The next drag is an act of its own.
  set_tolerance(8.0);
  rest();
  EXPECT_EQ(mask_of(school_), from_loudest(found));
  EXPECT_EQ(workspace().school(), (SchoolName{0, number_}));
  undo();
  EXPECT_EQ(mask_of(school_), wanted);
  EXPECT_EQ(tolerance_db(), 4.0);
  undo();
  EXPECT_EQ(mask_of(school_), found);
  EXPECT_EQ(tolerance_db(), 10.0);
  EXPECT_EQ(decided().status, "unreviewed");
}

TEST_F(SeedToolOnDetected, ToleranceLeavesWhatAHumanShapedAndSaysSo) {
  press(true);  // joins it
  app_.settle();
  document().undo();
  document().redo();
  app_.settle();
  const PingMask shaped = mask_of(school_);
  tool().leave();
  set_tolerance(4.0);
  rest();
  EXPECT_EQ(mask_of(school_), shaped);
  EXPECT_THAT(workspace().preview().text, testing::HasSubstr("was shaped by hand"));
}

TEST_F(SeedToolOnDetected, WithThePointerElsewhereToleranceIsThatOfTheNextClick) {
  const PingMask found = mask_of(school_);
  tool().hover({bright().fan, bright().beam, 0}, false, false);
  set_tolerance(4.0);
  rest();
  EXPECT_EQ(mask_of(school_), found);
}

TEST_F(SeedToolAnew, ToleranceGrowsWhatIsHoveredAnew) {
  tool().hover(bright(), false, false);
  app_.settle();
  const std::size_t at_ten = workspace().preview().mask->voxels();
  set_tolerance(5.0);
  app_.settle();
  EXPECT_EQ(*workspace().preview().mask, fresh(bright()));
  EXPECT_LT(workspace().preview().mask->voxels(), at_ten);
}

}  // namespace
}  // namespace sonar
