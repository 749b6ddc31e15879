// SPDX-License-Identifier: Apache-2.0
#include "school/track/assign.h"

#include <gtest/gtest.h>

#include <functional>

#include "school/test_water.h"

namespace sonar {
namespace {

double total(const std::vector<std::vector<double>>& cost, const std::vector<int>& choice, double alone) {
  double sum = 0.0;
  for (std::size_t i = 0; i < choice.size(); ++i) {
    sum += choice[i] < 0 ? alone : cost[i][static_cast<std::size_t>(choice[i])];
  }
  return sum;
}

double cheapest(const std::vector<std::vector<double>>& cost, double alone) {
  std::vector<int> choice(cost.size(), -1);
  double best = 1e300;
  const std::function<void(std::size_t, unsigned)> place = [&](std::size_t row, unsigned used) {
    if (row == cost.size()) {
      best = std::min(best, total(cost, choice, alone));
      return;
    }
    choice[row] = -1;
    place(row + 1, used);
    for (std::size_t j = 0; j < cost[row].size(); ++j) {
      if ((used >> j & 1U) != 0) continue;
      choice[row] = static_cast<int>(j);
      place(row + 1, used | 1U << j);
    }
    choice[row] = -1;
  };
  place(0, 0);
  return best;
}

TEST(Assign, IsAsCheapAsTryingAll) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const std::size_t rows = 1 + seed % 5;
    const std::size_t columns = (seed / 5) % 6;
    std::vector<std::vector<double>> cost(rows, std::vector<double>(columns));
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t j = 0; j < columns; ++j) cost[i][j] = 10.0 * test::uniform(seed * 1000 + i * 10 + j);
    }
    EXPECT_NEAR(total(cost, assign(cost, 5.0), 5.0), cheapest(cost, 5.0), 1e-9) << seed;
  }
}

TEST(Assign, NothingToAssign) {
  EXPECT_TRUE(assign({}, 1.0).empty());
  EXPECT_EQ(assign({{}, {}}, 1.0), (std::vector<int>{-1, -1}));
}

}  // namespace
}  // namespace sonar
