// SPDX-License-Identifier: Apache-2.0
#include "pipeline/survey/currents_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

#include "pipeline/recipe/recipe.h"

namespace sonar {
namespace {

CurrentProfiles example() {
  CurrentProfiles profiles{
      {time_from_calendar(2009, 11, 13, 3600.25), {60.1, -4.25}, {{12.5, 0.1031, -0.045}, {20, 0, 1}}},
      {time_from_calendar(2009, 11, 13, 3900.0), CurrentProfile{}.place, {{8, -0.5, 0.25}}}};
  return profiles;
}

void expect_equal(const CurrentProfiles& found, const CurrentProfiles& wanted) {
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].time, wanted[i].time);
    EXPECT_EQ(found[i].bins, wanted[i].bins);
  }
  EXPECT_EQ(found.front().place, wanted.front().place);
  EXPECT_TRUE(std::isnan(found.back().place.latitude_deg));
}

TEST(CurrentsJson, ComesBackAsItWas) {
  const auto back = currents_from_json(to_json(example()));
  ASSERT_TRUE(back) << to_line(back.error());
  expect_equal(*back, example());
}

TEST(CurrentsJson, StandsInTheRecipeAndItsHash) {
  Recipe recipe;
  const std::string without = recipe_hash(recipe);
  recipe.current_profiles = example();
  EXPECT_NE(recipe_hash(recipe), without);
  const auto back = recipe_from_text(recipe_text(recipe));
  ASSERT_TRUE(back) << to_line(back.error());
  expect_equal(back->current_profiles, example());
  EXPECT_EQ(recipe_text(*back), recipe_text(recipe));
}

TEST(CurrentsJson, RefusesWhatIsNone) {
  const auto refused = [](const char* text) { return !currents_from_json(nlohmann::json::parse(text)); };
  EXPECT_TRUE(refused("{}"));
  EXPECT_TRUE(refused("[1]"));
  EXPECT_TRUE(refused(R"([{"time_utc":"2009-11-13T01:00:00.000Z"}])"));
  EXPECT_TRUE(refused(R"([{"time_utc":"2009-11-13T01:00:00.000Z","profile":""}])")) << "no bin";
  EXPECT_TRUE(refused(R"([{"time_utc":"2009-11-13T01:00:00.000Z","profile":"10 0.1"}])"));
  EXPECT_TRUE(refused(R"([{"time_utc":"2009-11-13T01:00:00.000Z","profile":"10 0.1 0.1; 5 0.1 0.1"}])"))
      << "depths fall";
  EXPECT_TRUE(refused(R"([{"time_utc":"2009-11-13T01:00:00.000Z","profile":"10 99 0"}])")) << "no current";
  EXPECT_TRUE(refused(R"([{"time_utc":"2009-11-13T01:00:00.000Z","profile":"10 nan 0"}])"));
  EXPECT_TRUE(refused(R"([{"time_utc":"2009-11-13T01:00:00.000Z","latitude":95,"longitude":0,"profile":"10 0 0"}])"));
  EXPECT_FALSE(refused(R"([{"time_utc":"2009-11-13T01:00:00.000Z","profile":"10 0.1 0.1;20 0 0"}])"));
}

}  // namespace
}  // namespace sonar
