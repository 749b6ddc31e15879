// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "view/image.h"

namespace sonar {

/// A field on a regular lattice; NaN = unknown.
struct ScalarField {
  PixelSize size;
  std::vector<float> values;  ///< [height][width]
  [[nodiscard]] float at(int x, int y) const {
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) + static_cast<std::size_t>(x)];
  }
};

/// A line along which the field has one value, in lattice steps.
struct ContourLine {
  std::vector<PixelPoint> points;
  bool closed = false;
};

/// All lines of a level: marching squares, linear along edges, saddles told by the cell's mean; cells with an unknown
/// corner are left out.
[[nodiscard]] std::vector<ContourLine> contour_lines(const ScalarField& field, double level);

}  // namespace sonar
