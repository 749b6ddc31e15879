// SPDX-License-Identifier: Apache-2.0
#include "pipeline/biomass/biomass_strata.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "pipeline/biomass/test_fish.h"

namespace sonar {
namespace {

using test::line_fish;

constexpr TimeNs kSecond_ns = 1'000'000'000;

/// Schools of 1 m2 and 10 000 fish, that is -40 dB, in the middle of two strata.
std::vector<NumberedSchool> two_schools() {
  std::vector<NumberedSchool> schools(2);
  for (NumberedSchool& school : schools) {
    school.counted = true;
    school.row.backscatter_m2 = 1.0;
    school.row.numbers = school.strongest = school.weakest = 10000.0;
    school.errors.own = 0.03;
    school.errors.calibration = 0.04;
  }
  schools[0].middle_utc = 5 * kSecond_ns;
  schools[1].middle_utc = 15 * kSecond_ns;
  return schools;
}

EffortRow effort(const std::string& stratum, TimeNs from_s, TimeNs to_s) {
  EffortRow row;
  row.stratum = stratum;
  row.edsu = 1;
  row.first_time_utc = from_s * kSecond_ns;
  row.last_time_utc = to_s * kSecond_ns;
  return row;
}

StratumRow stratum(const std::string& level, const std::string& name, double distance_nmi, double nasc, double se) {
  StratumRow row;
  row.level = level;
  row.stratum = name;
  row.distance_nmi = distance_nmi;
  row.nasc_school_m2_nmi2 = nasc;
  row.nasc_school_se_m2_nmi2 = se;
  return row;
}

// A square nautical mile that holds n fish of sigma has a NASC of 4 pi n sigma, by the definition of NASC.
TEST(BiomassStrata, come_back_from_their_nasc) {
  const std::vector<EffortRow> units{effort("north", 1, 10), effort("south", 11, 20)};
  const double nasc = 4.0 * std::numbers::pi * 3000.0 * 1e-4;
  const std::vector<StratumRow> strata{
      stratum("transect", "north", 30.0, nasc, kUnknown), stratum("stratum", "north", 30.0, nasc, 0.1 * nasc),
      stratum("stratum", "south", 10.0, 2.0 * nasc, 0.2 * nasc), stratum("survey", "", 40.0, 1.25 * nasc, kUnknown)};
  const auto rows = biomass_strata(two_schools(), line_fish(), {units, strata, {{"north", 100.0}, {"south", 50.0}}});
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].n_schools, 1);
  EXPECT_NEAR(rows[0].ts_mean_db, -40.0, 1e-9);
  EXPECT_NEAR(rows[0].numbers_per_nmi2, 3000.0, 1e-6);
  EXPECT_NEAR(rows[0].numbers_per_nmi2_se, 3000.0 * std::hypot(0.1, 0.04), 1e-6);
  EXPECT_NEAR(rows[0].numbers, 300000.0, 1e-4);
  EXPECT_NEAR(rows[1].numbers, 300000.0, 1e-4);
  const BiomassStratumRow& survey = rows[2];
  EXPECT_EQ(survey.level, "survey");
  EXPECT_NEAR(survey.numbers_per_nmi2, (30.0 * 3000.0 + 10.0 * 6000.0) / 40.0, 1e-6);
  EXPECT_NEAR(survey.numbers, 600000.0, 1e-4);
  EXPECT_EQ(survey.area_nmi2, 150.0);
  // Two strata of 300 000 each, 10 % both: their errors are independent, that of the calibration is one.
  const double relative = std::hypot(0.1 / std::sqrt(2.0), 0.04);
  EXPECT_NEAR(survey.numbers_high, 600000.0 * std::exp(1.959964 * relative), 1.0);
  EXPECT_NEAR(survey.numbers_seen, 20000.0, 1e-9);
  EXPECT_NEAR(survey.numbers_seen_high, 20000.0 * std::exp(1.959964 * std::hypot(0.03 / std::sqrt(2.0), 0.04)), 1.0);
}

TEST(BiomassStrata, have_no_band_without_transects_to_compare) {
  const std::vector<EffortRow> units{effort("", 1, 20)};
  const std::vector<StratumRow> strata{stratum("stratum", "", 30.0, 100.0, kUnknown),
                                       stratum("survey", "", 30.0, 100.0, kUnknown)};
  const auto rows = biomass_strata(two_schools(), line_fish(), {units, strata, {}});
  EXPECT_NEAR(rows[0].numbers_per_nmi2, 100.0 / (4.0 * std::numbers::pi * 1e-4), 1e-6);
  EXPECT_TRUE(std::isnan(rows[0].numbers_per_nmi2_low));
  EXPECT_TRUE(std::isnan(rows[0].numbers));
}

TEST(BiomassStrata, of_a_species_have_its_share_of_the_echo) {
  std::vector<NumberedSchool> schools = two_schools();
  schools[1].counted = false;
  schools[1].row.backscatter_m2 = 3.0;
  const std::vector<EffortRow> units{effort("", 1, 20)};
  const std::vector<StratumRow> strata{stratum("stratum", "", 30.0, 100.0, 10.0)};
  const auto rows = biomass_strata(schools, line_fish(), {units, strata, {}});
  EXPECT_NEAR(rows[0].nasc_school_m2_nmi2, 25.0, 1e-9);
  EXPECT_EQ(rows[0].n_schools, 1);
}

// The table of effort has whole milliseconds, a ping has not.
TEST(BiomassStrata, hold_a_school_in_the_last_ping_of_a_unit) {
  std::vector<NumberedSchool> schools = two_schools();
  schools[0].middle_utc = 10 * kSecond_ns + 999'999;
  const std::vector<EffortRow> units{effort("north", 1, 10), effort("south", 11, 20)};
  const std::vector<StratumRow> strata{stratum("stratum", "north", 30.0, 100.0, 10.0)};
  EXPECT_EQ(biomass_strata(schools, line_fish(), {units, strata, {}})[0].n_schools, 1);
}

// Echo of schools, and none whose fish are known: how many there are is not known, and not 0.
TEST(BiomassStrata, of_unknown_fish_have_no_numbers) {
  const std::vector<EffortRow> units{effort("north", 1, 20)};
  const std::vector<StratumRow> strata{stratum("stratum", "north", 30.0, 100.0, 10.0),
                                       stratum("stratum", "south", 30.0, 100.0, 10.0),
                                       stratum("stratum", "west", 30.0, 0.0, 0.0)};
  const auto rows = biomass_strata(two_schools(), line_fish(), {units, strata, {}});
  EXPECT_GT(rows[0].numbers_per_nmi2, 0.0);
  EXPECT_TRUE(std::isnan(rows[1].numbers_per_nmi2));
  EXPECT_EQ(rows[2].numbers_per_nmi2, 0.0);
}

TEST(BiomassStrata, without_integration_count_what_was_seen) {
  const auto rows = biomass_strata(two_schools(), line_fish(), {});
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_NEAR(rows[0].numbers_seen, 20000.0, 1e-9);
  EXPECT_NEAR(rows[0].biomass_seen_t, 20000.0 * 0.005 * 27.0 * 27.0 * 27.0 * 1e-6, 1e-9);
  EXPECT_TRUE(std::isnan(rows[0].numbers_per_nmi2));
}

}  // namespace
}  // namespace sonar
