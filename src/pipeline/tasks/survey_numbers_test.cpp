// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tasks/survey_numbers.h"

#include <gmock/gmock.h>

#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "io/simrad/test_bytes.h"

namespace sonar {
namespace {

using testing::ElementsAre;

/// Two observations of one sounder, a minute each, with schools that are seen from `first` to `last` (s).
struct Seen {
  std::int64_t school_id;
  int first;
  int last;
  bool provisional = false;
};

ObservationProduct observation(const std::string& name, const std::vector<Seen>& schools) {
  ObservationProduct product;
  product.observation = name;
  product.source = "MS70";
  for (const Seen& seen : schools) {
    SchoolRow school;
    school.observation = name;
    school.school_id = seen.school_id;
    school.first_time_utc = seen.first * kSecondNs;
    school.last_time_utc = seen.last * kSecondNs;
    product.schools.push_back(school);
    SchoolPingRow row;
    row.observation = name;
    row.school_id = seen.school_id;
    row.provisional = seen.provisional ? 1 : 0;
    product.school_pings.push_back(row);
  }
  return product;
}

Survey survey_of(std::vector<ObservationProduct> products) {
  auto survey = merge(std::move(products));
  return survey ? std::move(*survey) : Survey{};
}

std::vector<std::int64_t> numbers_in(const Survey& survey) {
  std::vector<std::int64_t> numbers;
  for (const SchoolRow& school : survey.schools) numbers.push_back(school.survey_school);
  return numbers;
}

TEST(SurveyNumbers, RiseWithTheRowsAndStandInAllTables) {
  Survey survey = survey_of({observation("obs-0002", {{1, 70, 80}}), observation("obs-0001", {{1, 5, 9}, {2, 6, 20}})});
  const auto kept = number_schools(survey, {}, true);
  EXPECT_THAT(numbers_in(survey), ElementsAre(1, 2, 3));
  EXPECT_EQ(survey.school_pings[2].survey_school, 3);
  EXPECT_EQ(survey.observations[1].schools[0].survey_school, 3);
  EXPECT_EQ(survey.observations[1].school_pings[0].survey_school, 3);
  EXPECT_EQ(kept.size(), 3U);
}

// While observations are missing a number would change with the next one: there is none, but for schools that had one.
TEST(SurveyNumbers, AreGivenOnceAllObservationsAreThere) {
  const ObservationProduct first = observation("obs-0001", {{1, 5, 9}, {2, 6, 20}});
  const ObservationProduct second = observation("obs-0002", {{1, 70, 80}});
  Survey part = survey_of({second});
  auto kept = number_schools(part, {}, false);
  EXPECT_THAT(numbers_in(part), ElementsAre(0));
  EXPECT_EQ(part.school_pings[0].survey_school, 0);
  EXPECT_TRUE(kept.empty());
  Survey all = survey_of({first, second});
  kept = number_schools(all, kept, true);
  EXPECT_THAT(numbers_in(all), ElementsAre(1, 2, 3));
  Survey grown = survey_of({second, observation("obs-0003", {{1, 170, 180}})});
  EXPECT_EQ(number_schools(grown, kept, false), kept);
  EXPECT_THAT(numbers_in(grown), ElementsAre(3, 0));
  EXPECT_EQ(grown.school_pings[0].survey_school, 3);
  EXPECT_EQ(grown.observations[0].school_pings[0].survey_school, 3);
}

// Whoever reads products later: they hold no numbers of the survey.
TEST(SurveyNumbers, AreRecalledForProducts) {
  Survey survey = survey_of({observation("obs-0002", {{1, 70, 80}}), observation("obs-0001", {{1, 5, 9}, {2, 6, 20}})});
  const auto kept = number_schools(survey, {}, true);
  std::vector<ObservationProduct> read{observation("obs-0002", {{1, 70, 80}, {2, 75, 80}})};
  recall_numbers(read, kept);
  EXPECT_EQ(read[0].schools[0].survey_school, 3);
  EXPECT_EQ(read[0].schools[1].survey_school, 0);
  EXPECT_EQ(read[0].school_pings[0].survey_school, 3);
}

// A file was added before the others: observations have other names, schools keep their numbers.
TEST(SurveyNumbers, StayWhenFilesAreAdded) {
  Survey before = survey_of({observation("obs-0001", {{1, 105, 109}, {2, 106, 120}})});
  const auto kept = number_schools(before, {}, true);
  Survey after =
      survey_of({observation("obs-0001", {{1, 5, 9}}), observation("obs-0002", {{1, 105, 109}, {2, 104, 121}})});
  const auto now = number_schools(after, kept, true);
  EXPECT_THAT(numbers_in(after), ElementsAre(3, 1, 2));
  EXPECT_EQ(now.size(), 3U);
}

TEST(SurveyNumbers, OfSchoolsThatAreGoneNobodyGets) {
  Survey before = survey_of({observation("obs-0001", {{1, 5, 9}, {2, 6, 20}})});
  auto kept = number_schools(before, {}, true);
  Survey without = survey_of({observation("obs-0001", {{1, 5, 9}})});
  kept = number_schools(without, kept, true);
  Survey another = survey_of({observation("obs-0001", {{1, 5, 9}, {3, 30, 40}})});
  (void)number_schools(another, kept, true);
  EXPECT_THAT(numbers_in(another), ElementsAre(1, 3));
}

TEST(SurveyNumbers, OfProvisionalSchoolsAreNotKept) {
  Survey live = survey_of({observation("obs-0001", {{1, 5, 9, true}, {2, 6, 20, true}})});
  const auto kept = number_schools(live, {}, true);
  EXPECT_THAT(numbers_in(live), ElementsAre(1, 2));
  EXPECT_TRUE(kept.empty());
  Survey over = survey_of({observation("obs-0001", {{2, 6, 20}})});
  (void)number_schools(over, kept, true);
  EXPECT_THAT(numbers_in(over), ElementsAre(1));
}

TEST(SurveyNumbers, AnotherSoundersSchoolIsAnotherOne) {
  Survey first = survey_of({observation("obs-0001", {{1, 5, 9}})});
  const auto kept = number_schools(first, {}, true);
  ObservationProduct other = observation("obs-0001", {{1, 5, 9}});
  other.source = "ME70";
  Survey second = survey_of({other});
  (void)number_schools(second, kept, true);
  EXPECT_THAT(numbers_in(second), ElementsAre(2));
}

// Files cut anew: two rows are what one was. Its longer part keeps the number, the other gets one of its own.
TEST(SurveyNumbers, AreGivenOnceHoweverObservationsAreCut) {
  Survey before = survey_of({observation("obs-0001", {{1, 0, 40}})});
  const auto kept = number_schools(before, {}, true);
  Survey after =
      survey_of({observation("obs-0001", {{1, 0, 10}}), observation("obs-0002", {{1, 11, 40}, {2, 20, 30}})});
  const auto again = number_schools(after, kept, true);
  EXPECT_THAT(numbers_in(after), ElementsAre(2, 1, 3));
  EXPECT_EQ(again.size(), 3U);
}

// Of a survey.json that somebody edited: the number after the highest is one too.
TEST(SurveyNumbers, AbsurdOnesAreNotKept) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "survey.json")
      << R"({"survey_schools": [7, {"survey_school": 9223372036854775807}, {"survey_school": 18446744073709551615},
             {"survey_school": -4}, {"survey_school": 12, "source": "MS70", "school_id": 1},
             {"survey_school": 12, "source": "MS70", "school_id": 2}]})";
  const auto kept = kept_numbers(folder.path());
  ASSERT_EQ(kept.size(), 1U);
  std::vector<ObservationProduct> products{observation("obs-0001", {{2, 5, 9}})};
  (void)number_products(products, kept);
  EXPECT_EQ(products[0].schools[0].survey_school, 13);
}

}  // namespace
}  // namespace sonar
