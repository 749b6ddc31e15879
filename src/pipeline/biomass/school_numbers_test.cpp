// SPDX-License-Identifier: Apache-2.0
#include "pipeline/biomass/school_numbers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "base/units.h"
#include "pipeline/biomass/band_causes.h"
#include "pipeline/biomass/test_fish.h"

namespace sonar {
namespace {

using test::line_fish;

constexpr double kFish = 50000.0;
constexpr double kWaveNumber = 2.0 * std::numbers::pi * 90000.0 / 1500.0;

/// A level line of 0.25 x 27 cm, all fish heading north, seen from the bearing at no elevation: by hand.
double echo_of_fish(double bearing_deg) {
  const double x = kWaveNumber * 0.25 * 0.27 * std::cos(rad_from_deg(bearing_deg));
  const double line = std::abs(x) < 1e-9 ? 1.0 : std::pow(std::sin(x) / x, 2);
  return kFish * std::pow(10.0, -6.8) * 27.0 * 27.0 * (0.1 + 0.9 * line);
}

/// A school that swims north past a ship, seen from ahead of broadside to behind.
ObservationProduct passing_school(double course_deg) {
  ObservationProduct product;
  product.observation = "obs-0001";
  product.grid.emplace();
  product.grid->grid.frequency_hz = {75000.0, 105000.0};
  product.grid->sound_speed_mps = 1500.0;
  SchoolRow school;
  school.observation = product.observation;
  school.school_id = 1;
  school.course_deg = course_deg;
  school.course_se_deg = 0.0;
  school.species = "herring";
  school.volume_corrected_m3 = 10000.0;
  school.backscatter_calibration_se_db = 0.2;
  double sum = 0.0;
  for (int i = 0; i <= 20; ++i) {
    PingNavigation ping;
    ping.time = 1000 * (i + 1);
    ping.transducer_depth_m = 40.0;
    product.pings.push_back(ping);
    SchoolPingRow row;
    row.observation = product.observation;
    row.school_id = 1;
    row.ping_index = i;
    row.time_utc = ping.time;
    row.depth_m = 40.0;
    row.range_m = 150.0;
    row.bearing_deg = 60.0 + 3.0 * i;
    row.backscatter_total_m2 = echo_of_fish(row.bearing_deg);
    row.backscatter_total_se_m2 = 0.05 * row.backscatter_total_m2;
    sum += row.backscatter_total_m2;
    product.school_pings.push_back(row);
  }
  school.first_time_utc = 1000;
  school.last_time_utc = 21000;
  school.backscatter_total_m2 = sum / 21.0;
  product.schools.push_back(school);
  return product;
}

TEST(SchoolNumbers, count_fish_of_known_directivity) {
  const ObservationProduct product = passing_school(0.0);
  const FishChoice fish = line_fish();
  const auto schools = school_numbers({&product, 1}, fish);
  ASSERT_EQ(schools.size(), 1U);
  const BiomassRow& row = schools[0].row;
  EXPECT_EQ(row.n_pings, 21);
  EXPECT_NEAR(row.numbers, kFish, 0.005 * kFish);
  EXPECT_LT(row.numbers_low, kFish);
  EXPECT_GT(row.numbers_high, kFish);
  EXPECT_LT(row.numbers_high / row.numbers_low, 1.25);  // a factor 4 pi, or a dB, lies far outside
  EXPECT_NEAR(row.biomass_t, kFish * 0.005 * 27.0 * 27.0 * 27.0 * 1e-6, 0.005 * row.biomass_t);
  EXPECT_NEAR(row.fish_per_m3, 5.0, 0.03);
  EXPECT_EQ(row.band, "fading calibration lengths aspect");
  for (const BiomassPingRow& ping : schools[0].pings) {
    EXPECT_NEAR(ping.numbers, kFish, 0.02 * kFish) << ping.aspect_deg;
    EXPECT_NEAR(ping.aspect_deg, 90.0 - std::abs(30.0 - 3.0 * static_cast<double>(ping.ping_index)), 1e-6);
  }
}

// What one faint ping does not tell of its fading the others do.
TEST(SchoolNumbers, fade_though_a_ping_does_not_tell) {
  ObservationProduct product = passing_school(0.0);
  const double all = school_numbers({&product, 1}, line_fish())[0].errors.own;
  product.school_pings[0].backscatter_total_se_m2 = kUnknown;
  const double fewer = school_numbers({&product, 1}, line_fish())[0].errors.own;
  EXPECT_GT(fewer, all);
  EXPECT_LT(fewer, 1.1 * all);
}

TEST(SchoolNumbers, without_aspect_are_told_wrong) {
  const ObservationProduct product = passing_school(0.0);
  FishChoice fish = line_fish();
  fish.chosen.directivity = {};
  const auto schools = school_numbers({&product, 1}, fish);
  EXPECT_LT(schools[0].row.numbers_high, 0.7 * kFish);
}

// A course that nobody knows may be any: fish end on echo a tenth, and broadside most.
TEST(SchoolNumbers, of_an_unknown_course_have_a_wide_band) {
  const ObservationProduct product = passing_school(kUnknown);
  const auto schools = school_numbers({&product, 1}, line_fish());
  const BiomassRow& row = schools[0].row;
  EXPECT_LT(row.numbers_low, kFish);
  EXPECT_GT(row.numbers_high, kFish);
  EXPECT_NEAR(row.ts_span_db, 10.0, 0.1);
  EXPECT_TRUE(std::isnan(row.aspect_deg));
}

// Seen from one side of broadside only, a course known to 10 degrees makes a difference; from both it evens out.
TEST(SchoolNumbers, hold_the_doubt_of_the_course) {
  ObservationProduct product = passing_school(0.0);
  product.school_pings.resize(11);
  product.schools[0].course_se_deg = 10.0 / 1.96;
  const auto doubted = school_numbers({&product, 1}, line_fish());
  product.schools[0].course_se_deg = kUnknown;
  const auto untold = school_numbers({&product, 1}, line_fish());
  product.schools[0].course_se_deg = 0.0;
  const auto sure = school_numbers({&product, 1}, line_fish());
  EXPECT_EQ(sure[0].row.ts_span_db, 0.0);
  EXPECT_GT(doubted[0].row.ts_span_db, 0.1);
  EXPECT_GT(untold[0].row.ts_span_db, doubted[0].row.ts_span_db);
}

// Broadside lies within what the course may be, and neither of its ends is as loud.
TEST(SchoolNumbers, hold_broadside_where_the_course_may_be) {
  ObservationProduct product = passing_school(10.0);
  product.school_pings = {product.school_pings[10]};
  product.schools[0].course_se_deg = 20.0 / 1.96;
  const auto schools = school_numbers({&product, 1}, line_fish());
  EXPECT_NEAR(schools[0].row.ts_strongest_db, 10.0 * std::log10(std::pow(10.0, -6.8) * 27.0 * 27.0), 1e-6);
}

// A current carries the school over ground; its fish head as they swim through the water.
TEST(SchoolNumbers, take_the_course_through_the_water) {
  ObservationProduct product = passing_school(40.0);
  product.schools[0].course_water_deg = 0.0;
  product.schools[0].course_water_se_deg = 0.0;
  const auto schools = school_numbers({&product, 1}, line_fish());
  EXPECT_NEAR(schools[0].row.numbers, kFish, 0.005 * kFish);
  EXPECT_EQ(schools[0].row.course_deg, 0.0);
}

// An even number of pings: half way between the first and the last there is none, but may be the end of an EDSU.
TEST(SchoolNumbers, lie_where_a_ping_is) {
  ObservationProduct product = passing_school(0.0);
  product.school_pings.resize(20);
  product.schools[0].last_time_utc = product.school_pings.back().time_utc;
  const auto schools = school_numbers({&product, 1}, line_fish());
  EXPECT_EQ(schools[0].middle_utc, product.school_pings[10].time_utc);
}

TEST(SchoolNumbers, span_the_choices) {
  const ObservationProduct product = passing_school(0.0);
  FishChoice fish = line_fish();
  fish.choices = {fish.chosen, fish.chosen};
  fish.choices[0].b_db += 3.0;
  fish.choices[1].b_db -= 4.0;
  const auto schools = school_numbers({&product, 1}, fish);
  const BiomassRow& row = schools[0].row;
  EXPECT_NEAR(row.ts_span_db, 7.0, 1e-9);
  EXPECT_NEAR(row.ts_strongest_db - row.ts_mean_db, 3.0, 1e-9);
  EXPECT_LT(row.numbers_low, row.numbers / std::pow(10.0, 0.3));
  EXPECT_GT(row.numbers_high, row.numbers * std::pow(10.0, 0.4));
  EXPECT_EQ(row.band, "fading calibration lengths aspect ts");
}

// Relations 3 dB louder and 4 dB fainter: so many fish fewer and more. By hand for two schools: fading 3 % each, 2.1 % of
// both; 95 % of that is 1.96 * 0.0212 * 4.343 dB.
TEST(BandCauses, tell_what_each_adds_alone) {
  const ObservationProduct product = passing_school(0.0);
  FishChoice fish = line_fish();
  fish.choices = {fish.chosen, fish.chosen};
  fish.choices[0].b_db += 3.0;
  fish.choices[1].b_db -= 4.0;
  auto schools = school_numbers({&product, 1}, fish);
  schools.push_back(schools[0]);
  for (NumberedSchool& school : schools) school.errors = {0.03, 0.04, kUnknown};
  const BandCauses causes = band_causes(schools);
  EXPECT_NEAR(causes.relation.down_db, -3.0, 1e-9);
  EXPECT_NEAR(causes.relation.up_db, 4.0, 1e-9);
  ASSERT_EQ(causes.by_choice_db.size(), 2U);
  EXPECT_NEAR(causes.by_choice_db[0], -3.0, 1e-9);
  EXPECT_NEAR(causes.fading.up_db, 1.959964 * 0.03 / std::numbers::sqrt2 * 10.0 / std::numbers::ln10, 1e-6);
  EXPECT_NEAR(causes.calibration.down_db, -1.959964 * 0.04 * 10.0 / std::numbers::ln10, 1e-6);
  EXPECT_TRUE(std::isnan(causes.lengths.up_db));
  EXPECT_NEAR(causes.course.up_db, 0.0, 1e-9) << "the course is known";
  schools[0].counted = schools[1].counted = false;
  EXPECT_TRUE(std::isnan(band_causes(schools).relation.up_db));
}

TEST(SchoolNumbers, take_only_the_pings_that_tell_backscatter) {
  ObservationProduct product = passing_school(0.0);
  product.school_pings[3].touches_edge = 1;
  product.school_pings[3].backscatter_total_m2 *= 0.1;
  const auto schools = school_numbers({&product, 1}, line_fish());
  EXPECT_EQ(schools[0].row.n_pings, 20);
  EXPECT_EQ(schools[0].row.n_pings_whole, 20);
  EXPECT_EQ(schools[0].pings[3].used, 0);
  EXPECT_NEAR(schools[0].row.numbers, kFish, 0.005 * kFish);
}

}  // namespace
}  // namespace sonar
