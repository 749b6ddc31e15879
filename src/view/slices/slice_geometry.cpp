// SPDX-License-Identifier: Apache-2.0
#include "view/slices/slice_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "base/units.h"

namespace sonar {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

double dot(const Point<Sonar>& a, const Point<Sonar>& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Index of the interval that holds a value; -1 outside. The ends give way to rounding, or a sector that goes all round
/// would have a seam.
int interval(const std::vector<double>& edges, double value) {
  constexpr double kRounding = 1e-12;
  if (!(value >= edges.front() - kRounding && value <= edges.back() + kRounding)) return -1;
  const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, value);
  return static_cast<int>(above - edges.begin()) - 1;
}

/// Corners of a cell, bit 0 = upper elevation, bit 1 = upper azimuth, bit 2 = far end.
std::array<Point<Sonar>, 8> corners(const Sector& sector, const Voxel& v) {
  const AngleBounds e = sector.elevation_bounds(v.fan);
  const AngleBounds a = sector.azimuth_bounds(v.beam);
  std::array<Point<Sonar>, 8> out;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double r = std::max(0.0, sector.range().range_m(v.sample + ((i & 4U) != 0U ? 0.5 : -0.5)));
    out[i] = Sector::direction((i & 1U) != 0U ? e.upper : e.lower, (i & 2U) != 0U ? a.upper : a.lower) * r;
  }
  return out;
}

}  // namespace

Point<Sonar> normal_of(const PlaneSlice& p) {
  return {p.right.y * p.down.z - p.right.z * p.down.y, p.right.z * p.down.x - p.right.x * p.down.z,
          p.right.x * p.down.y - p.right.y * p.down.x};
}

bool same_cells(const Sector& a, const Sector& b) {
  if (a.fans() != b.fans() || a.beams() != b.beams() || a.range() != b.range()) return false;
  const auto same = [](const AngleBounds& p, const AngleBounds& q) { return p.lower == q.lower && p.upper == q.upper; };
  for (int f = 0; f < a.fans(); ++f) {
    if (a.elevation_rad(f) != b.elevation_rad(f) || !same(a.elevation_bounds(f), b.elevation_bounds(f))) return false;
  }
  for (int i = 0; i < a.beams(); ++i) {
    if (a.azimuth_rad(i) != b.azimuth_rad(i) || !same(a.azimuth_bounds(i), b.azimuth_bounds(i))) return false;
  }
  return true;
}

PlaneSlice turned_plane(const SliceView& view) {
  const auto* plane = std::get_if<PlaneSlice>(&view.slice);
  if (plane == nullptr) return {};
  PlaneSlice out = *plane;
  if (out.kind == PlaneSlice::Kind::horizontal) {
    const double c = std::cos(view.up_rad);
    const double s = std::sin(view.up_rad);
    out.right = {-s, c, 0.0};
    out.down = {-c, -s, 0.0};
  }
  return out;
}

SliceGeometry::SliceGeometry(const Sector& sector, const SliceView& view)
    : sector_(&sector), slice_(view.slice), plane_(turned_plane(view)), up_rad_(view.up_rad) {
  for (int f = 0; f < sector.fans(); ++f) elevation_edges_.push_back(sector.elevation_bounds(f).lower);
  elevation_edges_.push_back(sector.elevation_bounds(sector.fans() - 1).upper);
  for (int b = 0; b < sector.beams(); ++b) azimuth_edges_.push_back(sector.azimuth_bounds(b).lower);
  azimuth_edges_.push_back(sector.azimuth_bounds(sector.beams() - 1).upper);
}

int SliceGeometry::fan_at(double elevation_rad) const { return interval(elevation_edges_, elevation_rad); }

int SliceGeometry::beam_at(double azimuth_rad) const {
  const double middle = 0.5 * (azimuth_edges_.front() + azimuth_edges_.back());
  return interval(azimuth_edges_, azimuth_rad - kTurn * std::round((azimuth_rad - middle) / kTurn));
}

int SliceGeometry::beam_on_axis(double azimuth_rad) const { return interval(azimuth_edges_, azimuth_rad); }

int SliceGeometry::sample_at(double range_m) const {
  const double sample = std::floor(sector_->range().sample_at(range_m) + 0.5);
  return sample >= 0.0 && sample < sector_->range().count ? static_cast<int>(sample) : -1;
}

std::optional<Voxel> SliceGeometry::checked(int fan, int beam, int sample) const {
  if (fan < 0 || beam < 0 || sample < 0) return std::nullopt;
  return Voxel{fan, beam, sample};
}

std::optional<Voxel> SliceGeometry::voxel_of(const Point<Sonar>& p) const {
  const double range = norm(p);
  const int sample = sample_at(range);
  if (sample < 0 || !(range > 0.0)) return std::nullopt;
  const int fan = fan_at(std::asin(std::clamp(-p.z / range, -1.0, 1.0)));
  return fan < 0 ? std::nullopt : checked(fan, beam_at(std::atan2(p.y, p.x)), sample);
}

std::optional<Voxel> SliceGeometry::voxel(double x, double y) const {
  if (const auto* top = std::get_if<TopSlice>(&slice_)) {
    const double c = std::cos(sector_->elevation_rad(top->fan));
    const double horizontal = std::sqrt(x * x + y * y);
    if (c < 1e-9 || !(horizontal > 0.0)) return std::nullopt;
    const int sample = sample_at(horizontal / c);
    return sample < 0 ? std::nullopt : checked(top->fan, beam_at(up_rad_ + std::atan2(x, -y)), sample);
  }
  if (const auto* side = std::get_if<SideSlice>(&slice_)) {
    const double range = std::sqrt(x * x + y * y);
    const int sample = sample_at(range);
    if (sample < 0 || !(range > 0.0)) return std::nullopt;
    return checked(fan_at(std::atan2(-y, x)), side->beam, sample);
  }
  if (const auto* range = std::get_if<RangeSlice>(&slice_)) {
    // No unwrapping: the axis shows the sector's own azimuths, once.
    return checked(fan_at(rad_from_deg(-y)), beam_on_axis(rad_from_deg(x)), range->sample);
  }
  return voxel_of(point(x, y));
}

Point<Sonar> SliceGeometry::point(double x, double y) const {
  if (const auto* top = std::get_if<TopSlice>(&slice_)) {
    const double horizontal = std::sqrt(x * x + y * y);
    const double azimuth = up_rad_ + std::atan2(x, -y);
    return {horizontal * std::cos(azimuth), horizontal * std::sin(azimuth),
            -horizontal * std::tan(sector_->elevation_rad(top->fan))};
  }
  if (const auto* side = std::get_if<SideSlice>(&slice_)) {
    const double azimuth = sector_->azimuth_rad(side->beam);
    return {x * std::cos(azimuth), x * std::sin(azimuth), y};
  }
  if (const auto* range = std::get_if<RangeSlice>(&slice_)) {
    return Sector::direction(rad_from_deg(-y), rad_from_deg(x)) * sector_->range().range_m(range->sample);
  }
  return plane_.origin + plane_.right * x + plane_.down * y;
}

std::optional<PixelPoint> SliceGeometry::place(const Voxel& v) const {
  if (v.fan < 0 || v.beam < 0 || v.sample < 0 || v.fan >= sector_->fans() || v.beam >= sector_->beams() ||
      v.sample >= sector_->range().count) {
    return std::nullopt;
  }
  const double range = sector_->range().range_m(v.sample);
  const double elevation = sector_->elevation_rad(v.fan);
  const double azimuth = sector_->azimuth_rad(v.beam);
  if (const auto* shell = std::get_if<RangeSlice>(&slice_)) {
    if (v.sample != shell->sample) return std::nullopt;
    return PixelPoint{deg_from_rad(azimuth), -deg_from_rad(elevation)};
  }
  if (!(range > 0.0)) return std::nullopt;
  const double horizontal = range * std::cos(elevation);
  if (const auto* top = std::get_if<TopSlice>(&slice_)) {
    if (v.fan != top->fan) return std::nullopt;
    return PixelPoint{horizontal * std::sin(azimuth - up_rad_), -horizontal * std::cos(azimuth - up_rad_)};
  }
  if (const auto* side = std::get_if<SideSlice>(&slice_)) {
    if (v.beam != side->beam) return std::nullopt;
    return PixelPoint{horizontal, -range * std::sin(elevation)};
  }
  return place_on_plane(v);
}

std::optional<PixelPoint> SliceGeometry::place_on_plane(const Voxel& v) const {
  const Point<Sonar> normal = normal_of(plane_);
  const auto on_plane = [&](const Point<Sonar>& p) {
    const Point<Sonar> d = p - plane_.origin;
    return PixelPoint{dot(d, plane_.right), dot(d, plane_.down)};
  };
  // Straight below or above the centre, if that is still in the cell.
  const PixelPoint near_centre = on_plane(sector_->centre(v.fan, v.beam, v.sample));
  if (voxel(near_centre.x, near_centre.y) == std::optional<Voxel>(v)) return near_centre;
  // Else the middle of where the plane crosses the cell's twelve edges.
  const std::array<Point<Sonar>, 8> corner = corners(*sector_, v);
  PixelPoint sum;
  int crossings = 0;
  for (std::size_t i = 0; i < corner.size(); ++i) {
    for (const std::size_t bit : {std::size_t{1}, std::size_t{2}, std::size_t{4}}) {
      if ((i & bit) != 0U) continue;
      const double d0 = dot(corner[i] - plane_.origin, normal);
      const double d1 = dot(corner[i | bit] - plane_.origin, normal);
      if ((d0 < 0.0) == (d1 < 0.0)) continue;
      const PixelPoint p = on_plane(corner[i] + (corner[i | bit] - corner[i]) * (d0 / (d0 - d1)));
      sum = {sum.x + p.x, sum.y + p.y};
      ++crossings;
    }
  }
  if (crossings == 0) return std::nullopt;
  const PixelPoint middle{sum.x / crossings, sum.y / crossings};
  // The edges are chords of a curved cell: where their middle lies beside it, the slice hardly meets the cell.
  return voxel(middle.x, middle.y) == std::optional<Voxel>(v) ? std::optional<PixelPoint>(middle) : std::nullopt;
}

}  // namespace sonar
