// SPDX-License-Identifier: Apache-2.0
#include "pipeline/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>

#include "base/units.h"
#include "geo/geodesic.h"
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

const SchoolPingRow* end_row(const ObservationProduct& product, std::int64_t school_id, bool last) {
  const SchoolPingRow* found = nullptr;
  for (const SchoolPingRow& row : product.school_pings) {
    if (row.school_id != school_id) continue;
    found = &row;
    if (!last) break;
  }
  return found;
}

/// A pair of tracks that may be one school.
struct Join {
  double miss_m;
  std::int64_t before_id;
  std::int64_t after_id;
  [[nodiscard]] auto key() const { return std::tuple(miss_m, before_id, after_id); }
};

double known(double value, double otherwise) { return std::isfinite(value) ? value : otherwise; }

/// Distance between where the earlier track would be by then and where the later one begins; negative = outside.
double miss(const SchoolRow& school, const SchoolPingRow& end, const SchoolRow& next, const SchoolPingRow& begin,
            const MergeParams& params) {
  const Geographic from{end.latitude, end.longitude};
  const Geographic to{begin.latitude, begin.longitude};
  if (!std::isfinite(from.latitude_deg) || !std::isfinite(to.latitude_deg)) return -1.0;
  const double seconds = static_cast<double>(begin.time_utc - end.time_utc) / 1e9;
  const bool moves = std::isfinite(school.speed_mps) && std::isfinite(school.course_deg);
  const Geographic predicted = moves ? destination(from, school.speed_mps * seconds, school.course_deg) : from;
  const double gate_m = params.gate_m + params.length_share * (known(school.length_m, 0.0) + known(next.length_m, 0.0));
  const double depth_m = std::abs(known(end.depth_m, 0.0) - known(begin.depth_m, 0.0));
  const double distance_m = geodesic(predicted, to).distance_m;
  return distance_m <= gate_m && depth_m <= params.depth_gate_m ? distance_m : -1.0;
}

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

/// Nearest pairs first, each track once.
void join_over_cut(const ObservationProduct& before, ObservationProduct& after, const MergeParams& params) {
  std::vector<std::int64_t> taken;
  for (const Join& join : possible_joins(before, after, params)) {
    const auto next = std::find_if(after.schools.begin(), after.schools.end(),
                                   [&](const SchoolRow& s) { return s.school_id == join.after_id; });
    const bool used = std::find(taken.begin(), taken.end(), join.before_id) != taken.end();
    if (used || !next->continues.empty()) continue;
    next->continues = fmt::format("{}/{}", before.observation, join.before_id);
    taken.push_back(join.before_id);
  }
}

/// Those that the products were made with.
MergeParams merge_params_of(const std::vector<ObservationProduct>& products) {
  if (products.empty()) return {};
  const auto recipe = recipe_from_text(products.front().recipe_json);
  return recipe ? recipe->merge : MergeParams{};
}

}  // namespace

bool name_less(const std::string& a, const std::string& b) {
  return std::pair(a.size(), std::string_view(a)) < std::pair(b.size(), std::string_view(b));
}

Result<Survey> merge(std::vector<ObservationProduct> products, const std::optional<MergeParams>& given) {
  std::sort(products.begin(), products.end(),
            [](const auto& a, const auto& b) { return name_less(a.observation, b.observation); });
  if (auto checked = check_together(products); !checked) return pass_on(checked);
  const MergeParams params = given ? *given : merge_params_of(products);
  for (ObservationProduct& product : products) {
    product.masks.clear();
    product.background_db.clear();
  }
  for (std::size_t i = 1; i < products.size(); ++i) {
    if (is_cut(products[i - 1], products[i])) join_over_cut(products[i - 1], products[i], params);
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
