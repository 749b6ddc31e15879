// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/units.h"
#include "pipeline/biomass/band_causes.h"
#include "pipeline/biomass/biomass_strata.h"
#include "pipeline/biomass/length_table.h"
#include "pipeline/biomass/school_numbers.h"
#include "pipeline/biomass/ts_table.h"

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

FishChoice line_fish() {
  FishChoice fish;
  fish.chosen.name = "line";
  fish.chosen.b_db = -68.0;
  fish.chosen.directivity = {0.25, 0.1, 0.0, 0.0};
  fish.lengths = {{{27.0, 1.0}}, 200.0};
  fish.weight = {0.005, 3.0};
  return fish;
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
