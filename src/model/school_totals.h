// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "model/product.h"
#include "model/school.h"

// What a total of schools is. Whoever counts or sums schools, in tables, maps, captions or messages, asks here: rejected ones
// are no schools, and one that several rows tell of (`continues`) is one.
namespace sonar {

/// "obs-0001/3", as it stands in the column `continues`.
[[nodiscard]] std::string school_name(const std::string& observation, std::int64_t school_id);

/// Backscatter of a row, m^2: of the whole school where that is known, else of its mask.
[[nodiscard]] double echo_m2(const SchoolRow& row);
[[nodiscard]] double echo_m2(const SchoolPingRow& row);

/// Which rows are parts of one school: those that `continues` joins, in whatever order they stand.
/// out  [row] number of its school, from 0 in the order of their first rows
[[nodiscard]] std::vector<int> chains_of(std::span<const SchoolRow* const> rows);

/// A school, and the rows that count as it; the first is the one that the others continue, as far as it counts.
struct CountedSchool {
  std::vector<const SchoolRow*> rows;
  /// A row's echo_m2(); of several rows the mean over their pings of what they have in each together, over those in which
  /// none touches an edge where there are any. Unknown = NaN.
  double backscatter_m2 = kUnknown;
};

/// Schools of all products together, in the order of their first rows. Views into the products.
/// products  their rows of pings may be left out by who only counts
[[nodiscard]] std::vector<CountedSchool> counted_schools(std::span<const ObservationProduct> products);
[[nodiscard]] std::int64_t school_count(const ObservationProduct& product);
/// Unknown figures count nothing.
[[nodiscard]] double total_backscatter_m2(std::span<const CountedSchool> schools);

}  // namespace sonar
