// SPDX-License-Identifier: Apache-2.0
#include "session/marks/transects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "session/test_app.h"

namespace sonar {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Transects : public testing::Test, protected TestApp {
 protected:
  Transects() { begin(); }
  [[nodiscard]] Rows& list() { return *app_->rows("marks"); }
  [[nodiscard]] std::vector<std::string> column(std::size_t at) {
    std::vector<std::string> texts;
    for (std::size_t row = 0; row < list().rows(); ++row) texts.push_back(list().cell(row, at).text);
    return texts;
  }
  [[nodiscard]] std::string time(std::size_t observation, std::size_t ping) {
    return iso_time(document().survey()->observations[observation].navigation[ping].time);
  }
  /// Chosen as a human does, by the action.
  void choose(const std::string& text) {
    const std::filesystem::path file = folder_ / "transects.csv";
    std::filesystem::create_directories(folder_);
    std::ofstream(file) << "name,stratum,type,start_utc,stop_utc\n" << text;
    app_->dialogs.file_to_open = [file](const auto&, const auto&) { return file.string(); };
    press("transects.open");
    document().settle();
  }
  std::filesystem::path folder_ = TestSurvey::easy().fresh();
};

TEST_F(Transects, StandAmongTheMarksAndAClickGoesWhereOneBegins) {
  EXPECT_EQ(list().rows(), 0U);
  choose("T1,north,transect," + time(0, 2) + "," + time(0, 6) + "\n,,off," + time(0, 4) + "," + time(0, 5) +
         "\nlater,,transect,2199-01-01T00:00:00Z,2199-01-02T00:00:00Z\n");
  EXPECT_THAT(document().notices().back(), HasSubstr("transects.csv: 3 periods, 2 of them in this survey"));
  EXPECT_THAT(column(0), ElementsAre("transect", "off effort"));
  EXPECT_THAT(column(1), ElementsAre("T1 (stratum north)", ""));
  list().select(1);
  document().settle();
  EXPECT_EQ(document().ping(), survey_periods(app_->workspace).at(1).first_ping);
  EXPECT_EQ(document().ping(), 4);
  press("transects.none");
  EXPECT_EQ(list().rows(), 0U);
}

TEST_F(Transects, ATableThatIsWrongIsToldAndLeavesWhatWasThere) {
  choose("T1,north,transect," + time(0, 2) + "," + time(0, 6) + "\n");
  choose("T1,north,line," + time(0, 2) + "," + time(0, 6) + "\n");
  EXPECT_THAT(document().notices().back(), HasSubstr("line 2: type 'line'"));
  EXPECT_THAT(column(0), ElementsAre("transect"));
}

TEST_F(Transects, AreThereAgainWhenTheSurveyIsOpenedAgain) {
  choose("T1,north,transect," + time(0, 2) + "," + time(0, 6) + "\n");
  document().open({TestSurvey::easy().folder()});
  document().settle();
  EXPECT_THAT(column(0), ElementsAre("transect"));
  EXPECT_EQ(file_of(app_->preferences.transects, TestSurvey::easy().folder()), folder_ / "transects.csv");
}

}  // namespace
}  // namespace sonar
