// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tasks/survey_numbers.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "pipeline/recipe/json_file.h"

namespace sonar {
namespace {

bool is_same(const SurveyNumber& kept, const std::string& source, const SchoolRow& school) {
  return kept.school_id == school.school_id && kept.source == source && kept.first_time <= school.last_time_utc &&
         school.first_time_utc <= kept.last_time;
}

std::set<std::int64_t> provisional_schools(const ObservationProduct& product) {
  std::set<std::int64_t> schools;
  for (const SchoolPingRow& row : product.school_pings) {
    if (row.provisional != 0) schools.insert(row.school_id);
  }
  return schools;
}

TimeNs overlap(const SurveyNumber& kept, const SchoolRow& school) {
  return std::min(kept.last_time, school.last_time_utc) - std::max(kept.first_time, school.first_time_utc);
}

/// The rows of each ping, as the schools are numbered.
void number_rows(ObservationProduct& product) {
  std::map<std::int64_t, std::int64_t> numbers;
  for (const SchoolRow& school : product.schools) numbers[school.school_id] = school.survey_school;
  for (SchoolPingRow& row : product.school_pings) row.survey_school = numbers[row.school_id];
}

/// No survey has as many schools; what follows the highest number is a number too.
constexpr std::int64_t kMostNumber = 1'000'000'000;

/// Empty where a result has none to tell: it was not merged yet, or by a program that gave none.
std::optional<std::vector<SurveyNumber>> told_numbers(const std::filesystem::path& out) {
  const auto json = read_json_file((out / "survey.json").string());
  if (!json || !json->is_object() || !json->contains("survey_schools")) return std::nullopt;
  std::vector<SurveyNumber> numbers;
  std::set<std::int64_t> taken;  // a number that stands twice is the first one's
  for (const auto& kept : json->at("survey_schools")) {
    if (!kept.is_object()) continue;
    const auto whole = [&](const char* member) {
      const auto found = kept.find(member);
      return found != kept.end() ? whole_number(*found).value_or(0) : 0;
    };
    SurveyNumber number{whole("survey_school"), "", whole("school_id"), whole("first_time_ns"), whole("last_time_ns")};
    if (kept.contains("source") && kept["source"].is_string()) number.source = kept["source"];
    if (number.number < 1 || number.number > kMostNumber || !taken.insert(number.number).second) continue;
    numbers.push_back(std::move(number));
  }
  return numbers;
}

}  // namespace

void recall_numbers(std::span<ObservationProduct> products, const std::vector<SurveyNumber>& kept) {
  for (ObservationProduct& product : products) {
    for (SchoolRow& school : product.schools) school.survey_school = 0;
  }
  // Where files were cut anew several rows may be what one was: the longest part of it keeps its number.
  for (const SurveyNumber& one : kept) {
    SchoolRow* longest = nullptr;
    for (ObservationProduct& product : products) {
      for (SchoolRow& school : product.schools) {
        if (school.survey_school > 0 || !is_same(one, product.source, school)) continue;
        if (longest == nullptr || overlap(one, school) > overlap(one, *longest)) longest = &school;
      }
    }
    if (longest != nullptr) longest->survey_school = one.number;
  }
  for (ObservationProduct& product : products) number_rows(product);
}

std::vector<SurveyNumber> number_products(std::span<ObservationProduct> products, std::vector<SurveyNumber> earlier) {
  std::int64_t next = 1;
  for (const SurveyNumber& kept : earlier) next = std::max(next, kept.number + 1);
  recall_numbers(products, earlier);
  for (ObservationProduct& product : products) {
    const std::set<std::int64_t> provisional = provisional_schools(product);
    for (SchoolRow& school : product.schools) {
      const bool had = school.survey_school > 0;
      if (!had) school.survey_school = next++;
      if (!had && !provisional.contains(school.school_id)) {
        earlier.push_back(
            {school.survey_school, product.source, school.school_id, school.first_time_utc, school.last_time_utc});
      }
    }
    number_rows(product);
  }
  return earlier;
}

std::vector<SurveyNumber> number_schools(Survey& survey, std::vector<SurveyNumber> earlier, bool all) {
  if (all) {
    earlier = number_products(survey.observations, std::move(earlier));
  } else {
    recall_numbers(survey.observations, earlier);
  }
  std::map<std::pair<std::string, std::int64_t>, std::int64_t> numbers;
  for (const ObservationProduct& product : survey.observations) {
    for (const SchoolRow& school : product.schools) {
      numbers[{product.observation, school.school_id}] = school.survey_school;
    }
  }
  for (SchoolRow& school : survey.schools) school.survey_school = numbers[{school.observation, school.school_id}];
  for (SchoolPingRow& row : survey.school_pings) row.survey_school = numbers[{row.observation, row.school_id}];
  return earlier;
}

void number_as_merged(Survey& survey, const std::filesystem::path& out) {
  auto told = told_numbers(out);
  const bool all = !told;
  (void)number_schools(survey, std::move(told).value_or(std::vector<SurveyNumber>{}), all);
}

std::vector<SurveyNumber> kept_numbers(const std::filesystem::path& out) {
  return told_numbers(out).value_or(std::vector<SurveyNumber>{});
}

}  // namespace sonar
