// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "model/school.h"

namespace sonar {

/// "obs-0001/3", as it stands in the column `continues`.
[[nodiscard]] std::string school_name(const std::string& observation, std::int64_t school_id);

/// Which rows are parts of one school: those that `continues` joins, in whatever order they stand.
/// out  [row] number of its school, from 0 in the order of their first rows
[[nodiscard]] std::vector<int> chains_of(std::span<const SchoolRow> rows);

/// What a total of schools is. Whoever counts or sums schools, in tables, maps, captions or messages, asks here: rejected
/// ones are no schools, and one that several rows tell of (`continues`) is one.
struct SchoolTotals {
  std::int64_t schools = 0;
  std::int64_t rejected = 0;   ///< rows
  std::int64_t continued = 0;  ///< rows that count and are no school of their own, for another row of theirs counts
  /// Of all schools; one of several rows has the mean of its pings, as a single row has: those that touch no edge where
  /// there are any. Unknown figures count nothing.
  double backscatter_m2 = 0.0;
};

/// Whether a row's figures count in totals.
[[nodiscard]] bool counts(const SchoolRow& row);
[[nodiscard]] SchoolTotals totals_of(std::span<const SchoolRow> rows);

}  // namespace sonar
