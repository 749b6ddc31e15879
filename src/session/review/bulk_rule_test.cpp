// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "session/review/review.h"

namespace sonar {
namespace {

using testing::HasSubstr;

TEST(BulkRules, AreReadAsTheyAreSpoken) {
  const auto rule = bulk_rule(kDefaultBulkRule);
  ASSERT_TRUE(rule);
  ASSERT_EQ(rule->conditions.size(), 3U);
  EXPECT_EQ(rule->status, "accepted");
  EXPECT_EQ(rule->conditions[0].quantity, BulkRule::Quantity::pings);
  EXPECT_EQ(rule->conditions[0].sign, BulkRule::Sign::at_least);
  EXPECT_EQ(rule->conditions[0].limit, 5.0);
  EXPECT_EQ(rule->conditions[1].quantity, BulkRule::Quantity::snr_db);
  EXPECT_EQ(rule->conditions[1].sign, BulkRule::Sign::more);
  EXPECT_EQ(rule->conditions[2].quantity, BulkRule::Quantity::edge_share);
  EXPECT_EQ(bulk_rule("Volume<1e3->REJECT")->status, "rejected");
}

// A foot is 0.3048 m, a fathom six; volumes stay in m3 whatever lengths are read in.
TEST(BulkRules, LengthsAreInTheUnitThatListsShow) {
  const char* text = "depth > 100, length <= 10, volume > 500 -> reject";
  const auto feet = bulk_rule(text, Units{LengthUnit::feet}.length());
  ASSERT_TRUE(feet);
  EXPECT_DOUBLE_EQ(feet->conditions[0].limit, 30.48);
  EXPECT_DOUBLE_EQ(feet->conditions[1].limit, 3.048);
  EXPECT_EQ(feet->conditions[2].limit, 500.0);
  EXPECT_EQ(feet->text, std::string(text) + " (lengths in ft)") << "who reads the journal has no preferences";
  EXPECT_DOUBLE_EQ(bulk_rule(text, Units{LengthUnit::fathoms}.length())->conditions[0].limit, 182.88);
  EXPECT_EQ(bulk_rule(text)->conditions[0].limit, 100.0);
  EXPECT_EQ(bulk_rule(text)->text, text);
  EXPECT_EQ(bulk_rule("pings > 5 -> accept", Units{LengthUnit::feet}.length())->text, "pings > 5 -> accept");
}

TEST(BulkRules, WhatIsNotUnderstoodIsNamed) {
  for (const auto& [text, said] :
       std::vector<std::pair<std::string, std::string>>{{"pings >= 5", "says not what to do"},
                                                        {"pings >= 5 -> keep", "\"keep\""},
                                                        {"-> accept", "without a condition"},
                                                        {"pings >= five -> accept", "\"pings >= five\""},
                                                        {"pings >= 5, colour > 2 -> accept", "\"colour > 2\""},
                                                        {"pings >= 5,, snr > 1 -> accept", "\"\""},
                                                        {"pings > nan -> accept", "\"pings > nan\""},
                                                        {"", "says not what to do"}}) {
    const auto rule = bulk_rule(text);
    ASSERT_FALSE(rule) << text;
    EXPECT_THAT(rule.error().text, HasSubstr(said));
  }
}

}  // namespace
}  // namespace sonar
