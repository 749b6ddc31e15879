// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "session/numbers/fish_biomass.h"
#include "session/numbers/integration.h"
#include "session/test_app.h"
#include "session/test_run.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Numbers : public testing::Test, protected TestApp {
 protected:
  Numbers() { begin(); }
  [[nodiscard]] Integration& integration() { return *app_->integration; }
  [[nodiscard]] FishBiomass& fish() { return *app_->fish; }
  void integrate() {
    IntegrateParams params;
    params.edsu_nmi = 0.01;
    integration().params.assign(params);
    const auto started = integration().start();
    ASSERT_TRUE(started) << to_line(started.error());
    integration().settle();
    ASSERT_TRUE(integration().result()) << integration().told();
  }
  static std::string bytes(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

// The command line's way, over products on disk, is the independent answer: the same tables.
TEST_F(Numbers, IntegrationIsThatOfARunOfTheSameSchools) {
  document().open_all();
  document().detect({0, 1});
  document().settle();
  integrate();
  const fs::path here = TestSurvey::easy().fresh();
  ASSERT_TRUE(integration().write(here));
  const fs::path run = TestSurvey::easy().fresh();
  ASSERT_TRUE(run_easy(run));
  IntegrateOptions options;
  options.survey = {TestSurvey::easy().folder()};
  options.out = run;
  options.params = integration().params.values();
  Work work;
  const auto expected = integrate_folder(options, work);
  ASSERT_TRUE(expected) << to_line(expected.error());
  for (const char* table : {"effort.csv", "nasc.csv", "strata.csv"}) {
    EXPECT_EQ(bytes(here / table), bytes(run / table)) << table;
  }
  EXPECT_FALSE(integration().write(TestSurvey::easy().folder())) << "raw files lie there";
  ASSERT_GT(integration().effort_rows.rows(), 1U);
  integration().go_to(integration().effort_rows.rows() - 1, 1.0);
  document().settle();
  EXPECT_EQ(document().shown()->index(), 1U);
  EXPECT_EQ(document().ping(), TestSurvey::kPings - 1);
}

TEST_F(Numbers, WhatIsStoppedLeavesWhatWasThere) {
  integrate();
  const auto before = integration().result();
  ASSERT_TRUE(integration().start());
  EXPECT_FALSE(integration().start()) << "it runs already";
  integration().stop();
  integration().settle();
  EXPECT_EQ(integration().result(), before);
  EXPECT_EQ(integration().told(), "stopped");
  document().open({TestSurvey::easy().folder()});
  integration().settle();
  EXPECT_EQ(integration().result(), nullptr) << "it was of the survey before";
}

// Fish 10 dB louder are a tenth as many.
TEST_F(Numbers, FishFollowEachChoice) {
  document().detect({0, 1});
  document().settle();
  fish().begin();
  FishParams params;
  params.relation = "cod";
  params.sd_length_cm = 0.0;
  params.mean_length_cm = 20.0;
  fish().params.assign(params);
  fish().settle();
  ASSERT_TRUE(fish().result()) << fish().told();
  const double few_cm = fish().result()->strata.back().numbers_seen;
  EXPECT_GT(few_cm, 0.0);
  EXPECT_TRUE(std::isnan(fish().result()->strata.back().biomass_seen_t));
  params.mean_length_cm = 20.0 * std::sqrt(10.0);
  params.weight_a_g = 0.01;
  fish().params.assign(params);
  fish().settle();
  EXPECT_NEAR(fish().result()->strata.back().numbers_seen / few_cm, 0.1, 1e-9);
  EXPECT_GT(fish().result()->strata.back().biomass_seen_t, 0.0);
  EXPECT_THAT(fish().told(), HasSubstr("strata follow"));
  EXPECT_THAT(fish().relation_text(), HasSubstr("StoX project coastalCod"));
  // Mackerel, 22.3 dB fainter at the same length, among what could be meant.
  fish().set_spans("mackerel", true);
  fish().settle();
  EXPECT_NEAR(fish().causes().second.relation.up_db, 22.3, 1e-6);
  integrate();
  fish().settle();
  EXPECT_TRUE(fish().result()->integrated);
  params.lengths = LengthsFrom::table;
  fish().params.assign(params);
  fish().settle();
  EXPECT_EQ(fish().result(), nullptr);
  EXPECT_THAT(fish().told(), HasSubstr("open a table of lengths"));
}

TEST_F(Numbers, WhatCannotBeMeasuredIsToldAndNobodyWaitsForIt) {
  paint(2, 4, 5, 5, 200);
  document().settle();
  ASSERT_TRUE(document().product(0));
  EXPECT_EQ(document().unmeasured(), "");
  document().use_memory(1'000'000);  // no ping fits
  paint(6, 7, 5, 5, 200);
  document().settle();
  ASSERT_EQ(document().state(0).schools.size(), 2U);
  EXPECT_FALSE(document().product(0));
  EXPECT_THAT(document().unmeasured(), HasSubstr("obs-0001: a ping of "));
  EXPECT_THAT(document().notices(), testing::Contains(document().unmeasured()));
  ASSERT_TRUE(integration().start());
  EXPECT_TRUE(integration().running()) << "it is tried once more";
  integration().settle();
  EXPECT_FALSE(integration().running());
  EXPECT_EQ(integration().told(), document().unmeasured());
  EXPECT_EQ(integration().progress().stage, "");
  document().use_memory(usual_memory());
  document().open_all();
  document().settle();
  EXPECT_TRUE(document().product(0));
  EXPECT_EQ(document().unmeasured(), "");
}

TEST_F(Numbers, TheClickedSchoolStaysWhateverRowItStandsIn) {
  document().detect({0, 1});
  document().settle();
  fish().begin();
  fish().settle();
  ASSERT_TRUE(fish().result()) << fish().told();
  const auto rows = fish().result()->schools;
  ASSERT_GE(rows.size(), 2U);
  fish().school_rows.select(1);
  const auto clicked = fish().causes();
  EXPECT_EQ(clicked.first, fmt::format("School {} of {}", rows[1].school_id, rows[1].observation));
  select(rows[0].school_id);
  ASSERT_EQ(rows[0].observation, document().shown()->name());
  press("review.reject");
  fish().settle();
  ASSERT_EQ(fish().result()->schools.size(), rows.size() - 1) << "the row above it is gone";
  EXPECT_EQ(fish().causes().first, clicked.first);
  EXPECT_EQ(fish().causes().second.fading.up_db, clicked.second.fading.up_db);
}

TEST_F(Numbers, FiguresRestWhileNobodyLooks) {
  document().detect({0});
  document().settle();
  fish().begin();
  fish().settle();
  const auto before = fish().result();
  ASSERT_TRUE(before);
  fish().end();
  FishParams params = fish().params.values();
  params.mean_length_cm += 10.0;
  fish().params.assign(params);
  fish().settle();
  EXPECT_EQ(fish().result(), before);
  fish().begin();
  fish().settle();
  EXPECT_NE(fish().result(), before);
}

// 10 dB above the program's -90.3 dB of mackerel: a tenth of the fish make the same echo.
TEST_F(Numbers, RelationsOfATableTakeThePlaceOfThePrograms) {
  document().detect({0});
  document().settle();
  fish().begin();
  FishParams params = fish().params.values();
  params.relation = "mackerel";
  fish().params.assign(params);
  fish().settle();
  ASSERT_TRUE(fish().result()) << fish().told();
  const double before = fish().result()->strata.back().numbers_seen;
  const fs::path table = TestSurvey::easy().fresh() / "ts.csv";
  std::ofstream(table) << "name,species,frequency_from_khz,frequency_to_khz,aspect,m_db,b_db,d_db,line_share,"
                          "any_aspect_share,heading_sd_deg,tilt_sd_deg,recalled,source\n"
                          "louder,mackerel,38,38,dorsal,20,-80.3,0,,,,,no,by hand\n";
  ASSERT_TRUE(fish().read_relations(table));
  EXPECT_EQ(fish().params.values().relation, "louder") << "the one chosen before is not among them";
  fish().settle();
  ASSERT_TRUE(fish().result()) << fish().told();
  EXPECT_NEAR(fish().result()->strata.back().numbers_seen / before, 0.1, 1e-9);
  std::ofstream(table) << "nonsense\n";
  EXPECT_FALSE(fish().read_relations(table));
  EXPECT_EQ(fish().relations().size(), 1U);
}

TEST_F(Numbers, ARelationThatNoTableHasAnyMoreIsNotCounted) {
  document().detect({0});
  document().settle();
  FishParams kept;
  kept.relation = "of a table that was open last week";
  fish().params.assign(kept);
  fish().begin();
  fish().settle();
  EXPECT_EQ(fish().params.values().relation, fish().relations().front().name);
  EXPECT_TRUE(fish().result()) << fish().told();
}

TEST_F(Numbers, TheChartOfSchoolsShowsSvOverIncidence) {
  show_incidence_chart(workspace());
  const auto x = workspace().picture_file.value("chart.x");
  const auto y = workspace().picture_file.value("chart.y");
  const auto table = workspace().picture_file.value("chart.table");
  ASSERT_TRUE(x && y && table);
  EXPECT_EQ(workspace().picture_file.values().kind.chart.table, ChartTable::school_pings);
}

}  // namespace
}  // namespace sonar
