// SPDX-License-Identifier: Apache-2.0
// Choices whose voxel has become nobody's, for masks moved.
#include "pipeline/carried.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pipeline/commands/test_ground.h"

namespace sonar {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace)

/// A product of the small sea whose school 7 lay as `block` in every ping.
ObservationProduct product_then(const Block& block) {
  ObservationProduct product;
  const SmallSea sea;
  product.grid = GridRecord{sea.grid, std::vector<std::int32_t>(kFans, kSamples), {-0.2, 0.5, kSamples}, 1500.0};
  for (int i = 0; i < kPings; ++i) {
    product.pings.emplace_back().time = ping_time(i);
    product.masks.push_back({7, i, block_mask(block)});
  }
  SchoolRow row;
  row.school_id = 7;
  product.schools.push_back(row);
  return product;
}

EarlierSchools earlier_of(const ObservationProduct& product) {
  EarlierSchools earlier;
  earlier.add(product, 0.0);
  return earlier;
}

/// Then A reached five samples farther towards B.
constexpr Block kThen{1, 3, 2, 4, 30, 42};
const SchoolKey kRim{ping_time(3), channel_at(2, 3), 41};

JournalState decided(const EarlierSchools& earlier, const SchoolKey& key, JournalState state = SmallSea::detected()) {
  const SmallSea sea;
  CommandGround ground = sea.ground();
  ground.heir = [&](const JournalState& now, const SchoolKey& of) { return heir_of(of, now, ground, earlier); };
  const JournalLine said = line(3, 3, DecideCommand{{Decision{key, "accepted", "herring", {}}}, ""});
  return fold({&said, 1}, std::move(state), ground);
}

TEST(CarriedChoices, GoToTheSchoolThatHasMostOfWhatWasThere) {
  const JournalState state = decided(earlier_of(product_then(kThen)), kRim);
  EXPECT_EQ(state.schools[0]->masks.decided.status, "accepted");
  EXPECT_EQ(state.schools[0]->masks.decided.species, "herring");
  EXPECT_EQ(state.schools[1]->masks.decided.status, "unreviewed");
  ASSERT_EQ(state.notes.size(), 1U);
  EXPECT_EQ(state.notes[0].code, DiagnosticCode::decision_carried);
  EXPECT_EQ(state.notes[0].ping_index, 3);
}

TEST(CarriedChoices, AreKnownAgainInTheProductMadeAfterIt) {
  const JournalState state = decided(earlier_of(product_then(kThen)), kRim);
  // The next product has the masks of now, and what was said of the choice: the voxel is in no mask of it.
  ObservationProduct next = product_then(kA);
  next.diagnostics = state.notes;
  const JournalState again = decided(earlier_of(next), kRim);
  EXPECT_EQ(again.schools[0]->masks.decided.status, "accepted");
  ASSERT_EQ(again.notes.size(), 1U);
  EXPECT_EQ(again.notes[0].text, state.notes[0].text);
}

TEST(CarriedChoices, WhatFindsNoSchoolIsListed) {
  // Nothing was there then; no school is there now; and what was there then has hardly any of A: 9 of its 72 voxels.
  const EarlierSchools then = earlier_of(product_then(kThen));
  const SchoolKey water{ping_time(3), channel_at(5, 6), 60};
  const EarlierSchools aside = earlier_of(product_then({1, 3, 2, 4, 37, 40}));
  const SchoolKey of_aside{ping_time(3), channel_at(2, 3), 40};
  const EarlierSchools wide = earlier_of(product_then({1, 3, 2, 4, 8, 30}));
  const SchoolKey of_wide{ping_time(3), channel_at(2, 3), 9};
  for (const JournalState& state :
       {decided(then, water), decided(then, kRim, {}), decided(wide, of_wide), decided({}, kRim)}) {
    ASSERT_EQ(state.notes.size(), 1U);
    EXPECT_EQ(state.notes[0].code, DiagnosticCode::decision_lost);
    for (const auto& school : state.schools) EXPECT_EQ(school->masks.decided.status, "unreviewed");
  }
  // Of four samples one is a quarter: that much is the same fish.
  EXPECT_EQ(decided(aside, of_aside).notes[0].code, DiagnosticCode::decision_carried);
}

TEST(CarriedChoices, NotesReadBack) {
  const std::string text = carried_text("choice 3 (decide): ", {0, 12, 345}, {0, 14, 350}, 7);
  const auto note = carried_note(text);
  ASSERT_TRUE(note) << text;
  EXPECT_EQ(note->channel, 12);
  EXPECT_EQ(note->sample, 345);
  EXPECT_EQ(note->now.channel, 14);
  EXPECT_EQ(note->now.sample, 350);
  EXPECT_EQ(note->now.ping_index, 7);
  // A foreign file's: cut short at any place, or with what is no number.
  for (std::size_t i = 0; i < text.size(); ++i) EXPECT_FALSE(carried_note(std::string_view(text).substr(0, i))) << i;
  EXPECT_FALSE(carried_note(text + " "));
  EXPECT_FALSE(carried_note("channel 99999999999999999999, sample 1"));
  ObservationProduct foreign = product_then(kThen);
  foreign.diagnostics.push_back({DiagnosticCode::decision_carried, "", -1, 99, text});
  foreign.diagnostics.push_back({DiagnosticCode::decision_carried, "", -1, 1, text});
  foreign.pings.resize(3);
  for (SchoolMask& mask : foreign.masks) mask.ping_index %= 3;
  EXPECT_TRUE(earlier_of(foreign).layers[0].carried.empty()) << "it has no ping 7, nor 99";
}

}  // namespace
}  // namespace sonar
