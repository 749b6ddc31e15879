// SPDX-License-Identifier: Apache-2.0
#include "pipeline/biomass/length_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace sonar {
namespace {

using testing::HasSubstr;

std::string lengths_refused(const std::string& text) {
  const auto table = parse_csv(text, "l.csv");
  const auto lengths = table ? fish_lengths_of(*table) : Result<FishLengths>(pass_on(table));
  return lengths ? "" : to_line(lengths.error());
}

TEST(FishLengths, are_read_with_their_shares) {
  const auto counts = fish_lengths_of(*parse_csv("length_cm,count\n20,30\n30,10\n", "l.csv"));
  ASSERT_TRUE(counts);
  EXPECT_EQ(counts->measured, 40.0);
  EXPECT_EQ(counts->classes[1].share, 0.25);
  const auto shares = fish_lengths_of(*parse_csv("fraction,length_cm\n75,20\n25,30\n", "l.csv"));
  ASSERT_TRUE(shares);
  EXPECT_TRUE(std::isnan(shares->measured));
  EXPECT_EQ(shares->classes[1].share, 0.25);
  EXPECT_THAT(lengths_refused("length_cm,count\n20,1.5\n"), HasSubstr("l.csv: line 2: expected a whole number"));
  EXPECT_THAT(lengths_refused("length_cm,count\n20,1\n20,2\n"), HasSubstr("line 3: the length 20 cm stands twice"));
  EXPECT_THAT(lengths_refused("length_cm,count\n0,1\n"), HasSubstr("line 2: expected a length"));
  EXPECT_THAT(lengths_refused("length_cm,count,fraction\n20,1,1\n"), HasSubstr("line 1: expected the columns"));
  EXPECT_THAT(lengths_refused("length_cm,count\n20,0\n"), HasSubstr("tells of no fish"));
  EXPECT_THAT(lengths_refused("length_cm,fraction\n20,1e308\n30,1e308\n"), HasSubstr("line 2: expected a share"));
}

// E(L^2) = mean^2 + sd^2: what a relation of 20 log10 L asks of the lengths.
TEST(FishLengths, of_a_normal_distribution_have_its_mean_and_deviation) {
  const FishLengths lengths = normal_lengths(28.0, 3.0);
  double share = 0.0;
  double mean = 0.0;
  double square = 0.0;
  for (const LengthClass& of : lengths.classes) {
    share += of.share;
    mean += of.share * of.length_cm;
    square += of.share * of.length_cm * of.length_cm;
  }
  EXPECT_NEAR(share, 1.0, 1e-12);
  EXPECT_NEAR(mean, 28.0, 1e-9);
  EXPECT_NEAR(square, 28.0 * 28.0 + 9.0, 0.02);
  EXPECT_EQ(normal_lengths(28.0, 0.0).classes.size(), 1U);
  for (const LengthClass& of : normal_lengths(2.0, 3.0).classes) EXPECT_GT(of.length_cm, 0.0);
}

}  // namespace
}  // namespace sonar
