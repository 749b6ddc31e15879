// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "model/product.h"
#include "view/charts/chart_columns.h"

namespace sonar {

/// A school among several observations.
struct ChartSchool {
  std::size_t observation = 0;  ///< its place in the list that the chart is of
  std::int64_t number = 0;      ///< in its observation
  friend auto operator<=>(const ChartSchool&, const ChartSchool&) = default;
};

/// What a row is of.
struct ChartRow {
  ChartSchool school;
  std::int64_t ping_index = -1;  ///< -1: the row is of a whole school
  bool rejected = false;
  friend bool operator==(const ChartRow&, const ChartRow&) = default;
};

/// Rows of one table with the values of one or two of its columns; NaN = unknown. Times are seconds since 1970, UTC.
struct ChartData {
  ChartTable table = ChartTable::school_pings;
  std::string title;
  std::vector<std::string> observations;  ///< names, by ChartSchool::observation
  std::vector<ChartRow> rows;             ///< by observation, school and ping
  ChartColumn x;
  std::vector<double> x_values;  ///< [row]
  std::optional<ChartColumn> y;  ///< empty: a histogram of x
  std::vector<double> y_values;  ///< [row]; empty without y

  [[nodiscard]] bool known(std::size_t row) const;
  /// How many rows have all their values.
  [[nodiscard]] std::size_t known_rows() const;
  /// "school ping", "school".
  [[nodiscard]] std::string_view row_word() const { return table == ChartTable::schools ? "school" : "school ping"; }
  friend bool operator==(const ChartData&, const ChartData&) = default;
};

struct ChartQuestion {
  ChartTable table = ChartTable::school_pings;
  std::string x = "time_utc";
  std::string y = "sv_mean_db";  ///< empty: a histogram of x
  bool rejected = true;          ///< rejected schools take part
  Units units{};                 ///< that both columns are read in
};

/// errors  usage: the table has no such column; lists those that it has
[[nodiscard]] Result<ChartData> chart_data(std::span<const ObservationProduct> products, const ChartQuestion& asked);

}  // namespace sonar
