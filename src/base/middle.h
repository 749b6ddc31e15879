// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

#include "base/check.h"

namespace sonar {

/// The middle value, of an even number the upper of the two. values: at least one, none NaN
template <class Value>
[[nodiscard]] Value middle_of(std::vector<Value> values) {
  SONAR_CHECK(!values.empty());
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// Standard deviation of normal values over the middle of their distances from their middle.
inline constexpr double kStandardOverMiddleDeviation = 1.4826;

}  // namespace sonar
