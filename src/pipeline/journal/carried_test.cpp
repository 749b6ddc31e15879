// SPDX-License-Identifier: Apache-2.0
// Choices whose voxel has become nobody's, for masks moved.
#include "pipeline/journal/carried.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pipeline/commands/test_context.h"

namespace sonar {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace)

/// A product of the small sea whose school 7 lay as `block` in every ping.
ObservationProduct product_then(const Block& block) {
  ObservationProduct product;
  const SmallSea sea;
  product.grid = GridRecord{sea.grid, std::vector<std::int32_t>(kFans, kSamples), {-0.2, 0.5, kSamples}, 1500.0, {}};
  for (int i = 0; i < kPings; ++i) {
    product.pings.emplace_back().time = ping_time(i);
    product.masks.push_back({7, i, block_mask(block)});
  }
  SchoolRow row;
  row.school_id = 7;
  product.schools.push_back(row);
  return product;
}

EarlierSchools earlier_of(const std::vector<ObservationProduct>& products) {
  EarlierSchools earlier;
  for (const ObservationProduct& product : products) earlier.add(product, 0.0);
  return earlier;
}

/// Then A reached five samples farther towards B.
constexpr Block kThen{1, 3, 2, 4, 30, 42};
const SchoolKey kMargin{ping_time(3), channel_at(2, 3), 41};

JournalState decided(const EarlierSchools& earlier, const SchoolKey& key, JournalState state = SmallSea::detected()) {
  const SmallSea sea;
  CommandContext context = sea.context();
  context.earlier = &earlier;
  const JournalLine said = line(3, 3, DecideCommand{{Decision{key, "accepted", "herring", {}}}, ""});
  return fold({&said, 1}, std::move(state), context);
}

TEST(CarriedChoices, GoToTheSchoolThatHasMostOfWhatWasThere) {
  const JournalState state = decided(earlier_of({product_then(kThen)}), kMargin);
  EXPECT_EQ(state.schools[0]->masks.decided.status, "accepted");
  EXPECT_EQ(state.schools[0]->masks.decided.species, "herring");
  EXPECT_EQ(state.schools[1]->masks.decided.status, "unreviewed");
  ASSERT_EQ(state.notes.size(), 1U);
  EXPECT_EQ(state.notes[0].code, DiagnosticCode::decision_carried);
  EXPECT_EQ(state.notes[0].ping_index, 3);
}

// The product of now stands before the older one, and has none of its voxel.
TEST(CarriedChoices, AnOlderProductTellsWhatANewerOneDoesNot) {
  const JournalState state = decided(earlier_of({product_then(kA), product_then(kThen)}), kMargin);
  EXPECT_EQ(state.schools[0]->masks.decided.status, "accepted");
  // A ping that the school is not in any more does not matter: it is the same in the others.
  JournalState without = SmallSea::detected();
  auto school = std::make_shared<StateSchool>(*without.schools[0]);
  std::erase_if(school->masks.pings, [](const auto& there) { return there.ping_index == 3; });
  without.schools[0] = school;
  const JournalState carried = decided(earlier_of({product_then(kA)}), key_a(3), without);
  EXPECT_EQ(carried.schools[0]->masks.decided.status, "accepted");
}

TEST(CarriedChoices, WhatFindsNoSchoolIsListed) {
  // Nothing was there then; no school is there now; what was there then has hardly any of A: 1 of 8 samples; nothing is
  // known of then.
  const SchoolKey water{ping_time(3), channel_at(5, 6), 60};
  const SchoolKey of_wide{ping_time(3), channel_at(2, 3), 9};
  const EarlierSchools then = earlier_of({product_then(kThen)});
  const EarlierSchools wide = earlier_of({product_then({1, 3, 2, 4, 8, 30})});
  for (const JournalState& state :
       {decided(then, water), decided(then, kMargin, {}), decided(wide, of_wide), decided({}, kMargin)}) {
    ASSERT_EQ(state.notes.size(), 1U);
    EXPECT_EQ(state.notes[0].code, DiagnosticCode::decision_lost);
    for (const auto& school : state.schools) EXPECT_EQ(school->masks.decided.status, "unreviewed");
  }
  // Of four samples one is a quarter: that much is the same fish.
  const SchoolKey of_aside{ping_time(3), channel_at(2, 3), 40};
  const EarlierSchools aside = earlier_of({product_then({1, 3, 2, 4, 37, 40})});
  EXPECT_EQ(decided(aside, of_aside).notes[0].code, DiagnosticCode::decision_carried);
}

}  // namespace
}  // namespace sonar
