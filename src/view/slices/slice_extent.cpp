// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/units.h"
#include "view/slices/slice.h"
#include "view/slices/slice_geometry.h"

namespace sonar {
namespace {

/// Grows around places.
struct Bounds {
  SliceExtent e{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                -std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  void take(double x, double y) { e = {std::min(e.x0, x), std::min(e.y0, y), std::max(e.x1, x), std::max(e.y1, y)}; }
  [[nodiscard]] bool empty() const { return !(e.x0 <= e.x1); }
  /// With a margin of a share of the larger side.
  [[nodiscard]] SliceExtent padded(double share) const {
    const double pad = std::max(1e-6, share * std::max(e.x1 - e.x0, e.y1 - e.y0));
    return {e.x0 - pad, e.y0 - pad, e.x1 + pad, e.y1 + pad};
  }
};

constexpr int kArcSteps = 180;
constexpr int kPlaneSteps = 160;
constexpr double kMargin = 0.06;

double far_m(const Sector& sector) {
  return std::max(sector.range().spacing_m, sector.range().range_m(sector.range().count - 0.5));
}

SliceExtent top_extent(const Sector& sector, int fan, double up_rad) {
  const double h = far_m(sector) * std::cos(sector.elevation_rad(fan));
  const double first = sector.azimuth_bounds(0).lower;
  const double last = sector.azimuth_bounds(sector.beams() - 1).upper;
  Bounds b;
  b.take(0.0, 0.0);
  for (int i = 0; i <= kArcSteps; ++i) {
    const double a = first + (last - first) * i / kArcSteps - up_rad;
    b.take(h * std::sin(a), -h * std::cos(a));
  }
  return b.padded(kMargin);
}

SliceExtent side_extent(const Sector& sector) {
  const double r = far_m(sector);
  const double first = sector.elevation_bounds(0).lower;
  const double last = sector.elevation_bounds(sector.fans() - 1).upper;
  Bounds b;
  b.take(0.0, 0.0);
  for (int i = 0; i <= kArcSteps; ++i) {
    const double e = first + (last - first) * i / kArcSteps;
    b.take(r * std::cos(e), -r * std::sin(e));
  }
  return b.padded(kMargin);
}

SliceExtent range_extent(const Sector& sector) {
  Bounds b;
  b.take(deg_from_rad(sector.azimuth_bounds(0).lower), -deg_from_rad(sector.elevation_bounds(0).lower));
  b.take(deg_from_rad(sector.azimuth_bounds(sector.beams() - 1).upper),
         -deg_from_rad(sector.elevation_bounds(sector.fans() - 1).upper));
  return b.padded(0.03);
}

/// By trying places of the square round the sphere's cut; exact to a step of it, which the margin covers.
std::optional<SliceExtent> plane_extent(const Sector& sector, const SliceView& view) {
  const PlaneSlice plane = turned_plane(view);
  const Point<Sonar>& o = plane.origin;
  const double cx = -(o.x * plane.right.x + o.y * plane.right.y + o.z * plane.right.z);
  const double cy = -(o.x * plane.down.x + o.y * plane.down.y + o.z * plane.down.z);
  const Point<Sonar> foot = o + plane.right * cx + plane.down * cy;  // of the sonar on the plane
  const double r = far_m(sector);
  const double half_squared = r * r - norm(foot) * norm(foot);
  if (!(half_squared > 0.0)) return std::nullopt;
  const double half = std::sqrt(half_squared);
  const SliceGeometry geometry(sector, view);
  Bounds b;
  for (int i = 0; i <= kPlaneSteps; ++i) {
    for (int k = 0; k <= kPlaneSteps; ++k) {
      const double x = cx + half * (2.0 * i / kPlaneSteps - 1.0);
      const double y = cy + half * (2.0 * k / kPlaneSteps - 1.0);
      if (geometry.voxel(x, y)) b.take(x, y);
    }
  }
  if (b.empty()) return std::nullopt;
  const double step = 2.0 * half / kPlaneSteps;
  b.take(b.e.x0 - step, b.e.y0 - step);
  b.take(b.e.x1 + step, b.e.y1 + step);
  if (plane.kind == PlaneSlice::Kind::horizontal) b.take(cx, cy);
  if (plane.kind == PlaneSlice::Kind::vertical) b.take(b.e.x0, -o.z);
  if (plane.kind == PlaneSlice::Kind::vertical && norm(foot) < 1.0) b.take(cx, -o.z);
  return b.padded(0.5 * kMargin);
}

}  // namespace

std::optional<SliceExtent> whole_extent(const Sector& sector, const SliceView& view) {
  if (const auto* top = std::get_if<TopSlice>(&view.slice)) return top_extent(sector, top->fan, view.up_rad);
  if (std::holds_alternative<SideSlice>(view.slice)) return side_extent(sector);
  if (std::holds_alternative<RangeSlice>(view.slice)) return range_extent(sector);
  return plane_extent(sector, view);
}

}  // namespace sonar
