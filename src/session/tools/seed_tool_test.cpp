// SPDX-License-Identifier: Apache-2.0
#include "session/tools/seed_tool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/units.h"
#include "session/slices/test_slices.h"

namespace sonar {
namespace {

class SeedToolAtWork : public testing::Test {
 protected:
  void SetUp() override { desk_.look_at_bright(); }

  Workspace& workspace() { return desk_.workspace(); }
  Document& document() { return desk_.document(); }
  const Voxel& bright() { return SlicesDesk::bright().voxel; }
  SeedTool& tool() { return *desk_.desk.seed_tool; }

  /// What grows from the voxel, by the science's own function.
  PingMask fresh(const Voxel& voxel) {
    FilteredPing ping;
    ping.volume = document().staged()->filtered;
    const SeedKey seed = seed_key(*document().shown(), voxel);
    const auto grown = grow_seeds(document().shown()->ground(), ping, std::span(&seed, 1), workspace().growth_curve(),
                                  grow_params(workspace().select.values()));
    return grown ? *grown : PingMask{};
  }
  PingMask mask_of(std::size_t school) {
    const auto* there = in_ping(document().state().schools[school]->masks, document().ping());
    return there == nullptr ? PingMask{} : there->mask;
  }
  std::vector<std::string> journal() {
    std::vector<std::string> commands;
    const auto read = read_journal(document().journal_path().string());
    if (read) {
      for (const JournalLine& line : read->lines) commands.push_back(line.command);
    }
    return commands;
  }
  void press(bool shift = false, bool control = false, bool twice = false) {
    tool().press(bright(), shift, control, twice);
  }
  void set_tolerance(double db) {
    ASSERT_TRUE(workspace().select.set("tolerance_db", db));
    desk_.queue.drain();
  }
  /// As long as parameters rest before a growth is done anew.
  void rest() {
    desk_.desk.pulse.tick(10.0);
    desk_.desk.pulse.tick(10.0 + SeedTool::kRest_s);
    desk_.settle();
  }

  SlicesDesk desk_;
};

TEST_F(SeedToolAtWork, WhatHoversIsWhatAClickSelects) {
  tool().hover(bright(), false, false);
  desk_.settle();
  ASSERT_TRUE(workspace().preview().mask);
  const PingMask hovered = *workspace().preview().mask;
  EXPECT_EQ(workspace().preview().ping_index, document().ping());
  EXPECT_EQ(hovered, fresh(bright()));
  EXPECT_GT(hovered.voxels(), 100U);
  EXPECT_TRUE(journal().empty()) << "looking is no act";
  press();
  desk_.settle();
  ASSERT_EQ(document().state().schools.size(), 1U);
  EXPECT_EQ(mask_of(0), hovered);
  EXPECT_EQ(journal(), (std::vector<std::string>{"grow"}));
  EXPECT_EQ(workspace().school(), (SchoolName{0, 1}));
}

TEST_F(SeedToolAtWork, ThePreviewSaysWhatTheTableOfSchoolsWillSay) {
  tool().hover(bright(), false, false);
  desk_.settle();
  const std::string text = workspace().preview().text;
  press();
  desk_.settle();
  const ProductPtr product = document().product(0);
  ASSERT_TRUE(product);
  ASSERT_EQ(product->school_pings.size(), 1U);
  const SchoolPingRow& row = product->school_pings[0];
  EXPECT_THAT(text, testing::HasSubstr(fmt::format("{:.3g} m\u00B3", row.volume_m3)));
  EXPECT_THAT(text, testing::HasSubstr(fmt::format("mean Sv {:.1f} dB", row.sv_mean_db)));
}

TEST_F(SeedToolAtWork, WhereNothingGrowsItSaysWhy) {
  tool().hover({bright().fan, bright().beam, 0}, false, false);  // in the near field
  desk_.settle();
  EXPECT_FALSE(workspace().preview().mask);
  EXPECT_THAT(workspace().preview().text, testing::HasSubstr("near field"));
  tool().hover(bright(), false, true);
  desk_.settle();
  EXPECT_THAT(workspace().preview().text, testing::HasSubstr("no school is selected"));
  tool().leave();
  EXPECT_EQ(workspace().preview(), Preview{});
}

TEST_F(SeedToolAtWork, AfterAThousandMovesThePreviewIsTheLastOnes) {
  const int samples = document().shown()->sector().range().count;
  for (int i = 0; i < 1000; ++i) tool().hover({bright().fan, bright().beam, (i * 37) % samples}, false, false);
  tool().hover(bright(), false, false);
  desk_.settle();
  ASSERT_TRUE(workspace().preview().mask);
  EXPECT_EQ(*workspace().preview().mask, fresh(bright()));
}

TEST_F(SeedToolAtWork, WhatIsStillOnItsWayIsNotShownAfterThePointerLeft) {
  tool().hover(bright(), false, false);
  tool().wait();
  tool().leave();
  desk_.settle();
  EXPECT_EQ(workspace().preview(), Preview{});
}

TEST_F(SeedToolAtWork, ADoublePressLeavesOneSchoolWithPingsBothWays) {
  ASSERT_TRUE(workspace().select.set("reach_pings", 2));
  press();
  press(false, false, true);  // before the first was carried out
  desk_.settle();
  ASSERT_EQ(document().state().schools.size(), 1U);
  std::vector<std::int64_t> pings;
  for (const auto& there : document().state().schools[0]->masks.pings) pings.push_back(there.ping_index);
  const std::int64_t here = SlicesDesk::bright().ping;
  EXPECT_THAT(pings, testing::Contains(here - 1));
  EXPECT_THAT(pings, testing::Contains(here));
  EXPECT_THAT(pings, testing::Contains(here + 1));
  EXPECT_THAT(pings, testing::Not(testing::Contains(here - 3)));
  EXPECT_THAT(pings, testing::Not(testing::Contains(here + 3)));
  EXPECT_EQ(journal(), (std::vector<std::string>{"grow", "propagate"}));
  document().undo();
  document().undo();
  desk_.settle();
  EXPECT_TRUE(document().state().schools.empty());
}

TEST_F(SeedToolAtWork, ASlowDoublePressIsTheSame) {
  ASSERT_TRUE(workspace().select.set("reach_pings", 2));
  ASSERT_TRUE(workspace().select.set("backwards", false));
  press();
  desk_.settle();
  press(false, false, true);
  desk_.settle();
  ASSERT_EQ(document().state().schools.size(), 1U);
  const auto& pings = document().state().schools[0]->masks.pings;
  EXPECT_EQ(pings.front().ping_index, SlicesDesk::bright().ping) << "only forwards was asked for";
  EXPECT_GT(pings.size(), 1U);
}

TEST_F(SeedToolAtWork, ADoublePressUponNothingLeavesNothing) {
  const Voxel near{bright().fan, bright().beam, 0};
  tool().press(near, false, false, false);
  tool().press(near, false, false, true);
  desk_.settle();
  EXPECT_TRUE(document().state().schools.empty());
  EXPECT_TRUE(journal().empty());
}

TEST_F(SeedToolAtWork, APressUponASchoolSelectsItAndGrowsNothing) {
  press();
  desk_.settle();
  workspace().school.set(std::nullopt);
  tool().hover(bright(), false, false);
  EXPECT_THAT(workspace().preview().text, testing::HasSubstr("click selects, double click follows"));
  press();
  desk_.settle();
  EXPECT_EQ(workspace().school(), (SchoolName{0, 1}));
  EXPECT_EQ(journal().size(), 1U);
  tool().select({bright().fan, bright().beam, 0});
  EXPECT_FALSE(workspace().school()) << "where there is none, none is selected";
}

TEST_F(SeedToolAtWork, ControlTakesAwayWhatHoversAndShiftAddsIt) {
  set_tolerance(12.0);
  press();
  desk_.settle();
  const PingMask whole = mask_of(0);
  document().undo();  // something else stands last
  document().redo();
  desk_.settle();
  workspace().school.set(std::nullopt);  // and nothing is selected: no school grows anew
  set_tolerance(4.0);
  workspace().school.set(SchoolName{0, 1});
  tool().hover(bright(), false, true);
  desk_.settle();
  ASSERT_TRUE(workspace().preview().mask);
  const PingMask core = *workspace().preview().mask;
  EXPECT_EQ(core.runs, fresh(bright()).runs);
  EXPECT_LT(core.voxels(), whole.voxels());
  press(false, true);
  desk_.settle();
  ASSERT_EQ(document().state().schools.size(), 1U);
  EXPECT_EQ(mask_of(0), subtract(whole, core));
  press(true);
  desk_.settle();
  EXPECT_EQ(mask_of(0).runs, whole.runs);
  EXPECT_EQ(document().state().schools.size(), 1U);
}

TEST_F(SeedToolAtWork, AChangeOfToleranceGrowsTheLastSchoolAnew) {
  press();
  desk_.settle();
  const PingMask at_ten = mask_of(0);
  tool().leave();
  for (const double db : {9.0, 8.0, 7.0, 6.0}) {
    set_tolerance(db);
    desk_.desk.pulse.tick(db);  // not yet at rest
    desk_.desk.pulse.tick(db + 0.5 * SeedTool::kRest_s);
  }
  desk_.settle();
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
  EXPECT_FALSE(desk_.desk.pulse.running());
  EXPECT_FALSE(workspace().preview().mask);
  document().undo();
  desk_.settle();
  EXPECT_TRUE(document().state().schools.empty()) << "undo knows one growth";
}

TEST_F(SeedToolAtWork, WhatIsDoneNextComesAfterTheGrowthAnew) {
  press();
  desk_.settle();
  set_tolerance(6.0);
  tool().press({bright().fan, bright().beam, 0}, false, false, false);  // grows nothing
  desk_.settle();
  EXPECT_EQ(mask_of(0), fresh(bright()));
  EXPECT_EQ(journal(), (std::vector<std::string>{"grow", "undo", "grow"}));
}

TEST_F(SeedToolAtWork, AToleranceThatMovesAfterSomethingElseWasDoneChangesOnlyWhatIsSelected) {
  press();
  desk_.settle();
  const PingMask before = mask_of(0);
  document().undo();
  document().redo();
  desk_.settle();
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
  desk_.settle();
  EXPECT_EQ(mask_of(0), before) << "an act of its own";
}

/// A school that was clicked twice: grown and carried both ways.
class SeedToolOnFollowed : public SeedToolAtWork {
 protected:
  void SetUp() override {
    SeedToolAtWork::SetUp();
    ASSERT_TRUE(workspace().select.set("reach_pings", 2));
    press();
    press(false, false, true);
    desk_.settle();
    tool().leave();
    ASSERT_EQ(journal(), (std::vector<std::string>{"grow", "propagate"}));
  }
  std::vector<SchoolMasks::InPing> pings() { return document().state().schools.at(0)->masks.pings; }
  /// The masks, and the journal's file read by itself gives the same.
  void expect_same(const std::vector<SchoolMasks::InPing>& wanted, const char* why) {
    const auto read = read_journal(document().journal_path().string());
    ASSERT_TRUE(read);
    const JournalState replayed = fold(effective_lines(read->lines), {}, document().shown()->ground());
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
    const CommandGround& ground = document().shown()->ground();
    const TimeNs time = ground.times[static_cast<std::size_t>(SlicesDesk::bright().ping)];
    on.school = SchoolKey{time, grow.seeds[0].channel, grow.seeds[0].sample};
    const std::vector<JournalLine> lines{line_of({1, 0, "", time, grow}), line_of({2, 0, "", time, on})};
    const JournalState state = fold(lines, {}, ground);
    return state.schools.at(0)->masks.pings;
  }
};

TEST_F(SeedToolOnFollowed, ToleranceGrowsItAnewAndCarriesItOnInOneStep) {
  const auto before = pings();
  for (const double db : {9.0, 7.0, 6.0}) set_tolerance(db);
  desk_.settle();
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
  // The slider goes on: still one step.
  set_tolerance(8.0);
  rest();
  expect_same(double_pressed(8.0), "the slider went on");
  EXPECT_EQ(workspace().school(), (SchoolName{0, 1}));
  document().undo();
  desk_.settle();
  expect_same(before, "one step back");
  document().redo();
  desk_.settle();
  expect_same(double_pressed(8.0), "and forth");
}

TEST_F(SeedToolOnFollowed, AfterADecisionAndFromAnotherPingItStillGrowsAnew) {
  Decision decision;
  decision.school = key_of(document().state().schools[0]->masks, document().shown()->ground());
  decision.status = "accepted";
  document().act(DecideCommand{{decision}, {}});
  document().look_at(document().ping() + 1);
  desk_.settle();
  set_tolerance(6.0);
  desk_.settle();
  EXPECT_THAT(workspace().preview().text, testing::HasSubstr("grows anew from ping"));
  rest();
  expect_same(double_pressed(6.0), "from the seed that it was made from");
  EXPECT_EQ(document().state().schools[0]->masks.decided.status, "accepted");
}

TEST_F(SeedToolOnFollowed, WhatWasShapedAfterwardsStays) {
  EraseCommand erase;
  erase.runs = {{seed_key(*document().shown(), bright()).channel, bright().sample + 1, 1}};
  document().act(erase);
  desk_.settle();
  const auto before = pings();
  set_tolerance(6.0);
  rest();
  expect_same(before, "shaped by hand");
  EXPECT_THAT(workspace().preview().text, testing::HasSubstr("was shaped by hand"));
}

/// A school that was found without a human, selected in a ping that it is in.
class SeedToolOnDetected : public SeedToolAtWork {
 protected:
  void SetUp() override {
    SeedToolAtWork::SetUp();
    document().detect({0});
    desk_.settle();
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
  desk_.settle();
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
  // The slider goes on: still one act.
  set_tolerance(8.0);
  rest();
  EXPECT_EQ(mask_of(school_), from_loudest(found));
  EXPECT_EQ(workspace().school(), (SchoolName{0, number_}));
  document().undo();
  desk_.settle();
  EXPECT_EQ(mask_of(school_), found);
  EXPECT_EQ(decided().status, "unreviewed");
}

TEST_F(SeedToolOnDetected, ToleranceLeavesWhatAHumanShapedAndSaysSo) {
  press(true);  // joins it
  desk_.settle();
  document().undo();
  document().redo();
  desk_.settle();
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

TEST_F(SeedToolAtWork, ToleranceGrowsWhatIsHoveredAnew) {
  tool().hover(bright(), false, false);
  desk_.settle();
  const std::size_t at_ten = workspace().preview().mask->voxels();
  set_tolerance(5.0);
  desk_.settle();
  EXPECT_EQ(*workspace().preview().mask, fresh(bright()));
  EXPECT_LT(workspace().preview().mask->voxels(), at_ten);
}

TEST_F(SeedToolAtWork, ThePreviewFollowsThePingUnderThePointer) {
  tool().hover(bright(), false, false);
  desk_.settle();
  document().look_at(document().ping() + 1);
  desk_.settle();
  EXPECT_EQ(workspace().preview().ping_index, document().ping());
  EXPECT_EQ(workspace().preview().mask ? *workspace().preview().mask : PingMask{}, fresh(bright()));
}

}  // namespace
}  // namespace sonar
