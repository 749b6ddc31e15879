// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace sonar {

inline constexpr std::size_t kMostRows = 32767;

/// Of each column of a matrix the values that given shares of its data lie below: those of rank floor(share * data), exact.
/// in      matrix [row][column], kNoData where there is none, at most kMostRows rows; shares 0 <= share < 1
/// out     known [column]: how many are data; quantiles [share][column], kNoData in columns without data
void column_quantiles(std::span<const std::int16_t> matrix, std::span<const double> shares,
                      std::span<std::int16_t> known, std::span<std::int16_t> quantiles);

}  // namespace sonar
