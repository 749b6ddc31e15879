// SPDX-License-Identifier: Apache-2.0
#include "model/school_totals.h"

#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>

namespace sonar {
namespace {

std::size_t root_of(std::vector<std::size_t>& parent, std::size_t row) {
  while (parent[row] != row) row = parent[row] = parent[parent[row]];
  return row;
}

/// Mean over pings of what several rows tell; of those without an edge alone, where there are any.
struct Mean {
  double whole_sum = 0.0;
  double all_sum = 0.0;
  double whole_pings = 0.0;
  double all_pings = 0.0;

  void add(const SchoolRow& row) {
    if (!std::isfinite(row.backscatter_m2)) return;
    const auto whole = static_cast<double>(row.n_pings_whole);
    const auto all = static_cast<double>(row.n_pings);
    whole_sum += whole * row.backscatter_m2;
    whole_pings += whole;
    all_sum += all * row.backscatter_m2;
    all_pings += all;
  }
  [[nodiscard]] double value() const {
    if (whole_pings > 0.0) return whole_sum / whole_pings;
    return all_pings > 0.0 ? all_sum / all_pings : 0.0;
  }
};

}  // namespace

std::string school_name(const std::string& observation, std::int64_t school_id) {
  return observation + "/" + std::to_string(school_id);
}

std::vector<int> chains_of(std::span<const SchoolRow> rows) {
  std::map<std::string, std::size_t> by_name;
  for (std::size_t i = 0; i < rows.size(); ++i) by_name[school_name(rows[i].observation, rows[i].school_id)] = i;
  std::vector<std::size_t> parent(rows.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto whole = rows[i].continues.empty() ? by_name.end() : by_name.find(rows[i].continues);
    if (whole != by_name.end()) parent[root_of(parent, i)] = root_of(parent, whole->second);
  }
  std::map<std::size_t, int> numbers;
  std::vector<int> chains;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    chains.push_back(numbers.try_emplace(root_of(parent, i), static_cast<int>(numbers.size())).first->second);
  }
  return chains;
}

bool counts(const SchoolRow& row) { return row.status != "rejected"; }

SchoolTotals totals_of(std::span<const SchoolRow> rows) {
  SchoolTotals totals;
  const std::vector<int> chains = chains_of(rows);
  std::map<int, Mean> schools;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!counts(rows[i])) {
      ++totals.rejected;
      continue;
    }
    totals.continued += schools.contains(chains[i]) ? 1 : 0;
    schools[chains[i]].add(rows[i]);
  }
  totals.schools = static_cast<std::int64_t>(schools.size());
  for (const auto& [chain, mean] : schools) totals.backscatter_m2 += mean.value();
  return totals;
}

}  // namespace sonar
