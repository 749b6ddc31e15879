// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "io/csv_table.h"

namespace sonar {

// How the text of a table is laid out on paper, which is as wide as it is.

/// A text in lines no wider than that: broken where it has line feeds, at blanks, behind what joins the words of a name
/// (_ / -), and where that isn't enough inside a word. Never empty.
[[nodiscard]] std::vector<std::string> text_lines(std::string_view text, double width_px, double size_px);

struct PaperColumn {
  std::size_t index = 0;  ///< in the table
  double width_px = 0.0;  ///< with the gap to the next
};
/// The columns that have values, in blocks that are no wider than that, each of one column more than the keys at least.
/// Every block begins with the keys, so that its rows can be told: observation, school_id and ping_index, as far as the
/// table has them, else the first column.
/// rows  as many of the first are shown
[[nodiscard]] std::vector<std::vector<PaperColumn>> column_blocks(const CsvTable& table, std::size_t rows,
                                                                  double width_px, double size_px);

}  // namespace sonar
