// SPDX-License-Identifier: Apache-2.0
#include "model/strongest_ping.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sonar {
namespace {

/// Two schools in three pings: the larger one is cut by an edge where it is largest.
ObservationProduct two_schools() {
  ObservationProduct product;
  product.pings.resize(3);
  for (const std::int64_t id : {1, 2}) {
    SchoolRow school;
    school.school_id = id;
    product.schools.push_back(school);
  }
  const auto add = [&](std::int64_t school, std::int64_t ping, double backscatter_m2, int touches_edge) {
    SchoolPingRow row;
    row.school_id = school;
    row.ping_index = ping;
    row.backscatter_m2 = backscatter_m2;
    row.touches_edge = touches_edge;
    product.school_pings.push_back(row);
  };
  add(1, 0, 9.0, 1);
  add(1, 1, 4.0, 0);
  add(2, 1, 5.0, 0);
  add(2, 2, std::nan(""), 0);
  return product;
}

bool all(const SchoolRow&) { return true; }

TEST(StrongestPing, IsTheLargestWholeSchools) {
  const ObservationProduct product = two_schools();
  const SchoolPingRow* strongest = strongest_ping(product, all);
  ASSERT_NE(strongest, nullptr);
  EXPECT_EQ(strongest->school_id, 2);
  EXPECT_EQ(strongest->ping_index, 1);
}

TEST(StrongestPing, CountsOnlySchoolsThatAreWanted) {
  const ObservationProduct product = two_schools();
  const SchoolPingRow* strongest =
      strongest_ping(product, [](const SchoolRow& school) { return school.school_id == 1; });
  ASSERT_NE(strongest, nullptr);
  EXPECT_EQ(strongest->ping_index, 1) << "whole, though smaller";
  EXPECT_EQ(strongest_ping(product, [](const SchoolRow&) { return false; }), nullptr);
}

TEST(StrongestPing, IsTheLargestOfAllWhereEachIsCut) {
  ObservationProduct product = two_schools();
  for (SchoolPingRow& row : product.school_pings) row.touches_edge = 1;
  EXPECT_EQ(strongest_ping(product, all)->ping_index, 0);
}

TEST(StrongestPing, LiesInThePingsOfTheProduct) {
  ObservationProduct product = two_schools();
  product.pings.resize(1);
  EXPECT_EQ(strongest_ping(product, all)->ping_index, 0);
  product.pings.clear();
  EXPECT_EQ(strongest_ping(product, all), nullptr);
}

}  // namespace
}  // namespace sonar
