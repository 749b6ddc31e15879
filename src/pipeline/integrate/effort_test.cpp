// SPDX-License-Identifier: Apache-2.0
#include "pipeline/integrate/effort.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "geo/geodesic.h"
#include "pipeline/integrate/integration_rows.h"

namespace sonar {
namespace {

using testing::ElementsAre;

constexpr TimeNs kStart = 1'600'000'000 * kSecondNs;
constexpr TimeNs kApart = 10 * kSecondNs;
constexpr double kStep_m = 50.0;

/// Pings every ten seconds, each 50 m north of the one before.
ObservationFiles northward(std::string name, int first, int pings) {
  ObservationFiles observation;
  observation.name = std::move(name);
  observation.grid = BeamGrid{};
  for (int i = first; i < first + pings; ++i) {
    PingNavigation ping;
    ping.time = kStart + i * kApart;
    ping.transducer = destination({60.0, 5.0}, i * kStep_m, 0.0);
    ping.heading_deg = 0.0;
    ping.speed_mps = 5.0;
    ping.course_deg = 0.0;
    observation.navigation.push_back(ping);
  }
  return observation;
}

Transect period(std::string name, EffortType type, int first, int last) {
  return {std::move(name), "s", type, kStart + first * kApart, kStart + last * kApart};
}

std::vector<std::int64_t> pings_of(const Effort& effort) {
  std::vector<std::int64_t> pings;
  for (const EffortUnit& unit : effort.units) pings.push_back(std::ssize(unit.times));
  return pings;
}

double sailed_m(const Effort& effort, const std::string& transect) {
  double sum = 0.0;
  for (const EffortUnit& unit : effort.units) sum += unit.transect == transect ? unit.sailed_m : 0.0;
  return sum;
}

TEST(Effort, an_observation_is_cut_into_units_of_equal_distance) {
  SurveyFiles survey;
  survey.observations.push_back(northward("obs-0001", 0, 11));  // 500 m
  const Effort effort = sailed_effort(survey, {}, 199.0);
  // At 0, 50, 100, 150 m; at 200, 250, 300, 350; at 400, 450, 500.
  EXPECT_THAT(pings_of(effort), ElementsAre(4, 4, 3));
  EXPECT_EQ(effort.units[1].edsu, 2);
  EXPECT_EQ(effort.units[1].transect, "obs-0001");
  EXPECT_NEAR(effort.units[1].from_m, 200.0, 1e-6);
  EXPECT_NEAR(effort.units[0].sailed_m, 200.0, 1e-6);
  EXPECT_NEAR(effort.units[2].sailed_m, 100.0, 1e-6);
  EXPECT_THAT(effort.observations.at(0).unit, ElementsAre(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2));
}

TEST(Effort, a_transect_goes_on_over_a_cut_by_length_and_not_over_a_gap) {
  SurveyFiles survey;
  survey.observations.push_back(northward("obs-0001", 0, 6));
  survey.observations.push_back(northward("obs-0002", 6, 5));
  survey.observations[1].continues_cut = true;
  const Effort whole = sailed_effort(survey, {}, 1e6);
  ASSERT_EQ(whole.units.size(), 1U);
  EXPECT_NEAR(whole.units[0].sailed_m, 500.0, 1e-6);
  survey.observations[1].continues_cut = false;
  const Effort two = sailed_effort(survey, {}, 1e6);
  ASSERT_EQ(two.units.size(), 2U);
  EXPECT_NEAR(two.units[0].sailed_m + two.units[1].sailed_m, 450.0, 1e-6);
}

TEST(Effort, what_is_off_is_cut_out_and_the_units_go_on_behind_it) {
  SurveyFiles survey;
  survey.observations.push_back(northward("obs-0001", 0, 20));
  const std::vector<Transect> transects{period("A", EffortType::transect, 2, 15),
                                        period("trawl", EffortType::off, 6, 9)};
  const Effort effort = sailed_effort(survey, transects, 1e6);
  std::vector<std::string> names;
  for (const EffortUnit& unit : effort.units) names.push_back(unit.transect);
  EXPECT_THAT(names, ElementsAre("", "A", "trawl", ""));
  EXPECT_THAT(pings_of(effort), ElementsAre(2, 10, 4, 4));
  // From ping 2 to 5 and from 10 to 15; what was sailed into and out of the trawl is of neither.
  EXPECT_NEAR(sailed_m(effort, "A"), 8 * kStep_m, 1e-6);
  EXPECT_NEAR(sailed_m(effort, "trawl"), 3 * kStep_m, 1e-6);
  EXPECT_EQ(effort.units[2].edsu, 0);
  EXPECT_EQ(effort.units[1].stratum, "s");
}

TEST(Effort, a_ping_at_which_one_transect_stops_and_another_begins_is_of_the_later_one) {
  SurveyFiles survey;
  survey.observations.push_back(northward("obs-0001", 0, 10));
  const std::vector<Transect> transects{period("A", EffortType::transect, 0, 4),
                                        period("B", EffortType::transect, 4, 9)};
  const Effort effort = sailed_effort(survey, transects, 1e6);
  EXPECT_THAT(pings_of(effort), ElementsAre(4, 6));
  EXPECT_EQ(effort.units[1].transect, "B");
  EXPECT_NEAR(sailed_m(effort, "A") + sailed_m(effort, "B"), 8 * kStep_m, 1e-6);
}

TEST(Effort, transects_without_pings_are_named) {
  SurveyFiles survey;
  survey.observations.push_back(northward("obs-0001", 0, 10));
  const std::vector<Transect> transects{
      period("A", EffortType::transect, 0, 3), period("B", EffortType::transect, 4, 9),
      period("trawl", EffortType::off, 4, 9),  // all of B
      period("C", EffortType::transect, 20, 30), period("D", EffortType::off, 31, 40)};
  EXPECT_THAT(sailed_effort(survey, transects, 1e6).without_pings, ElementsAre("B", "C"));
  EXPECT_TRUE(sailed_effort(survey, {}, 1e6).without_pings.empty());
}

TEST(Effort, pings_without_a_position_are_sailed_over_and_counted) {
  SurveyFiles survey;
  survey.observations.push_back(northward("obs-0001", 0, 11));
  for (const std::size_t lost : {4U, 5U, 6U})
    survey.observations[0].navigation[lost].transducer = PingNavigation{}.transducer;
  const Effort effort = sailed_effort(survey, {}, 1e6);
  const std::vector<UnitSums> sums(effort.units.size());
  const IntegrationTables tables = integration_tables(effort.units, sums, {});
  ASSERT_EQ(tables.effort.size(), 1U);
  EXPECT_EQ(tables.effort[0].n_pings_without_position, 3);
  EXPECT_NEAR(sailed_m(effort, "obs-0001"), 500.0, 1.0);
}

TEST(Effort, the_first_sonar_with_a_grid_is_integrated_and_the_others_are_named) {
  SurveyFiles survey;
  survey.observations.push_back(northward("obs-0001", 0, 3));
  survey.observations.push_back(northward("obs-0002", 0, 3));
  survey.observations.push_back(northward("obs-0003", 0, 3));
  survey.observations[1].config.sounder_name = "another";
  survey.observations[2].grid.reset();
  const Effort effort = sailed_effort(survey, {}, 1e6);
  EXPECT_EQ(effort.observations.size(), 1U);
  EXPECT_THAT(effort.left_out, ElementsAre("obs-0002", "obs-0003"));
}

}  // namespace
}  // namespace sonar
