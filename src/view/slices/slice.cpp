// SPDX-License-Identifier: Apache-2.0
#include "view/slices/slice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/array.h"
#include "view/slices/slice_geometry.h"
#include "view/slices/slice_voxels.h"

namespace sonar {
namespace {

Point<Sonar> cross(const Point<Sonar>& a, const Point<Sonar>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

bool finite(const Point<Sonar>& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

Result<void> inside(const char* what, int value, int count) {
  if (value >= 0 && value < count) return {};
  return fail(ErrorCode::bad_parameter, fmt::format("there is no {} {}; expected 0 to {}", what, value, count - 1));
}

}  // namespace

PlaneSlice horizontal_plane(double depth_m, double transducer_depth_m) {
  return {{0.0, 0.0, depth_m - transducer_depth_m}, {0.0, 1.0, 0.0}, {-1.0, 0.0, 0.0}, PlaneSlice::Kind::horizontal};
}

Result<PlaneSlice> vertical_plane(const Point<Sonar>& a, const Point<Sonar>& b) {
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  if (!(length > 1e-9) || !std::isfinite(length)) {
    return fail(ErrorCode::bad_parameter, "a vertical plane needs two places that are not above each other");
  }
  return PlaneSlice{
      {a.x, a.y, 0.0}, {(b.x - a.x) / length, (b.y - a.y) / length, 0.0}, {0.0, 0.0, 1.0}, PlaneSlice::Kind::vertical};
}

PlaneSlice vertical_plane(double azimuth_rad) {
  return {{}, {std::cos(azimuth_rad), std::sin(azimuth_rad), 0.0}, {0.0, 0.0, 1.0}, PlaneSlice::Kind::vertical};
}

Result<PlaneSlice> oblique_plane(const Point<Sonar>& point, const Point<Sonar>& normal) {
  const double length = norm(normal);
  if (!finite(point) || !(length > 1e-12) || !std::isfinite(length)) {
    return fail(ErrorCode::bad_parameter, "a plane needs a point and a normal that is not 0");
  }
  const Point<Sonar> n = normal * (1.0 / length);
  const Point<Sonar> level = cross(n, {0.0, 0.0, 1.0});
  // A horizontal plane has no horizontal right of its own: starboard, so that the bow is up when seen from above.
  const double level_length = norm(level);
  const Point<Sonar> right = level_length > 1e-9 ? level * (1.0 / level_length) : Point<Sonar>{0.0, 1.0, 0.0};
  return PlaneSlice{point, right, cross(right, n), PlaneSlice::Kind::oblique};
}

bool seen_from_above(const Slice& slice) {
  const auto* plane = std::get_if<PlaneSlice>(&slice);
  return std::holds_alternative<TopSlice>(slice) || (plane != nullptr && plane->kind == PlaneSlice::Kind::horizontal);
}

Result<void> check_slice(const Sector& sector, const SliceView& view) {
  if (!std::isfinite(view.up_rad)) return fail(ErrorCode::bad_parameter, "the direction that points up is not finite");
  if (view.extent) {
    const SliceExtent& e = *view.extent;
    if (!(e.x0 < e.x1) || !(e.y0 < e.y1) || !std::isfinite(e.x1 - e.x0) || !std::isfinite(e.y1 - e.y0)) {
      return fail(ErrorCode::bad_parameter, "the part of the slice that is wanted has no area");
    }
  }
  if (const auto* top = std::get_if<TopSlice>(&view.slice)) return inside("fan", top->fan, sector.fans());
  if (const auto* side = std::get_if<SideSlice>(&view.slice)) return inside("beam", side->beam, sector.beams());
  if (const auto* range = std::get_if<RangeSlice>(&view.slice))
    return inside("sample", range->sample, sector.range().count);
  const auto& plane = std::get<PlaneSlice>(view.slice);
  if (!finite(plane.origin) || !finite(plane.right) || !finite(plane.down)) {
    return fail(ErrorCode::bad_parameter, "the plane is not finite");
  }
  return {};
}

SliceMap::SliceMap(Sector sector, SliceView view, SliceExtent extent, PixelSize size)
    : sector_(std::move(sector)),
      view_(view),
      extent_(extent),
      size_(size),
      voxels_(slice_voxels(sector_, view_, extent_, size_)) {}

std::optional<Voxel> SliceMap::voxel_at(PixelPoint pixel) const {
  if (!(pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x < size_.width && pixel.y < size_.height)) return std::nullopt;
  const auto i = static_cast<std::size_t>(static_cast<int>(pixel.y)) * static_cast<std::size_t>(size_.width) +
                 static_cast<std::size_t>(static_cast<int>(pixel.x));
  const int number = voxels_[i];
  if (number < 0) return std::nullopt;
  const int samples = sector_.range().count;
  const int row = number / samples;
  return Voxel{row / sector_.beams(), row % sector_.beams(), number % samples};
}

std::optional<PixelPoint> SliceMap::place_of(const Voxel& voxel) const {
  const auto place = SliceGeometry(sector_, view_).place(voxel);
  if (place) return pixel_of(place->x, place->y);
  // A plane that only grazes a curved cell: any pixel that shows it will do.
  const Voxel v = voxel;
  const Shape3 shape{sector_.fans(), sector_.beams(), sector_.range().count};
  if (v.fan < 0 || v.beam < 0 || v.sample < 0 || v.fan >= shape.fans || v.beam >= shape.beams ||
      v.sample >= shape.samples || !std::holds_alternative<PlaneSlice>(view_.slice)) {
    return std::nullopt;
  }
  const std::int32_t number = (v.fan * shape.beams + v.beam) * shape.samples + v.sample;
  const auto found = std::find(voxels_.begin(), voxels_.end(), number);
  if (found == voxels_.end()) return std::nullopt;
  const auto i = static_cast<int>(found - voxels_.begin());
  return PixelPoint{i % size_.width + 0.5, i / size_.width + 0.5};
}

std::optional<PixelPoint> SliceMap::carried(const Voxel& voxel) const {
  Voxel moved = voxel;
  if (const auto* top = std::get_if<TopSlice>(&view_.slice)) moved.fan = top->fan;
  if (const auto* side = std::get_if<SideSlice>(&view_.slice)) moved.beam = side->beam;
  if (const auto* range = std::get_if<RangeSlice>(&view_.slice)) moved.sample = range->sample;
  if (auto place = place_of(moved)) return place;
  const bool there = voxel.fan >= 0 && voxel.beam >= 0 && voxel.sample >= 0 && voxel.fan < sector_.fans() &&
                     voxel.beam < sector_.beams() && voxel.sample < sector_.range().count;
  if (!there || !std::holds_alternative<PlaneSlice>(view_.slice)) return std::nullopt;
  const PlaneSlice plane = turned_plane(view_);
  const Point<Sonar> d = sector_.centre(voxel.fan, voxel.beam, voxel.sample) - plane.origin;
  return pixel_of(d.x * plane.right.x + d.y * plane.right.y + d.z * plane.right.z,
                  d.x * plane.down.x + d.y * plane.down.y + d.z * plane.down.z);
}

Point<Sonar> SliceMap::point_at(PixelPoint pixel) const {
  const PixelPoint p = slice_coordinates(pixel);
  return SliceGeometry(sector_, view_).point(p.x, p.y);
}

PixelPoint SliceMap::slice_coordinates(PixelPoint pixel) const {
  return {extent_.x0 + pixel.x * (extent_.x1 - extent_.x0) / size_.width,
          extent_.y0 + pixel.y * (extent_.y1 - extent_.y0) / size_.height};
}

PixelPoint SliceMap::pixel_of(double x, double y) const {
  return {(x - extent_.x0) / (extent_.x1 - extent_.x0) * size_.width,
          (y - extent_.y0) / (extent_.y1 - extent_.y0) * size_.height};
}

bool SliceMap::fits(const Sector& sector, const SliceView& view, PixelSize size) const {
  return size_ == size && view_ == view && same_cells(sector_, sector);
}

}  // namespace sonar
