// SPDX-License-Identifier: Apache-2.0
#include "session/tools/seed_tool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/units.h"
#include "session/tools/test_seed_tool.h"

namespace sonar {
namespace {

class SeedToolAtWork : public testing::Test, protected SeedToolApp {
 protected:
  void SetUp() override { app_.look_at_bright(); }
};

TEST_F(SeedToolAtWork, WhatHoversIsWhatAClickSelects) {
  tool().hover(bright(), false, false);
  app_.settle();
  ASSERT_TRUE(workspace().preview().mask);
  const PingMask hovered = *workspace().preview().mask;
  EXPECT_EQ(workspace().preview().ping_index, document().ping());
  EXPECT_EQ(hovered, fresh(bright()));
  EXPECT_GT(hovered.voxels(), 100U);
  EXPECT_TRUE(journal().empty()) << "looking is no act";
  press();
  app_.settle();
  ASSERT_EQ(document().state().schools.size(), 1U);
  EXPECT_EQ(mask_of(0), hovered);
  EXPECT_EQ(journal(), (std::vector<std::string>{"grow"}));
  EXPECT_EQ(workspace().school(), (SchoolName{0, 1}));
}

TEST_F(SeedToolAtWork, ThePreviewSaysWhatTheTableOfSchoolsWillSay) {
  tool().hover(bright(), false, false);
  app_.settle();
  const std::string text = workspace().preview().text;
  press();
  app_.settle();
  const ProductPtr product = document().product(0);
  ASSERT_TRUE(product);
  ASSERT_EQ(product->school_pings.size(), 1U);
  const SchoolPingRow& row = product->school_pings[0];
  EXPECT_THAT(text, testing::HasSubstr(fmt::format("{:.3g} m\u00B3", row.volume_m3)));
  EXPECT_THAT(text, testing::HasSubstr(fmt::format("mean Sv {:.1f} dB", row.sv_mean_db)));
}

TEST_F(SeedToolAtWork, WhereNothingGrowsItSaysWhy) {
  tool().hover({bright().fan, bright().beam, 0}, false, false);  // in the near field
  app_.settle();
  EXPECT_FALSE(workspace().preview().mask);
  EXPECT_THAT(workspace().preview().text, testing::HasSubstr("near field"));
  tool().hover(bright(), false, true);
  app_.settle();
  EXPECT_THAT(workspace().preview().text, testing::HasSubstr("no school is selected"));
  tool().leave();
  EXPECT_EQ(workspace().preview(), Preview{});
}

// Most of the water is too weak: what is said there is read most often of all.
TEST_F(SeedToolAtWork, OverPlainWaterItSaysSoInTheGrowthCurvesTermsAndAClickWritesNothing) {
  const auto counts = document().staged()->filtered->counts.view();
  const auto flags = document().staged()->filtered->flags.view();
  const int row = bright().fan * document().shown()->grid().beams() + bright().beam;
  const auto samples = counts.row(row);
  std::size_t sample = 0;
  const auto weak = [&](std::size_t s) {
    return samples[s] != kNoData && !any(flags.row(row)[s] & kNeverMember) &&
           workspace().growth_curve().opacity(db_from_counts(samples[s])) == 0.0;
  };
  while (sample < samples.size() && !weak(sample)) ++sample;
  ASSERT_LT(sample, samples.size());
  const Voxel voxel{bright().fan, bright().beam, static_cast<int>(sample)};
  const std::string said =
      fmt::format("too weak to grow from: the growth curve is 0 at {:.1f} dB", db_from_counts(samples[sample]));
  tool().hover(voxel, false, false);
  app_.settle();
  EXPECT_EQ(workspace().preview().text, said);
  tool().press(voxel, false, false, false);
  app_.settle();
  EXPECT_EQ(document().notices().back(), said);
  EXPECT_TRUE(journal().empty());
}

TEST_F(SeedToolAtWork, AfterAThousandMovesThePreviewIsTheLastOnes) {
  const int samples = document().shown()->sector().range().count;
  for (int i = 0; i < 1000; ++i) tool().hover({bright().fan, bright().beam, (i * 37) % samples}, false, false);
  tool().hover(bright(), false, false);
  app_.settle();
  ASSERT_TRUE(workspace().preview().mask);
  EXPECT_EQ(*workspace().preview().mask, fresh(bright()));
}

TEST_F(SeedToolAtWork, WhatIsStillOnItsWayIsNotShownAfterThePointerLeft) {
  tool().hover(bright(), false, false);
  tool().wait();
  tool().leave();
  app_.settle();
  EXPECT_EQ(workspace().preview(), Preview{});
}

// The same command by another hand comes first: the tool's own is refused, and what the other made is not the tool's.
TEST_F(SeedToolAtWork, TheSameActByAnotherHandIsNotTakenForItsOwn) {
  GrowCommand same;
  same.grow = grow_params(workspace().select.values());
  same.growth_curve = workspace().growth_curve();
  same.seeds = {seed_key(*document().shown(), bright())};
  document().act(same);
  press();
  app_.settle();
  EXPECT_EQ(journal(), (std::vector<std::string>{"grow"}));
  EXPECT_EQ(document().state().schools.size(), 1U);
  EXPECT_FALSE(workspace().school());
  EXPECT_THAT(document().notices().back(), testing::HasSubstr("belong to other schools"));
}

TEST_F(SeedToolAtWork, WhatIsDoneInsteadOfALineIsRefusedWhereAnotherHasComeSince) {
  press();
  app_.settle();
  const std::int64_t grown = document().choices().lines->back().n;
  const PingMask before = mask_of(0);
  Decision decision;
  decision.school = key_of(document().state().schools[0]->masks, document().shown()->context());
  decision.species = "herring";
  document().act(DecideCommand{{decision}, {}});
  const auto step = std::make_shared<JournalStep>();
  step->instead_of = grown;
  GrowCommand wider;
  wider.seeds = {seed_key(*document().shown(), bright())};
  const ActTicket ticket = document().act(0, document().ping(), wider, step);
  app_.settle();
  EXPECT_EQ(document().choices().ticket, ticket);
  EXPECT_EQ(document().choices().done_line, 0);
  EXPECT_THAT(document().choices().failure, testing::HasSubstr("something else was done meanwhile"));
  EXPECT_EQ(journal(), (std::vector<std::string>{"grow", "species"}));
  EXPECT_EQ(mask_of(0), before);
}

TEST_F(SeedToolAtWork, ADoublePressLeavesOneSchoolWithPingsBothWays) {
  ASSERT_TRUE(workspace().select.set("reach_pings", 2));
  press();
  press(false, false, true);  // before the first was carried out
  app_.settle();
  ASSERT_EQ(document().state().schools.size(), 1U);
  std::vector<std::int64_t> pings;
  for (const auto& there : document().state().schools[0]->masks.pings) pings.push_back(there.ping_index);
  const std::int64_t here = SlicesApp::bright().ping;
  EXPECT_THAT(pings, testing::Contains(here - 1));
  EXPECT_THAT(pings, testing::Contains(here));
  EXPECT_THAT(pings, testing::Contains(here + 1));
  EXPECT_THAT(pings, testing::Not(testing::Contains(here - 3)));
  EXPECT_THAT(pings, testing::Not(testing::Contains(here + 3)));
  EXPECT_EQ(journal(), (std::vector<std::string>{"grow", "propagate"}));
  document().undo();
  document().undo();
  app_.settle();
  EXPECT_TRUE(document().state().schools.empty());
}

TEST_F(SeedToolAtWork, ASlowDoublePressIsTheSame) {
  ASSERT_TRUE(workspace().select.set("reach_pings", 2));
  ASSERT_TRUE(workspace().select.set("backwards", false));
  press();
  app_.settle();
  press(false, false, true);
  app_.settle();
  ASSERT_EQ(document().state().schools.size(), 1U);
  const auto& pings = document().state().schools[0]->masks.pings;
  EXPECT_EQ(pings.front().ping_index, SlicesApp::bright().ping) << "only forwards was asked for";
  EXPECT_GT(pings.size(), 1U);
}

TEST_F(SeedToolAtWork, ADoublePressUponNothingLeavesNothing) {
  const Voxel near{bright().fan, bright().beam, 0};
  tool().press(near, false, false, false);
  tool().press(near, false, false, true);
  app_.settle();
  EXPECT_TRUE(document().state().schools.empty());
  EXPECT_TRUE(journal().empty());
}

TEST_F(SeedToolAtWork, APressUponASchoolSelectsItAndGrowsNothing) {
  press();
  app_.settle();
  workspace().school.set(std::nullopt);
  tool().hover(bright(), false, false);
  EXPECT_THAT(workspace().preview().text, testing::HasSubstr("click selects, double click follows"));
  press();
  app_.settle();
  EXPECT_EQ(workspace().school(), (SchoolName{0, 1}));
  EXPECT_EQ(journal().size(), 1U);
  tool().select({bright().fan, bright().beam, 0});
  EXPECT_FALSE(workspace().school()) << "where there is none, none is selected";
}

TEST_F(SeedToolAtWork, ControlTakesAwayWhatHoversAndShiftAddsIt) {
  set_tolerance(12.0);
  press();
  app_.settle();
  const PingMask whole = mask_of(0);
  document().undo();  // something else stands last
  document().redo();
  app_.settle();
  workspace().school.set(std::nullopt);  // and nothing is selected: no school grows anew
  set_tolerance(4.0);
  workspace().school.set(SchoolName{0, 1});
  tool().hover(bright(), false, true);
  app_.settle();
  ASSERT_TRUE(workspace().preview().mask);
  const PingMask core = *workspace().preview().mask;
  EXPECT_EQ(core.runs, fresh(bright()).runs);
  EXPECT_LT(core.voxels(), whole.voxels());
  press(false, true);
  app_.settle();
  ASSERT_EQ(document().state().schools.size(), 1U);
  EXPECT_EQ(mask_of(0), subtract(whole, core));
  press(true);
  app_.settle();
  EXPECT_EQ(mask_of(0).runs, whole.runs);
  EXPECT_EQ(document().state().schools.size(), 1U);
}

TEST_F(SeedToolAtWork, ThePreviewFollowsThePingUnderThePointer) {
  tool().hover(bright(), false, false);
  app_.settle();
  document().look_at(document().ping() + 1);
  app_.settle();
  EXPECT_EQ(workspace().preview().ping_index, document().ping());
  EXPECT_EQ(workspace().preview().mask ? *workspace().preview().mask : PingMask{}, fresh(bright()));
}

}  // namespace
}  // namespace sonar
