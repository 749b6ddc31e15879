// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "geo/map_projection.h"
#include "view/frame_description.h"
#include "view/image.h"

namespace sonar {

/// A map's place in the picture: which pixel shows which place on Earth. North is up at the middle, or nearly so.
struct MapFrame {
  MapProjection projection;
  PixelRect place;
  PlanePoint centre;  ///< map metres at the middle of `place`
  double metres_per_px = 1.0;

  [[nodiscard]] PixelPoint at(const PlanePoint& p) const;
  [[nodiscard]] std::optional<PixelPoint> at(const Geographic& p) const;
  [[nodiscard]] PlanePoint plane(const PixelPoint& p) const;
  [[nodiscard]] std::optional<Geographic> geographic(const PixelPoint& p) const;
  /// True metres of a pixel at a place.
  [[nodiscard]] double true_metres_per_px(const Geographic& p) const;
};

/// The whole extent, as large as the rectangle allows.
[[nodiscard]] MapFrame fit_map(const GeoExtent& extent, const PixelRect& place);

/// How a map differs from the one that shows everything.
struct MapZoom {
  double factor = 1.0;  ///< 2 = twice as large
  PlanePoint moved;     ///< of the map's middle, map metres
  friend bool operator==(const MapZoom&, const MapZoom&) = default;
};
/// zoom  of the map that shows everything
[[nodiscard]] MapFrame zoomed(MapFrame whole, const MapZoom& zoom);
/// So many times larger, while what lies under a pixel stays there; between the whole and 1000 times it.
/// place                of the map in the picture
/// whole_metres_per_px  of the map that shows everything
[[nodiscard]] MapZoom zoomed_about(const PixelRect& place, double whole_metres_per_px, const MapZoom& zoom,
                                   PixelPoint at, double times);
/// What lay under one pixel comes to lie under another.
[[nodiscard]] MapZoom dragged(double whole_metres_per_px, const MapZoom& zoom, PixelPoint from, PixelPoint to);

/// What the rectangle of a map really shows, beyond the extent it was fitted to.
[[nodiscard]] GeoExtent shown_extent(const MapFrame& map);

/// Latitudes and longitudes of every pixel of an area, found exactly on a coarse lattice and interpolated between.
/// Longitudes run on over 180 seen from the map's middle.
class PixelPlaces {
 public:
  PixelPlaces(const MapFrame& map, PixelSize size, double pixels_per_step);
  /// Of the middle of step (x, y) of the area; NaN where the projection has no place.
  [[nodiscard]] Geographic at(int x, int y) const;

 private:
  static constexpr int kLattice = 8;
  int columns_ = 0;
  std::vector<Geographic> nodes_;
};

}  // namespace sonar
