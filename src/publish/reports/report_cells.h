// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "io/csv_table.h"

namespace sonar {

// What a report shows of a table, on whatever it is drawn.

/// Those that have a value in any record.
[[nodiscard]] std::vector<std::size_t> columns_with_values(const CsvTable& table);

struct ReportCell {
  std::string text;  ///< as the data has it; of a number at most five digits
  bool number = false;
};
/// Five digits are more than any figure has; whole numbers stay whole, and places to a metre.
[[nodiscard]] ReportCell report_cell(std::string_view column, std::string_view field);

/// The first 20 of 2 000 rows; empty where all are shown.
[[nodiscard]] std::string rows_left_out(const CsvTable& table, std::size_t most);

}  // namespace sonar
