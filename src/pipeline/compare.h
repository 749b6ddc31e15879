// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "base/result.h"
#include "model/product.h"

namespace sonar {

/// Doubles closer than this share of the larger are equal; so are two NaN.
inline constexpr double kEqualRelative = 1e-9;

/// content: what products say; everything: also how they were made (recipe, versions, history, input files and key).
enum class Compared { content, everything };

/// The first difference as "group/variable[index]: value of a, value of b"; empty when equal. Content comes before how it
/// was made, masks and rows before all else.
[[nodiscard]] std::string first_difference(const ObservationProduct& a, const ObservationProduct& b,
                                           Compared what = Compared::everything);

/// Compares two product files, two tables (.csv), or two results (the products of both folders, schools.csv and
/// school_pings.csv). The map and survey.json follow from those.
/// out     empty when equal, else the first difference
/// errors  not_found; usage: a file and a folder; format
[[nodiscard]] Result<std::string> compare_paths(const std::filesystem::path& a, const std::filesystem::path& b,
                                                Compared what = Compared::everything);

}  // namespace sonar
