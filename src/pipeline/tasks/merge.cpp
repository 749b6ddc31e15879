// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tasks/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "pipeline/tasks/join_tracks.h"

namespace sonar {
namespace {

Result<void> check_together(const std::vector<ObservationProduct>& products) {
  for (std::size_t i = 1; i < products.size(); ++i) {
    const ObservationProduct& a = products.front();
    const ObservationProduct& b = products[i];
    if (products[i - 1].observation == b.observation) {
      return fail(ErrorCode::mismatch, fmt::format("{} is there twice", b.observation));
    }
    if (a.recipe_hash != b.recipe_hash) {
      return fail(ErrorCode::mismatch, fmt::format("{} and {} were made with different recipes ({} and {})",
                                                   a.observation, b.observation, a.recipe_hash, b.recipe_hash));
    }
    if (a.stage_versions != b.stage_versions) {
      return fail(ErrorCode::mismatch, fmt::format("{} and {} were made by different stage versions ({}; {})",
                                                   a.observation, b.observation, a.stage_versions, b.stage_versions));
    }
  }
  return {};
}

}  // namespace

bool name_less(const std::string& a, const std::string& b) {
  return std::pair(a.size(), std::string_view(a)) < std::pair(b.size(), std::string_view(b));
}

Result<Survey> merge(std::vector<ObservationProduct> products, const std::optional<MergeParams>& given) {
  std::sort(products.begin(), products.end(),
            [](const auto& a, const auto& b) { return name_less(a.observation, b.observation); });
  if (auto checked = check_together(products); !checked) return pass_on(checked);
  for (ObservationProduct& product : products) {
    product.masks.clear();
    product.background_db.clear();
  }
  join_over_cuts(products, given);
  Survey survey;
  for (const ObservationProduct& product : products) {
    survey.schools.insert(survey.schools.end(), product.schools.begin(), product.schools.end());
    survey.school_pings.insert(survey.school_pings.end(), product.school_pings.begin(), product.school_pings.end());
  }
  survey.observations = std::move(products);
  return survey;
}

}  // namespace sonar
