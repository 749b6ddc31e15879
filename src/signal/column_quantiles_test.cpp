// SPDX-License-Identifier: Apache-2.0
#include "signal/column_quantiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "base/units.h"
#include "signal/test_targets.h"

namespace sonar {
namespace {

constexpr std::array kShares = {0.5, 0.16, 0.84, 0.0};

/// By sorting, one column after the other.
void expect_sorted_ranks(const std::vector<std::int16_t>& matrix, std::size_t columns) {
  std::vector<std::int16_t> known(columns);
  std::vector<std::int16_t> quantiles(columns * kShares.size());
  column_quantiles(matrix, kShares, known, quantiles);
  for (std::size_t c = 0; c < columns; ++c) {
    std::vector<std::int16_t> data;
    for (std::size_t i = c; i < matrix.size(); i += columns) {
      if (matrix[i] != kNoData) data.push_back(matrix[i]);
    }
    std::ranges::sort(data);
    ASSERT_EQ(known[c], std::ssize(data)) << c;
    for (std::size_t k = 0; k < kShares.size(); ++k) {
      const auto rank = static_cast<std::size_t>(kShares[k] * static_cast<double>(data.size()));
      ASSERT_EQ(quantiles[k * columns + c], data.empty() ? kNoData : data[rank]) << c << " " << kShares[k];
    }
  }
}

TEST(column_quantiles, are_those_of_sorted_columns) {
  std::mt19937 random(20261128);
  for (const std::size_t columns : {1U, 3U, 31U, 94U, 130U}) {
    for (const std::size_t rows : {0U, 1U, 2U, 11U, 350U}) {
      for (const int spread : {1, 700, 65000}) {
        std::vector<std::int16_t> matrix(rows * columns);
        for (std::int16_t& value : matrix) {
          const bool none = random() % 5 == 0;
          const auto offset = static_cast<int>(random() % static_cast<unsigned>(spread)) - spread / 2;
          value = none ? kNoData : static_cast<std::int16_t>(offset);
        }
        test::on_each_target([&] { expect_sorted_ranks(matrix, columns); });
      }
    }
  }
}

TEST(column_quantiles, ends_of_the_range_and_columns_without_data) {
  expect_sorted_ranks({kMinCount, kNoData, kMaxCount, kMinCount, kNoData, kMinCount, kMaxCount, kNoData, kMaxCount}, 3);
  expect_sorted_ranks(std::vector<std::int16_t>(40, kNoData), 40);
}

}  // namespace
}  // namespace sonar
