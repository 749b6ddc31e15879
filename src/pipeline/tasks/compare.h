// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "base/result.h"
#include "base/work.h"
#include "model/product.h"

namespace sonar {

/// Doubles closer than this share of the larger are equal; so are two NaN.
inline constexpr double kEqualRelative = 1e-9;

/// content: what products say; everything: also how they were made (recipe, versions, history, input files and key).
enum class Compared { content, everything };

struct Comparison {
  std::string difference;       ///< the first, as "group/variable[index]: value of a, value of b"; empty = equal
  std::int64_t tolerated = 0;   ///< numbers that are equal within kEqualRelative only
  std::string first_tolerated;  ///< the first of them, told in the same way
};

/// Content comes before how it was made, masks and rows before all else.
[[nodiscard]] Comparison compare_products(const ObservationProduct& a, const ObservationProduct& b,
                                          Compared what = Compared::everything);

/// Compares two product files, two tables (.csv), or two results (the products of both folders, schools.csv and
/// school_pings.csv). The map and survey.json follow from those.
/// errors  not_found; usage: a file and a folder; format; cancelled
[[nodiscard]] Result<Comparison> compare_paths(const std::filesystem::path& a, const std::filesystem::path& b,
                                               Compared what, Work& work);

}  // namespace sonar
