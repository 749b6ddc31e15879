// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace sonar {

/// Assignment of rows to columns at least total cost; every row may stay alone at its own price.
/// cost    [row][column], finite; columns may differ in number from rows
/// alone   price of a row without a column
/// out     [row] column, -1 = alone
/// cost    cubic in the number of rows plus columns
/// source  Kuhn 1955, in the form with potentials
[[nodiscard]] std::vector<int> assign(const std::vector<std::vector<double>>& cost, double alone);

}  // namespace sonar
