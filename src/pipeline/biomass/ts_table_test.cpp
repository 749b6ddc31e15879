// SPDX-License-Identifier: Apache-2.0
#include "pipeline/biomass/ts_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/units.h"

namespace sonar {
namespace {

using testing::HasSubstr;

std::vector<TsRelation> presets() {
  auto table = read_ts_table({});
  EXPECT_TRUE(table) << (table ? "" : to_line(table.error()));
  return table ? *table : std::vector<TsRelation>{};
}

double ts_db(const std::string& name, double length_cm, double depth_m) {
  const auto relation = ts_relation_named(presets(), name);
  EXPECT_TRUE(relation) << name;
  return relation ? db_from_linear(relation->sigma_bs_m2(length_cm, depth_m)) : kUnknown;
}

// Figures of the sources, which the lines of the table do not hold themselves.
TEST(TsPresets, give_what_their_sources_say) {
  EXPECT_NEAR(ts_db("mackerel", 33.3, 50.0), -59.83, 0.05);
  EXPECT_NEAR(ts_db("mackerel-120", 33.3, 50.0), -55.5, 0.05);
  EXPECT_NEAR(ts_db("herring-foote", 32.0, 50.0), -41.8, 0.01);
  EXPECT_NEAR(ts_db("herring-side", 30.0, 50.0) - ts_db("herring-ona", 30.0, 50.0), 2.5, 0.02);
  EXPECT_NEAR(ts_db("herring-side", 30.0, 350.0) - ts_db("herring-ona", 30.0, 350.0), -5.0, 0.02);
  for (const TsRelation& relation : presets()) {
    EXPECT_THAT(ts_text(relation), HasSubstr(relation.source));
    EXPECT_EQ(ts_text(relation).find("recalled: check it") != std::string::npos, relation.recalled);
  }
}

TEST(TsPresets, that_could_be_meant_are_of_the_species_and_the_frequency) {
  const auto named = [](const std::vector<TsRelation>& choices) {
    std::vector<std::string> names;
    for (const TsRelation& choice : choices) names.push_back(choice.name);
    return names;
  };
  const auto table = presets();
  const auto at_38 = ts_choices(table, *ts_relation_named(table, "herring"), 38.0, 38.0);
  EXPECT_THAT(named(at_38), testing::ElementsAre("herring", "herring-foote", "herring-ona"));
  EXPECT_EQ(ts_choices(table, *ts_relation_named(table, "herring-side"), 75.0, 112.0).size(), 5U);  // one alone fits
  EXPECT_EQ(ts_choices(table, *ts_relation_named(table, "cod"), 75.0, 112.0).size(), 1U);
}

std::string refusal(const std::string& from, const std::string& to) {
  std::string text(ts_presets_csv());
  text.replace(text.find(from), from.size(), to);
  const auto table = parse_csv(text, "ts.csv");
  const auto relations = table ? ts_relations_of(*table) : Result<std::vector<TsRelation>>(pass_on(table));
  return relations ? "" : to_line(relations.error());
}

TEST(TsTable, names_the_line_that_is_wrong) {
  EXPECT_THAT(refusal("38,38,dorsal,20,-71.9", "38,38,below,20,-71.9"), HasSubstr("ts.csv: line 3: aspect 'below'"));
  EXPECT_THAT(refusal("herring-foote", "herring"), HasSubstr("ts.csv: line 3: the name 'herring' stands twice"));
  EXPECT_THAT(refusal("20,-71.9", "20,"), HasSubstr("line 3: expected m_db"));
  EXPECT_THAT(refusal("0.25,0.1,14,10", "0.25,0.1,,10"), HasSubstr("heading_sd_deg"));
  EXPECT_THAT(refusal("recalled", "remembered"), HasSubstr("recalled"));
}

}  // namespace
}  // namespace sonar
