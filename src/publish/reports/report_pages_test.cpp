// SPDX-License-Identifier: Apache-2.0
#include "publish/reports/report_pages.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "io/product_example.h"
#include "publish/reports/report_html.h"
#include "view/shapes.h"

namespace sonar {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::Ge;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Le;
using testing::SizeIs;

/// Remembers what it is given to write as a heading.
class Headings : public ReportWriter {
 public:
  std::vector<std::string> texts;
  void title(const std::string& text) override { texts.push_back(text); }
  void heading(const std::string& text) override { texts.push_back(text); }
  void subheading(const std::string& text) override { texts.push_back(text); }
  void paragraph(const std::string&) override {}
  void words(const NamedWords&) override {}
  void begin_pair() override {}
  void end_pair() override {}
  Result<void> picture(const FrameDescription&, const std::string&) override { return {}; }
  void table(const CsvTable&, const std::string&, std::size_t) override {}
  void plain_text(const std::string&) override {}
  void closing(const std::string&) override {}
};

std::vector<std::string> texts(const FrameDescription& page) {
  std::vector<std::string> out;
  for (const auto& item : page.items) {
    if (const auto* text = std::get_if<TextItem>(&item)) out.push_back(text->text);
  }
  return out;
}

std::vector<std::string> texts(const std::vector<FrameDescription>& pages) {
  std::vector<std::string> out;
  for (const FrameDescription& page : pages) {
    const auto more = texts(page);
    out.insert(out.end(), more.begin(), more.end());
  }
  return out;
}

std::size_t count_of_text(const std::vector<std::string>& all, std::string_view text) {
  return static_cast<std::size_t>(std::count(all.begin(), all.end(), text));
}

/// Nothing that the pages themselves wrote is off the paper.
void expect_on_paper(const std::vector<FrameDescription>& pages) {
  for (const FrameDescription& page : pages) {
    EXPECT_EQ(page.size, (PixelSize{794, 1123})) << "A4";
    for (const auto& item : page.items) {
      const auto* text = std::get_if<TextItem>(&item);
      if (text == nullptr) continue;
      const double width = text_width_px(text->text.c_str(), text->size_px);
      const double left = text->anchor == TextAnchor::right ? text->at.x - width : text->at.x;
      EXPECT_THAT(left, Ge(39.0)) << text->text;
      EXPECT_THAT(left + width, Le(755.0)) << text->text;
      EXPECT_THAT(text->at.y, AllOf(Ge(40.0), Le(1083.0))) << text->text;
    }
  }
}

/// ROWS rows of an observation, a school, and so many columns of numbers.
CsvTable wide_table(int rows, int columns) {
  std::string text = "sv_before_db,observation,school_id,nothing";
  for (int c = 0; c < columns; ++c) text += fmt::format(",column_number_{}", c);
  text += "\n";
  for (int r = 0; r < rows; ++r) {
    text += fmt::format("-50.{},obs-{:04},{},", r % 10, r, 7000 + r);
    for (int c = 0; c < columns; ++c) text += fmt::format(",{}.125", 100 * c);
    text += "\n";
  }
  return parse_csv(text, "a test").value();
}

std::vector<FrameDescription> pages_of(const CsvTable& table, std::size_t most = 2000) {
  ReportPages report;
  report.title("SYNTHETIC example");
  report.heading("A table");
  report.table(table, "What it is", most);
  return std::move(report).pages();
}

TEST(ReportPages, ATableOf200RowsHasItsHeadsOnEveryPage) {
  const auto pages = pages_of(wide_table(200, 2));
  ASSERT_THAT(pages, SizeIs(Ge(3U)));
  std::vector<std::string> keys;
  for (const FrameDescription& page : pages) {
    const auto all = texts(page);
    EXPECT_EQ(count_of_text(all, "observation"), 1U);
    EXPECT_EQ(count_of_text(all, "school_"), 1U) << "broken, as its column is narrow";
    EXPECT_THAT(all, Contains(HasSubstr(fmt::format(" of {}", pages.size()))));
    for (const std::string& one : all) {
      if (one.starts_with("obs-")) keys.push_back(one);
    }
  }
  ASSERT_THAT(keys, SizeIs(200)) << "each row once";
  for (std::size_t r = 0; r < keys.size(); ++r) EXPECT_EQ(keys[r], fmt::format("obs-{:04}", r));
  EXPECT_EQ(count_of_text(texts(pages), "nothing"), 0U) << "a column without values";
  expect_on_paper(pages);
}

TEST(ReportPages, WhatIsWiderThanAPageIsCutIntoBlocksThatTellTheirRows) {
  const CsvTable table = wide_table(3, 40);
  const auto blocks = column_blocks(table, 3, 714.0, 8.0);
  ASSERT_THAT(blocks, SizeIs(Ge(3U)));
  std::vector<std::size_t> others;
  for (const auto& block : blocks) {
    ASSERT_THAT(block, SizeIs(Ge(3U)));
    EXPECT_EQ(block[0].index, 1U);
    EXPECT_EQ(block[1].index, 2U);
    double width = 0.0;
    for (const PaperColumn& column : block) width += column.width_px;
    EXPECT_LE(width, 714.0);
    for (std::size_t i = 2; i < block.size(); ++i) others.push_back(block[i].index);
  }
  std::vector<std::size_t> all{0};
  for (std::size_t i = 4; i < table.header.size(); ++i) all.push_back(i);
  EXPECT_EQ(others, all) << "every column with values once, in their order";
  const auto pages = pages_of(table);
  EXPECT_EQ(count_of_text(texts(pages), "obs-0002"), blocks.size());
  expect_on_paper(pages);
}

TEST(ReportPages, WithoutKeysTheFirstColumnTellsTheRows) {
  const auto table = parse_csv("stratum,a,b\nnorth,1,2\n", "a test");
  ASSERT_TRUE(table);
  const auto blocks = column_blocks(*table, 1, 20.0, 8.0);
  ASSERT_THAT(blocks, SizeIs(2));
  EXPECT_EQ(blocks[1][0].index, 0U);
  EXPECT_EQ(blocks[1][1].index, 2U);
}

TEST(ReportPages, LongWordsAreBrokenAndNothingIsLost) {
  const std::string name(300, 'W');
  std::string together;
  for (const std::string& line : text_lines(name, 100.0, 8.0)) {
    EXPECT_LE(text_width_px(line.c_str(), 8.0), 100.0);
    together += line;
  }
  EXPECT_EQ(together, name);
  EXPECT_THAT(text_lines("sv_mean_corrected", text_width_px("sv_mean_co", 8.0), 8.0),
              ElementsAre("sv_mean_", "corrected"));
  EXPECT_THAT(text_lines("a\nb", 100.0, 8.0), ElementsAre("a", "b"));
  EXPECT_THAT(text_lines("", 100.0, 8.0), SizeIs(1));
  EXPECT_THAT(text_lines("\u00F8\u00F8", 1.0, 8.0), ElementsAre("\u00F8", "\u00F8")) << "never inside a character";
  std::string rows = "observation,text\n";
  for (int r = 0; r < 30; ++r) rows += "obs-0001," + name + name + name + name + "\n";
  expect_on_paper(pages_of(parse_csv(rows, "a test").value()));
}

TEST(ReportPages, AHeadingIsOnThePageOfWhatItHeads) {
  FrameDescription picture;
  picture.size = {700, 500};
  picture.background = {9, 9, 9, 255};
  for (int lines = 20; lines < 80; lines += 5) {
    ReportPages report;
    for (int i = 0; i < lines; ++i) report.paragraph("words");
    report.heading("The picture");
    ASSERT_TRUE(report.picture(picture, "its caption"));
    const auto pages = std::move(report).pages();
    bool found = false;
    for (const FrameDescription& page : pages) {
      const auto all = texts(page);
      if (count_of_text(all, "The picture") == 0) continue;
      found = true;
      EXPECT_EQ(count_of_text(all, "its caption"), 1U) << lines;
    }
    EXPECT_TRUE(found);
    expect_on_paper(pages);
  }
}

TEST(ReportPages, EveryWriterHasEveryHeadingOfTheContents) {
  ObservationProduct product = example::empty("obs-0001", 5);
  product.title = "SYNTHETIC example";
  example::add_school(product, 1, 0, 3, example::block(1, 1, 2, 20, 8, 200));
  product.schools.back().backscatter_m2 = 1000.0;
  const auto source = PictureSource::of(nullptr, {product}, Recipe{});
  PictureOptions options;
  options.volume.frames = 1;
  Work work(1);
  Headings headings;
  ASSERT_TRUE(write_report(headings, *source, {}, options, work));
  EXPECT_THAT(headings.texts, IsSupersetOf({"Where and when", "Schools", "Charts", "The strongest schools",
                                            "obs-0001/1", "Echo integration and effort", "Observations and raw files",
                                            "What was noted", "Recipe", "What the columns are"}));
  const auto html = report_html(*source, {}, options, work);
  ASSERT_TRUE(html);
  const auto pages = report_pages(*source, {}, options, work);
  ASSERT_TRUE(pages);
  const auto all = texts(*pages);
  std::size_t at = 0;
  for (std::size_t i = 0; i < headings.texts.size(); ++i) {
    const std::string& text = headings.texts[i];
    at = html->find(">" + text + "</h", at);
    EXPECT_NE(at, std::string::npos) << text << ", in the order of the contents";
    EXPECT_THAT(all, Contains(text));
  }
  EXPECT_THAT(pages->front().origin.program, testing::StartsWith("Sonar Explorer "));
  // Its tables are in metres, whatever a window reads.
  options.units = {LengthUnit::feet, SpeedUnit::knots};
  const auto in_feet = report_html(*source, {}, options, work);
  ASSERT_TRUE(in_feet);
  EXPECT_EQ(*in_feet, *html) << "one unit in one report";
}

}  // namespace
}  // namespace sonar
