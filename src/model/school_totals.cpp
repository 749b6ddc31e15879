// SPDX-License-Identifier: Apache-2.0
#include "model/school_totals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>

namespace sonar {
namespace {

/// Index of the product, and school_id or ping_index there.
using InProduct = std::pair<std::size_t, std::int64_t>;

std::size_t root_of(std::vector<std::size_t>& parent, std::size_t row) {
  while (parent[row] != row) row = parent[row] = parent[parent[row]];
  return row;
}

/// What the rows of one school have in one ping together.
struct InPing {
  double echo_m2 = 0.0;
  bool known = false;
  bool touches_edge = false;
};

double mean_m2(const std::map<InProduct, InPing>& pings) {
  const bool whole =
      std::any_of(pings.begin(), pings.end(), [](const auto& p) { return p.second.known && !p.second.touches_edge; });
  double sum = 0.0;
  int n = 0;
  for (const auto& [ping, in_ping] : pings) {
    if (!in_ping.known || (whole && in_ping.touches_edge)) continue;
    sum += in_ping.echo_m2;
    ++n;
  }
  return n > 0 ? sum / n : kUnknown;
}

/// Of schools that several rows tell of.
/// of_row  index of the school that counts a row
void sum_pings(std::span<const ObservationProduct> products, const std::map<InProduct, std::size_t>& of_row,
               std::vector<CountedSchool>& schools) {
  std::map<std::size_t, std::map<InProduct, InPing>> pings;
  for (std::size_t i = 0; i < products.size(); ++i) {
    for (const SchoolPingRow& row : products[i].school_pings) {
      const auto school = of_row.find({i, row.school_id});
      if (school == of_row.end() || schools[school->second].rows.size() < 2) continue;
      InPing& in_ping = pings[school->second][{i, row.ping_index}];
      in_ping.touches_edge = in_ping.touches_edge || row.touches_edge != 0;
      if (!std::isfinite(echo_m2(row))) continue;
      in_ping.known = true;
      in_ping.echo_m2 += echo_m2(row);
    }
  }
  for (const auto& [school, of_school] : pings) schools[school].backscatter_m2 = mean_m2(of_school);
}

}  // namespace

std::string school_name(const std::string& observation, std::int64_t school_id) {
  return observation + "/" + std::to_string(school_id);
}

double echo_m2(const SchoolRow& row) {
  return std::isfinite(row.backscatter_total_m2) ? row.backscatter_total_m2 : row.backscatter_m2;
}
double echo_m2(const SchoolPingRow& row) {
  return std::isfinite(row.backscatter_total_m2) ? row.backscatter_total_m2 : row.backscatter_m2;
}

std::vector<int> chains_of(std::span<const SchoolRow* const> rows) {
  std::map<std::string, std::size_t> by_name;
  for (std::size_t i = 0; i < rows.size(); ++i) by_name[school_name(rows[i]->observation, rows[i]->school_id)] = i;
  std::vector<std::size_t> parent(rows.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto whole = rows[i]->continues.empty() ? by_name.end() : by_name.find(rows[i]->continues);
    if (whole != by_name.end()) parent[root_of(parent, i)] = root_of(parent, whole->second);
  }
  std::map<std::size_t, int> numbers;
  std::vector<int> chains;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    chains.push_back(numbers.try_emplace(root_of(parent, i), static_cast<int>(numbers.size())).first->second);
  }
  return chains;
}

std::vector<CountedSchool> counted_schools(std::span<const ObservationProduct> products) {
  std::vector<const SchoolRow*> rows;
  std::vector<std::size_t> product_of_row;
  for (std::size_t i = 0; i < products.size(); ++i) {
    for (const SchoolRow& row : products[i].schools) rows.push_back(&row);
    product_of_row.resize(rows.size(), i);
  }
  const std::vector<int> chains = chains_of(rows);
  std::vector<CountedSchool> schools;
  std::map<int, std::size_t> of_chain;
  std::map<InProduct, std::size_t> of_row;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i]->status == "rejected") continue;
    const auto [at, is_new] = of_chain.try_emplace(chains[i], schools.size());
    if (is_new) schools.emplace_back();
    auto& of_school = schools[at->second].rows;
    of_school.insert(rows[i]->continues.empty() ? of_school.begin() : of_school.end(), rows[i]);
    of_row[{product_of_row[i], rows[i]->school_id}] = at->second;
  }
  for (CountedSchool& school : schools) {
    if (school.rows.size() == 1) school.backscatter_m2 = echo_m2(*school.rows.front());
  }
  sum_pings(products, of_row, schools);
  return schools;
}

std::int64_t school_count(const ObservationProduct& product) {
  return static_cast<std::int64_t>(counted_schools({&product, 1}).size());
}

double total_backscatter_m2(std::span<const CountedSchool> schools) {
  double total = 0.0;
  for (const CountedSchool& school : schools) {
    if (std::isfinite(school.backscatter_m2)) total += school.backscatter_m2;
  }
  return total;
}

}  // namespace sonar
