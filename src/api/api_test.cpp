// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/time.h"
#include "model/product.h"
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

TEST(Recipe, NamesOfEarlierVersionsAreNoted) {
  const Recipe recipe = Recipe::from_json(R"({"recipe_version": 1, "flags": {"wall": {"enabled": false}}})");
  EXPECT_THAT(recipe.notes(), testing::ElementsAre("flags.wall is called flags.interference now"));
  EXPECT_THAT(Recipe::from_json(recipe.to_json()).notes(), testing::IsEmpty());
}

/// Two pings of 1 fan, 2 beams and 4 samples. School 7 has samples 1 and 2 of beam 1 in the second.
Product two_pings() {
  sonar::ObservationProduct own;
  own.observation = "obs-0001";
  own.pings.resize(2);
  own.grid.emplace();
  own.grid->grid.elevation_deg = {0.0};
  own.grid->grid.azimuth_deg = {269.0, 271.0};
  own.grid->grid.channel = {0, 1};
  own.grid->range.count = 4;
  own.masks.push_back({7, 1, {{{1, 1, 2}}, {255, 128}}});
  sonar::SchoolRow row;
  row.school_id = 7;
  row.first_time_utc = row.last_time_utc = sonar::time_from_calendar(2020, 1, 4, 8 * 3600.0) + 350'000'100;
  own.schools.push_back(row);
  own.school_pings.emplace_back().edge_flags = 5;
  return Product(std::make_shared<const sonar::ObservationProduct>(std::move(own)));
}

const Column& column_of(const Table& table, const std::string& name) {
  for (const Column& column : table) {
    if (column.name == name) return column;
  }
  throw Error("no column " + name, "usage");
}

TEST(Product, VoxelsKnowTheirSchool) {
  const Product product = two_pings();
  EXPECT_THAT(product.school_ids(0), testing::ElementsAre(0, 0, 0, 0, 0, 0, 0, 0));
  EXPECT_THAT(product.school_ids(1), testing::ElementsAre(0, 0, 0, 0, 0, 7, 7, 0));
}

TEST(Product, APingThatIsNotThereIsRefused) {
  const Product product = two_pings();
  for (const auto& [ping, number] : {std::pair(-1, "-1"), std::pair(2, "2")}) {
    EXPECT_EQ(line_of([&, at = ping] { (void)product.school_ids(at); }),
              std::string("usage: no ping ") + number + ": obs-0001 has pings 0 to 1");
  }
}

TEST(Product, AFolderIsNotMadeForIt) {
  EXPECT_EQ(line_of([] { two_pings().write("/not/there/x.nc"); }), "not_found: /not/there: no such folder to write to");
}

// 2020-01-04 08:00:00 is 1578124800 s after 1970 (`date -u -d @1578124800`); the text keeps milliseconds.
TEST(Product, TimesAreWholeNumbersBesideTheirTexts) {
  const Table schools = two_pings().schools();
  EXPECT_THAT(column_of(schools, "first_time_utc").times_ns, testing::ElementsAre(1'578'124'800'350'000'100));
  EXPECT_THAT(column_of(schools, "decided_utc").times_ns, testing::ElementsAre(0));
  EXPECT_THAT(column_of(schools, "school_id").times_ns, testing::IsEmpty());
}

TEST(Product, FlagsSayWhatTheyMean) {
  const Table rows = two_pings().school_pings();
  const Column& edges = column_of(rows, "edge_flags");
  EXPECT_TRUE(edges.flags_are_bits);
  EXPECT_EQ(edges.flags.size(), 9U);
  EXPECT_THAT(edges.flag_meanings, HasSubstr("fore aft top_fan"));
  EXPECT_THAT(column_of(rows, "touches_edge").flags, testing::ElementsAre(0, 1));
  EXPECT_THAT(column_of(rows, "n_beams").flags, testing::IsEmpty());
}

}  // namespace
}  // namespace sonar_explorer
