// SPDX-License-Identifier: Apache-2.0
#include "pipeline/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>

#include "model/school_totals.h"
#include "pipeline/join_tracks.h"
#include "pipeline/recipe.h"

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

bool same_grid(const ObservationProduct& a, const ObservationProduct& b) {
  return a.grid && b.grid && a.grid->grid == b.grid->grid && a.grid->range.spacing_m == b.grid->range.spacing_m;
}

/// Whether `after` goes on where `before` was cut because it had become too long; nothing else is a cut.
bool is_cut(const ObservationProduct& before, const ObservationProduct& after) {
  if (before.pings.empty() || before.source != after.source || !same_grid(before, after)) return false;
  return after.cut_after != 0 && after.cut_after == before.pings.back().time;
}

/// A pair of tracks that may be one school.
struct Join {
  double miss_m;
  std::int64_t before_id;
  std::int64_t after_id;
  [[nodiscard]] auto key() const { return std::tuple(miss_m, before_id, after_id); }
};

std::vector<Join> possible_joins(const ObservationProduct& before, const ObservationProduct& after,
                                 const MergeParams& params) {
  std::vector<Join> joins;
  const auto last_ping = static_cast<std::int64_t>(before.pings.size()) - 1;
  for (const SchoolRow& school : before.schools) {
    const SchoolPingRow* end = end_row(before, school.school_id, true);
    if (end == nullptr || end->ping_index < last_ping - params.edge_pings) continue;
    for (const SchoolRow& next : after.schools) {
      const SchoolPingRow* begin = end_row(after, next.school_id, false);
      if (begin == nullptr || begin->ping_index > params.edge_pings) continue;
      const double miss_m = miss(school, *end, next, *begin, params);
      if (miss_m >= 0.0) joins.push_back({miss_m, school.school_id, next.school_id});
    }
  }
  std::sort(joins.begin(), joins.end(), [](const Join& a, const Join& b) { return a.key() < b.key(); });
  return joins;
}

/// Where a school has several rows of one observation, the one that the others go on from.
SchoolRow& first_part(std::vector<SchoolRow>& rows, std::int64_t school_id) {
  const auto row = [&](auto wanted) { return std::find_if(rows.begin(), rows.end(), wanted); };
  auto part = row([&](const SchoolRow& s) { return s.school_id == school_id; });
  for (std::size_t steps = 0; steps < rows.size(); ++steps) {
    const auto whole =
        row([&](const SchoolRow& s) { return part->continues == school_name(s.observation, s.school_id); });
    if (whole == rows.end()) break;
    part = whole;
  }
  return *part;
}

/// Nearest pairs first, each track once.
/// rows  of `after`
void join_over_cut(const ObservationProduct& before, const ObservationProduct& after, const MergeParams& params,
                   std::vector<SchoolRow>& rows) {
  std::vector<std::int64_t> taken;
  for (const Join& join : possible_joins(before, after, params)) {
    SchoolRow& next = first_part(rows, join.after_id);
    const bool used = std::find(taken.begin(), taken.end(), join.before_id) != taken.end();
    if (used || !next.continues.empty()) continue;
    next.continues = school_name(before.observation, join.before_id);
    taken.push_back(join.before_id);
  }
}

/// Those that the products were made with.
MergeParams merge_params_of(std::span<const ObservationProduct* const> products) {
  const auto first = std::find_if(products.begin(), products.end(), [](const auto* one) { return one != nullptr; });
  if (first == products.end()) return {};
  const auto recipe = recipe_from_text((*first)->recipe_json);
  return recipe ? recipe->merge : MergeParams{};
}

}  // namespace

bool name_less(const std::string& a, const std::string& b) {
  return std::pair(a.size(), std::string_view(a)) < std::pair(b.size(), std::string_view(b));
}

std::vector<std::vector<SchoolRow>> joined_rows(std::span<const ObservationProduct* const> products,
                                                const std::optional<MergeParams>& given) {
  const MergeParams params = given ? *given : merge_params_of(products);
  std::vector<std::vector<SchoolRow>> rows;
  for (std::size_t i = 0; i < products.size(); ++i) {
    rows.push_back(products[i] == nullptr ? std::vector<SchoolRow>{} : products[i]->schools);
    const bool both = i > 0 && products[i - 1] != nullptr && products[i] != nullptr;
    if (both && is_cut(*products[i - 1], *products[i])) {
      join_over_cut(*products[i - 1], *products[i], params, rows.back());
    }
  }
  return rows;
}

Result<Survey> merge(std::vector<ObservationProduct> products, const std::optional<MergeParams>& given) {
  std::sort(products.begin(), products.end(),
            [](const auto& a, const auto& b) { return name_less(a.observation, b.observation); });
  if (auto checked = check_together(products); !checked) return pass_on(checked);
  std::vector<const ObservationProduct*> in_order;
  for (const ObservationProduct& product : products) in_order.push_back(&product);
  std::vector<std::vector<SchoolRow>> rows = joined_rows(in_order, given);
  for (std::size_t i = 0; i < products.size(); ++i) {
    products[i].masks.clear();
    products[i].background_db.clear();
    products[i].schools = std::move(rows[i]);
  }
  Survey survey;
  for (const ObservationProduct& product : products) {
    survey.schools.insert(survey.schools.end(), product.schools.begin(), product.schools.end());
    survey.school_pings.insert(survey.school_pings.end(), product.school_pings.begin(), product.school_pings.end());
  }
  survey.observations = std::move(products);
  return survey;
}

}  // namespace sonar
