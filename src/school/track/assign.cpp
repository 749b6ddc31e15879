// SPDX-License-Identifier: Apache-2.0
#include "school/track/assign.h"

#include <cstddef>
#include <limits>

namespace sonar {

std::vector<int> assign(const std::vector<std::vector<double>>& cost, double alone) {
  const std::size_t rows = cost.size();
  if (rows == 0) return {};
  const std::size_t real = cost.front().size();
  const std::size_t columns = real + rows;  // each row has a column of its own to stay alone in
  const auto price = [&](std::size_t i, std::size_t j) {
    if (j < real) return cost[i][j];
    return j - real == i ? alone : alone * 4.0 + 1.0;
  };
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  // one-based: row 0 and column 0 are the search's root
  std::vector<double> u(rows + 1, 0.0);
  std::vector<double> v(columns + 1, 0.0);
  std::vector<std::size_t> row_of(columns + 1, 0);
  std::vector<std::size_t> way(columns + 1, 0);
  for (std::size_t i = 1; i <= rows; ++i) {
    row_of[0] = i;
    std::size_t j0 = 0;
    std::vector<double> least(columns + 1, kInfinite);
    std::vector<bool> used(columns + 1, false);
    do {
      used[j0] = true;
      const std::size_t i0 = row_of[j0];
      double delta = kInfinite;
      std::size_t j1 = 0;
      for (std::size_t j = 1; j <= columns; ++j) {
        if (used[j]) continue;
        const double reduced = price(i0 - 1, j - 1) - u[i0] - v[j];
        if (reduced < least[j]) {
          least[j] = reduced;
          way[j] = j0;
        }
        if (least[j] < delta) {
          delta = least[j];
          j1 = j;
        }
      }
      for (std::size_t j = 0; j <= columns; ++j) {
        if (used[j]) {
          u[row_of[j]] += delta;
          v[j] -= delta;
        } else {
          least[j] -= delta;
        }
      }
      j0 = j1;
    } while (row_of[j0] != 0);
    while (j0 != 0) {
      const std::size_t j1 = way[j0];
      row_of[j0] = row_of[j1];
      j0 = j1;
    }
  }
  std::vector<int> column_of(rows, -1);
  for (std::size_t j = 1; j <= real; ++j) {
    if (row_of[j] != 0) column_of[row_of[j] - 1] = static_cast<int>(j - 1);
  }
  return column_of;
}

}  // namespace sonar
