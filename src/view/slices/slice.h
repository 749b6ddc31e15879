// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/result.h"
#include "geo/frames.h"
#include "geo/sector.h"
#include "view/image.h"

namespace sonar {

/// One fan seen from above, in horizontal metres: range x azimuth.
struct TopSlice {
  int fan = 0;
  friend bool operator==(const TopSlice&, const TopSlice&) = default;
};
/// One vertical fan seen from its side, in metres: horizontal distance from the sonar x depth.
struct SideSlice {
  int beam = 0;
  friend bool operator==(const SideSlice&, const SideSlice&) = default;
};
/// All beams at one range sample, in degrees: azimuth x elevation.
struct RangeSlice {
  int sample = 0;
  friend bool operator==(const RangeSlice&, const RangeSlice&) = default;
};
/// Any plane, in metres along two axes of its own; seen against its normal. `right` and `down` are unit vectors, square
/// to each other.
struct PlaneSlice {
  enum class Kind : std::uint8_t { horizontal, vertical, oblique };
  Point<Sonar> origin;
  Point<Sonar> right{0.0, 1.0, 0.0};
  Point<Sonar> down{-1.0, 0.0, 0.0};
  Kind kind = Kind::oblique;
  friend bool operator==(const PlaneSlice&, const PlaneSlice&) = default;
};
using Slice = std::variant<TopSlice, SideSlice, RangeSlice, PlaneSlice>;

/// The kinds of slices, in the variant's order.
enum class SliceKind : std::uint8_t { top, side, range, plane };
[[nodiscard]] inline SliceKind kind_of(const Slice& slice) { return static_cast<SliceKind>(slice.index()); }
/// Whether a slice is drawn as a map is, so that the bow or north may point up.
[[nodiscard]] bool seen_from_above(const Slice& slice);

/// Horizontal, seen from above; origin below the sonar, bow up.
[[nodiscard]] PlaneSlice horizontal_plane(double depth_m, double transducer_depth_m);
/// Vertical, through two places (their z does not matter), seen so that `a` lies left of `b`; origin at `a`, z = 0.
/// errors  bad_parameter: the places are above each other
[[nodiscard]] Result<PlaneSlice> vertical_plane(const Point<Sonar>& a, const Point<Sonar>& b);
/// Vertical, through the sonar, along an azimuth (clockwise from the bow), which points right.
[[nodiscard]] PlaneSlice vertical_plane(double azimuth_rad);
/// Through a point, square to a normal that points to the viewer. Its right is level and its down goes deeper; a level
/// plane has the bow up when seen from above.
/// errors  bad_parameter: no normal, not finite
[[nodiscard]] Result<PlaneSlice> oblique_plane(const Point<Sonar>& point, const Point<Sonar>& normal);

/// A rectangle in a slice's own coordinates: metres, or degrees of a range slice. Right of and below its first corner.
/// top, horizontal plane: x along `up` turned clockwise by 90 degrees, y against `up`; side: x horizontal distance,
/// y = sonar z; range: x azimuth, y minus elevation; plane: along right and down from its origin.
struct SliceExtent {
  double x0 = 0.0;
  double y0 = 0.0;
  double x1 = 0.0;
  double y1 = 0.0;
  friend bool operator==(const SliceExtent&, const SliceExtent&) = default;
};

/// Where a slice lies and what part of it is wanted.
struct SliceView {
  Slice slice;
  /// top and horizontal planes: the azimuth (from the bow) that points up; 0 = ship-up, minus heading = north-up.
  double up_rad = 0.0;
  std::optional<SliceExtent> extent{};  ///< empty = all of it
  friend bool operator==(const SliceView&, const SliceView&) = default;
};

/// errors  bad_parameter: a fan, beam or sample that the sector has not, with the range that it has
[[nodiscard]] Result<void> check_slice(const Sector& sector, const SliceView& view);

/// All of the sector that lies in the slice, and the ship where it belongs. Empty where the slice misses the sector.
[[nodiscard]] std::optional<SliceExtent> whole_extent(const Sector& sector, const SliceView& view);

/// A voxel of a sector.
struct Voxel {
  int fan = 0;
  int beam = 0;
  int sample = 0;
  friend auto operator<=>(const Voxel&, const Voxel&) = default;
};

/// Which voxel every pixel of a slice shows: the one whose cell holds the pixel's centre. Depends on the geometry only
/// and is used again for every ping of it.
class SliceMap {
 public:
  /// `extent` is spread over all pixels. Pixels outside the sector's cells show nothing.
  /// cost  about 10 ns a pixel
  SliceMap(Sector sector, SliceView view, SliceExtent extent, PixelSize size);

  [[nodiscard]] const Sector& sector() const { return sector_; }
  [[nodiscard]] const SliceView& view() const { return view_; }
  [[nodiscard]] const SliceExtent& extent() const { return extent_; }
  [[nodiscard]] PixelSize size() const { return size_; }

  /// [height][width], row-major voxel number (fan * beams + beam) * samples + sample; -1 = nothing.
  [[nodiscard]] const std::vector<std::int32_t>& voxels() const { return voxels_; }
  /// The voxel at a place of the picture.
  [[nodiscard]] std::optional<Voxel> voxel_at(PixelPoint pixel) const;
  /// Where a voxel appears: its centre, or for planes the middle of what the plane cuts from its cell. Empty where the
  /// slice does not meet the cell; may lie outside the picture.
  [[nodiscard]] std::optional<PixelPoint> place_of(const Voxel& voxel) const;
  /// Where a voxel of another slice would appear: moved into the top slice's fan, the side slice's beam, the range
  /// slice's sample, or square onto the plane. Empty where there is no such voxel; may lie outside the picture.
  [[nodiscard]] std::optional<PixelPoint> carried(const Voxel& voxel) const;
  /// A place of the picture in the sonar frame (on the fan's cone, the range shell, the plane).
  [[nodiscard]] Point<Sonar> point_at(PixelPoint pixel) const;
  /// Slice coordinates of a place of the picture, and back.
  [[nodiscard]] PixelPoint slice_coordinates(PixelPoint pixel) const;
  [[nodiscard]] PixelPoint pixel_of(double x, double y) const;
  /// Made for the same sector, view and size: the map can be used again.
  [[nodiscard]] bool fits(const Sector& sector, const SliceView& view, PixelSize size) const;

 private:
  Sector sector_;
  SliceView view_;
  SliceExtent extent_;
  PixelSize size_;
  std::vector<std::int32_t> voxels_;
};

}  // namespace sonar
