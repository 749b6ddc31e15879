// SPDX-License-Identifier: Apache-2.0
#include "publish/chart_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "io/product_example.h"
#include "publish/picture.h"

namespace sonar {
namespace {

/// Two observations: schools of 4 and 3 pings in one, of 2 pings in the other.
class ChartPictures : public testing::Test {
 protected:
  ChartPictures() {
    ObservationProduct first = example::empty("obs-0001", 5);
    example::add_school(first, 1, 0, 3, example::block(1, 1, 2, 20, 8, 200));
    example::add_school(first, 2, 2, 4, example::block(0, 0, 3, 40, 5));
    first.schools[1].status = "rejected";
    ObservationProduct second = example::empty("obs-0002", 5, {60.1, 5.0}, example::kStart + 3600 * kSecondNs);
    example::add_school(second, 1, 1, 2, example::block(1, 1, 2, 20, 8, 200));
    source_ = PictureSource::of(nullptr, {first, second}, Recipe{});
    options_.size = {800, 600};
  }
  /// What stands in the picture, in one line; or why there is none.
  std::string words(const std::string& observation = "") {
    const auto frame = picture_frame(PictureKind::chart, *source_, observation, options_, work_);
    if (!frame) return to_line(frame.error());
    std::string out;
    for (const auto& item : frame->items) {
      if (const auto* text = std::get_if<TextItem>(&item)) out += text->text + "\n";
    }
    return out;
  }

  std::unique_ptr<PictureSource> source_;
  PictureOptions options_;
  Work work_{1};
};

TEST_F(ChartPictures, AreOfTheSurveyOrOfOneObservation) {
  EXPECT_THAT(words(), testing::HasSubstr("9 school pings"));
  EXPECT_THAT(words(), testing::HasSubstr("obs-0002/1"));
  EXPECT_THAT(words("obs-0001"), testing::HasSubstr("7 school pings"));
  EXPECT_THAT(words("obs-0001"), testing::HasSubstr("school 2, rejected"));
  EXPECT_THAT(words("obs-0009"), testing::HasSubstr("obs-0009"));
  options_.kind.chart.table = ChartTable::schools;
  EXPECT_THAT(words(), testing::HasSubstr("3 schools"));
}

TEST_F(ChartPictures, HaveTheSchoolsThatAreAskedFor) {
  options_.display.rejected = false;
  EXPECT_THAT(words(), testing::HasSubstr("6 school pings"));
  options_.display.rejected = true;
  options_.schools = {2};
  EXPECT_THAT(words(), testing::HasSubstr("3 school pings"));
  options_.schools = {7};
  EXPECT_THAT(words(), testing::HasSubstr("no school 7 in any observation"));
  EXPECT_THAT(words("obs-0002"), testing::HasSubstr("no school 7 in obs-0002"));
}

TEST_F(ChartPictures, TakeEveryColumnByItsName) {
  for (const ChartTable table : {ChartTable::school_pings, ChartTable::schools}) {
    options_.kind.chart.table = table;
    for (const ChartColumn& column : chart_columns(table)) {
      options_.kind.chart.x = column.name;
      options_.kind.chart.y.clear();
      const std::string said = words();
      EXPECT_TRUE(said.find(column_words(column)) != std::string::npos ||
                  said.find("is unknown in every row") != std::string::npos)
          << column.name << ": " << said;
    }
  }
  options_.kind.chart.x = "ping_index";
  EXPECT_THAT(words(), testing::HasSubstr("schools has no column ping_index"));
  options_.kind.chart.x = "dept_m";
  EXPECT_THAT(words(), testing::HasSubstr("schools has no column dept_m"));
}

TEST_F(ChartPictures, NeedSchoolsAndProducts) {
  ObservationProduct quiet = example::empty("obs-0001", 5);
  source_ = PictureSource::of(nullptr, {quiet}, Recipe{});
  EXPECT_THAT(words(), testing::HasSubstr("there are no schools to chart"));
}

}  // namespace
}  // namespace sonar
