// SPDX-License-Identifier: Apache-2.0
#include "pipeline/score/kappa.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sonar {

Kappa cohen_kappa(const AnswerCounts& counts) {
  Kappa out;
  out.counts = counts;
  out.units = counts[0][0] + counts[0][1] + counts[1][0] + counts[1][1];
  if (out.units == 0) return out;
  const auto n = static_cast<double>(out.units);
  const auto share = [&](std::size_t i, std::size_t j) { return static_cast<double>(counts[i][j]) / n; };
  const std::array<double, 2> of_a = {share(0, 0) + share(0, 1), share(1, 0) + share(1, 1)};
  const std::array<double, 2> of_b = {share(0, 0) + share(1, 0), share(0, 1) + share(1, 1)};
  out.agreed_fraction = share(0, 0) + share(1, 1);
  if (of_a[0] + of_b[0] > 0.0) out.agreed_yes_fraction = 2.0 * share(0, 0) / (of_a[0] + of_b[0]);
  const auto one_answer = [&](std::int64_t yes) { return yes == 0 || yes == out.units; };
  if (one_answer(counts[0][0] + counts[0][1]) || one_answer(counts[0][0] + counts[1][0])) return out;
  const double by_chance = of_a[0] * of_b[0] + of_a[1] * of_b[1];
  out.kappa = (out.agreed_fraction - by_chance) / (1.0 - by_chance);
  const double missed = 1.0 - out.kappa;
  double sum = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      const double marginals = i == j ? of_a[i] + of_b[i] : of_b[i] + of_a[j];
      const double weight = i == j ? 1.0 - marginals * missed : marginals * missed;
      sum += share(i, j) * weight * weight;
    }
  }
  const double mean = out.kappa - by_chance * missed;
  out.kappa_se = std::sqrt(std::max(0.0, sum - mean * mean) / n) / (1.0 - by_chance);
  return out;
}

}  // namespace sonar
