// SPDX-License-Identifier: Apache-2.0
#include "view/slices/plane_outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "view/slices/slice_geometry.h"

namespace sonar {

double inside_by_m(const Sector& sector, const Point<Sonar>& p) {
  const double range = norm(p);
  const double aside = std::hypot(p.x, p.y);
  const RangeAxis& axis = sector.range();
  double out = std::min(axis.range_m(axis.count - 0.5) - range, range - std::max(0.0, axis.range_m(-0.5)));
  const double elevation = std::atan2(-p.z, aside);
  const double lowest = sector.elevation_bounds(0).lower;
  const double highest = sector.elevation_bounds(sector.fans() - 1).upper;
  // Cells that reach to the vertical have no face there.
  if (lowest > -std::numbers::pi / 2) out = std::min(out, (elevation - lowest) * range);
  if (highest < std::numbers::pi / 2) out = std::min(out, (highest - elevation) * range);
  const double first = sector.azimuth_bounds(0).lower;
  const double last = sector.azimuth_bounds(sector.beams() - 1).upper;
  const double half = (last - first) / 2;
  if (half >= std::numbers::pi - 1e-9) return out;
  const double off = std::remainder(std::atan2(p.y, p.x) - (first + last) / 2, 2 * std::numbers::pi);
  return std::min(out, (half - std::abs(off)) * aside);
}

std::vector<ContourLine> plane_outline(const SliceMap& map) {
  constexpr double kSteps = 256.0;
  const PixelSize size = map.size();
  const double step = std::max(1.0, std::max(size.width, size.height) / kSteps);
  ScalarField field;
  // The last nodes lie on or beyond the map's edge.
  field.size = {static_cast<int>(std::ceil(size.width / step)) + 1,
                static_cast<int>(std::ceil(size.height / step)) + 1};
  field.values.reserve(field.size.count());
  const SliceGeometry geometry(map.sector(), map.view());
  for (int y = 0; y < field.size.height; ++y) {
    for (int x = 0; x < field.size.width; ++x) {
      const PixelPoint at = map.slice_coordinates({x * step, y * step});
      field.values.push_back(static_cast<float>(inside_by_m(map.sector(), geometry.point(at.x, at.y))));
    }
  }
  std::vector<ContourLine> lines = contour_lines(field, 0.0);
  for (ContourLine& line : lines) {
    for (PixelPoint& p : line.points) p = {p.x * step, p.y * step};
  }
  return lines;
}

}  // namespace sonar
