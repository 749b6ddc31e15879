// SPDX-License-Identifier: Apache-2.0
#include "view/slices/slice_area.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "view/slices/slice_geometry.h"

namespace sonar {
namespace {

/// An outline with the rectangle round it, which most places miss.
class Area {
 public:
  explicit Area(std::span<const PixelPoint> outline) : outline_(outline) {
    for (const PixelPoint& p : outline) {
      low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
      high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
    }
  }
  [[nodiscard]] bool holds(PixelPoint p) const {
    if (!(p.x >= low_.x && p.x <= high_.x && p.y >= low_.y && p.y <= high_.y)) return false;
    return within_outline(outline_, p);
  }

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  std::span<const PixelPoint> outline_;
  PixelPoint low_{kFar, kFar};
  PixelPoint high_{-kFar, -kFar};
};

/// Whether a plane comes so near to a cell's centre that it may cut the cell.
bool may_meet(const Sector& sector, const PlaneSlice& plane, const Voxel& v) {
  const AngleBounds e = sector.elevation_bounds(v.fan);
  const AngleBounds a = sector.azimuth_bounds(v.beam);
  const double range = std::abs(sector.range().range_m(v.sample)) + sector.range().spacing_m;
  const double reach = sector.range().spacing_m + range * (e.upper - e.lower + a.upper - a.lower);
  const Point<Sonar> d = sector.centre(v.fan, v.beam, v.sample) - plane.origin;
  const Point<Sonar>& r = plane.right;
  const Point<Sonar>& u = plane.down;
  const double away = d.x * (r.y * u.z - r.z * u.y) + d.y * (r.z * u.x - r.x * u.z) + d.z * (r.x * u.y - r.y * u.x);
  return std::abs(away) <= reach;
}

void add_row(const Sector& sector, const Slice& slice, const SliceGeometry& geometry, const Area& area, int row,
             std::vector<Run>& runs) {
  const auto* plane = std::get_if<PlaneSlice>(&slice);
  const auto* shell = std::get_if<RangeSlice>(&slice);
  const int first = shell != nullptr ? shell->sample : 0;
  const int end = shell != nullptr ? shell->sample + 1 : sector.range().count;
  for (int s = first; s < end; ++s) {
    const Voxel voxel{row / sector.beams(), row % sector.beams(), s};
    if (plane != nullptr && !may_meet(sector, *plane, voxel)) continue;
    const auto at = geometry.place(voxel);
    if (!at || !area.holds(*at)) continue;
    if (!runs.empty() && runs.back().row == row && runs.back().end() == s) {
      ++runs.back().count;
    } else {
      runs.push_back({row, s, 1});
    }
  }
}

}  // namespace

bool within_outline(std::span<const PixelPoint> outline, PixelPoint at) {
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const PixelPoint& a = outline[i];
    const PixelPoint& b = outline[(i + 1) % outline.size()];
    // Half open, so that a corner on the level of the place counts once.
    if ((a.y > at.y) == (b.y > at.y)) continue;
    if (at.x < a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

PixelPoint turned_up(const Slice& slice, PixelPoint at, double by_rad) {
  const auto* plane = std::get_if<PlaneSlice>(&slice);
  const bool level = plane != nullptr && plane->kind == PlaneSlice::Kind::horizontal;
  if (!level && !std::holds_alternative<TopSlice>(slice)) return at;
  const double c = std::cos(by_rad);
  const double s = std::sin(by_rad);
  return {at.x * c - at.y * s, at.x * s + at.y * c};
}

std::vector<Run> runs_within(const Sector& sector, const Slice& slice, std::span<const PixelPoint> outline,
                             bool all_fans) {
  std::vector<Run> runs;
  const Area area(outline);
  const auto* top = std::get_if<TopSlice>(&slice);
  const auto* side = std::get_if<SideSlice>(&slice);
  for (int fan = 0; fan < sector.fans(); ++fan) {
    if (top != nullptr && !all_fans && fan != top->fan) continue;
    const Slice of_fan = top != nullptr ? Slice(TopSlice{fan}) : slice;
    const SliceGeometry geometry(sector, {of_fan, 0.0, std::nullopt});
    for (int beam = 0; beam < sector.beams(); ++beam) {
      if (side != nullptr && beam != side->beam) continue;
      add_row(sector, of_fan, geometry, area, fan * sector.beams() + beam, runs);
    }
  }
  return runs;
}

}  // namespace sonar
