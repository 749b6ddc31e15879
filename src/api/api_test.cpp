// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>

#include "sonar_explorer/error.h"
#include "sonar_explorer/recipe.h"
#include "sonar_explorer/schools.h"
#include "sonar_explorer/survey.h"
#include "sonar_explorer/version.h"

namespace sonar_explorer {
namespace {

using testing::HasSubstr;

template <class Call>
std::string line_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.kind() + ": " + error.what();
  }
  return "nothing was thrown";
}

TEST(Version, IsTheProjects) { EXPECT_EQ(version(), SONAR_VERSION); }

TEST(Recipe, ValuesAreChangedByTheirNames) {
  const Recipe recipe;
  const Recipe other =
      recipe.with("detect.tolerance_db", "8.5").with("grow.mode", "\"paper\"").with("automatic", "false");
  EXPECT_NE(other.hash(), recipe.hash());
  const auto json = nlohmann::json::parse(other.to_json());
  EXPECT_EQ(json["detect"]["tolerance_db"], 8.5);
  EXPECT_EQ(json["automatic"], false);
  EXPECT_EQ(Recipe::from_json(other.to_json()).hash(), other.hash());
  EXPECT_EQ(Recipe::preset("paper").hash(), Recipe::preset("paper").hash());
}

TEST(Recipe, WhatIsWrongIsOneLineWithItsKind) {
  const Recipe recipe;
  EXPECT_EQ(line_of([&] { (void)recipe.with("detect.no_such", "1"); }),
            "bad_parameter: detect.no_such: no such parameter");
  EXPECT_THAT(line_of([&] { (void)recipe.with("detect.tolerance_db", "-3"); }), HasSubstr("is outside 0.1 .. 60"));
  EXPECT_THAT(line_of([&] { (void)recipe.with("detect.tolerance_db", "ten"); }), HasSubstr("format: "));
  EXPECT_THAT(line_of([] { (void)Recipe::preset("none"); }), HasSubstr("usage: "));
  EXPECT_THAT(line_of([] { (void)Recipe::from_file("/not/there.json"); }), HasSubstr("/not/there.json"));
  EXPECT_THAT(line_of([] { (void)Survey::open({"/not/there"}); }), HasSubstr("not_found: /not/there"));
  EXPECT_THAT(line_of([] { (void)Product::read("/not/there.nc"); }), HasSubstr("not_found: /not/there.nc"));
}

}  // namespace
}  // namespace sonar_explorer
