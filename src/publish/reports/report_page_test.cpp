// SPDX-License-Identifier: Apache-2.0
#include "publish/reports/report_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "io/product_example.h"
#include "publish/reports/report_facts.h"
#include "publish/reports/report_table.h"
#include "view/theme.h"

namespace sonar {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

std::unique_ptr<PictureSource> survey(int schools, const std::string& title = "SYNTHETIC example") {
  ObservationProduct product = example::empty("obs-0001", 5);
  product.title = title;
  for (int i = 1; i <= schools; ++i) {
    example::add_school(product, i, 0, 3, example::block(1, 1, 2, 20, 8, 200));
    SchoolRow& row = product.schools.back();
    row.backscatter_m2 = 1000.0 + i;
    row.survey_school = 5000 + i;
    row.depth_m = 20.0 + i % 60;
    row.status = i % 3 == 0 ? "accepted" : "unreviewed";
    if (i % 2 == 0) row.species = "a herring with a very long name that no column has room for";
  }
  return PictureSource::of(nullptr, {product}, Recipe{});
}

std::vector<std::string> texts(const FrameDescription& page) {
  std::vector<std::string> out;
  for (const auto& item : page.items) {
    if (const auto* text = std::get_if<TextItem>(&item)) out.push_back(text->text);
  }
  return out;
}

Result<FrameDescription> page_of(PictureSource& source) {
  Work work(1);
  return report_page(source, {}, work);
}

TEST(Report, HoldsTheStrongestSchoolsAndTheirNumber) {
  const auto source = survey(2000);
  const auto page = page_of(*source);
  ASSERT_TRUE(page) << to_line(page.error());
  EXPECT_EQ(page->size, (PixelSize{794, 1123})) << "A4";
  const auto words = texts(*page);
  EXPECT_THAT(words, Contains("7000")) << "the strongest";
  EXPECT_THAT(words, Contains("obs-0001/2000"));
  EXPECT_THAT(words, Contains("3000"));
  EXPECT_THAT(words, Contains(HasSubstr("2000, backscatter ")));
  EXPECT_THAT(words, Contains("5")) << "pings";
  EXPECT_THAT(words, Not(Contains("5001"))) << "the weakest has no room";
  EXPECT_THAT(words, Contains(HasSubstr("that are weaker")));
  EXPECT_THAT(words, Contains(HasSubstr("SYNTHETIC")));
}

/// Of one school, whose figures have errors where they are wanted.
std::vector<std::string> texts_of_one(bool errors) {
  ObservationProduct product = example::empty("obs-0001", 5);
  example::add_school(product, 1, 0, 3, example::block(1, 1, 2, 20, 8, 200));
  SchoolRow& row = product.schools.back();
  row.depth_m = 163.2;
  row.length_m = 123.4;
  row.sv_mean_db = -45.3;
  row.backscatter_total_m2 = 0.00512;
  row.backscatter_total_se_m2 = kUnknown;
  row.se = unknown_figures();
  if (errors) {
    row.se[error_at("depth_m")] = 12.4;
    row.se[error_at("length_m")] = 13.04;
    row.se[error_at("sv_mean_db")] = 0.7;
    row.backscatter_total_se_m2 = 0.0006;
  }
  const auto source = PictureSource::of(nullptr, {product}, Recipe{});
  const auto page = page_of(*source);
  return page ? texts(*page) : std::vector<std::string>{to_line(page.error())};
}

TEST(Report, FiguresHaveTheirErrorsBehindThem) {
  const auto words = texts_of_one(true);
  EXPECT_THAT(words, Contains("163.2 \u00B1 12.4"));
  EXPECT_THAT(words, Contains("123.4 \u00B1 13.0"));
  EXPECT_THAT(words, Contains("\u221245.3 \u00B1 0.7"));
  EXPECT_THAT(words, Contains("0.00512 \u00B1 0.00060"));
  EXPECT_THAT(words, Contains(HasSubstr("one standard error")));
}

TEST(Report, TellsNoErrorsWhereThereAreNone) {
  const auto words = texts_of_one(false);
  EXPECT_THAT(words, Contains("163.2"));
  EXPECT_THAT(words, Contains("123"));
  EXPECT_THAT(words, testing::Each(Not(HasSubstr("\u00B1"))));
}

TEST(Report, NothingLeavesThePaperOrItsNeighboursColumn) {
  for (const int schools : {0, 1, 5, 60, 2000}) {
    const auto source = survey(schools, std::string(300, 'W') + " SYNTHETIC");
    const auto page = page_of(*source);
    ASSERT_TRUE(page);
    EXPECT_THAT(texts(*page), Contains(testing::StartsWith("SYNTHETIC W"))) << "never shortened away";
    for (const auto& item : page->items) {
      const auto* text = std::get_if<TextItem>(&item);
      if (text == nullptr || text->turned_deg != 0.0) continue;
      const double width = text_width_px(text->text.c_str(), text->size_px);
      const double left = text->at.x - (text->anchor == TextAnchor::left     ? 0.0
                                        : text->anchor == TextAnchor::centre ? width / 2.0
                                                                             : width);
      EXPECT_GE(left, 0.0) << text->text;
      EXPECT_LE(left + 0.9 * width, 794.0) << text->text;
      EXPECT_GE(text->at.y, 30.0) << text->text;
      EXPECT_LE(text->at.y, 1093.0) << text->text;
    }
  }
}

TEST(Report, SaysWhatIsMissing) {
  auto source = survey(0);
  EXPECT_THAT(texts(*page_of(*source)), Contains("No school was found."));
  ObservationProduct nowhere = example::empty("obs-0001", 5);
  for (PingNavigation& ping : nowhere.pings) ping.transducer = PingNavigation{}.transducer;
  source = PictureSource::of(nullptr, {nowhere}, Recipe{});
  const auto page = page_of(*source);
  ASSERT_TRUE(page) << "no positions are no reason for no report";
  EXPECT_THAT(texts(*page), Contains(HasSubstr("no ping of the survey has a position")));
  EXPECT_THAT(texts(*page), Contains("no ping has a position"));
}

TEST(ReportFacts, CountWhatTotalsCount) {
  ObservationProduct product = example::empty("obs-0001", 5);
  for (int i = 1; i <= 3; ++i) {
    example::add_school(product, i, 0, 3, example::block(1, 1, 2, 20, 8, 200));
    product.schools.back().backscatter_m2 = i;
    product.schools.back().backscatter_total_se_m2 = 0.1 * i;
  }
  product.schools[2].status = "rejected";
  product.schools[1].continues = "obs-0001/1";
  product.pings[1].bad = true;
  const auto source = PictureSource::of(nullptr, {product}, Recipe{});
  const ReportFacts facts = report_facts(source->observations(), Recipe{});
  ASSERT_EQ(facts.schools.size(), 1U) << "the second row is part of the first school";
  EXPECT_TRUE(std::isnan(facts.schools[0].backscatter_se_m2)) << "of two rows";
  EXPECT_EQ(facts.rejected, 1U);
  const auto line = [&](const std::string& name) {
    for (const auto& [key, value] : facts.lines) {
      if (key == name) return value;
    }
    return std::string();
  };
  EXPECT_EQ(line("Pings"), "5, 1 of them bad");
  EXPECT_THAT(line("Schools"), HasSubstr("1 rejected, not counted"));
  EXPECT_THAT(line("Program"), testing::StartsWith("Sonar Explorer "));
}

// 63.2 m are 34.56 fathoms of 1.8288 m.
TEST(ReportTable, ErrorsAreInTheUnitOfTheirFigures) {
  ReportSchool school;
  school.depth_m = 63.2;
  school.depth_se_m = 1.4;
  school.backscatter_m2 = 2.34e-4;
  school.backscatter_se_m2 = 2e-5;
  Theme theme = light_theme({794, 1123});
  theme.units.lengths = LengthUnit::fathoms;
  FrameDescription page;
  add_report_table(page, {40.0, 40.0, 714.0, 100.0}, std::vector{school}, theme);
  EXPECT_THAT(texts(page), Contains("34.6 \u00B1 0.8"));
  EXPECT_THAT(texts(page), Contains("(2.34 \u00B1 0.20)e-04"));
}

TEST(ReportTable, HasNoMoreRowsThanRoom) {
  EXPECT_EQ(report_rows(10.0), 0U);
  EXPECT_EQ(report_rows(4.0 * kReportRow_px), 3U);
}

}  // namespace
}  // namespace sonar
