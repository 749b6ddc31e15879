// SPDX-License-Identifier: Apache-2.0
#include "cli/suggestion.h"

#include <algorithm>
#include <cstddef>

namespace sonar {
namespace {

/// Letters to add, leave out, change or swap with their neighbour: Damerau and Levenshtein's distance.
std::size_t slips(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t k = 0; k <= b.size(); ++k) {
      if (i == 0 || k == 0) {
        cost[i][k] = i + k;
        continue;
      }
      const std::size_t change = cost[i - 1][k - 1] + (a[i - 1] == b[k - 1] ? 0U : 1U);
      cost[i][k] = std::min({cost[i - 1][k] + 1, cost[i][k - 1] + 1, change});
      const bool swapped = i > 1 && k > 1 && a[i - 1] == b[k - 2] && a[i - 2] == b[k - 1];
      if (swapped) cost[i][k] = std::min(cost[i][k], cost[i - 2][k - 2] + 1);
    }
  }
  return cost[a.size()][b.size()];
}

}  // namespace

std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
  constexpr std::size_t kMostSlips = 2;
  std::string best;
  std::size_t least = kMostSlips + 1;
  for (const std::string& one : known) {
    const std::size_t here = word.size() > 2 && one.starts_with(word) ? 1 : slips(word, one);
    // Of a short word two slips leave nothing.
    if (here < least && here * 2 < std::max(one.size(), word.size())) {
      least = here;
      best = one;
    }
  }
  return best;
}

}  // namespace sonar
