// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/time.h"
#include "pipeline/tasks/merge.h"

namespace sonar {

/// A school's number in the survey, with what tells the school again when files, and so names of observations, were added.
struct SurveyNumber {
  std::int64_t number = 0;  ///< 1..
  std::string source;       ///< the observation's
  std::int64_t school_id = 0;
  TimeNs first_time = 0;
  TimeNs last_time = 0;
  friend bool operator==(const SurveyNumber&, const SurveyNumber&) = default;
};

/// Gives every school its number in the survey, in all its rows: the one that it had, or the next that nobody had, in the
/// order of the rows.
/// products  of the survey, in its order
/// earlier   as kept; a school is known by its number in the observation where its time overlaps
/// out       those to be kept: of schools that are gone too, whose numbers nobody gets; not of schools that are provisional
[[nodiscard]] std::vector<SurveyNumber> number_products(std::span<ObservationProduct> products,
                                                        std::vector<SurveyNumber> earlier);
/// The same, in the survey's tables too.
/// all  whether every observation of the survey is there; else as recall_numbers(), and those that were kept stay: a
///      number that would change with the next observation is none
[[nodiscard]] std::vector<SurveyNumber> number_schools(Survey& survey, std::vector<SurveyNumber> earlier, bool all);
/// Numbers a result's schools as its tables have them; all of them where it was not merged yet.
void number_as_merged(Survey& survey, const std::filesystem::path& out);

/// Gives the schools of products, in all their rows, the numbers that a merge gave them; 0 where it knows nothing of them.
void recall_numbers(std::span<ObservationProduct> products, const std::vector<SurveyNumber>& kept);

/// As number_products() where all observations of a survey are there, else as recall_numbers().
inline void number_known(std::span<ObservationProduct> products, const std::vector<SurveyNumber>& kept, bool all) {
  all ? void(number_products(products, kept)) : recall_numbers(products, kept);
}

/// Of a result's survey.json; empty where there is none, or it cannot be read.
[[nodiscard]] std::vector<SurveyNumber> kept_numbers(const std::filesystem::path& out);

}  // namespace sonar
