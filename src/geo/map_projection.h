// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "geo/frames.h"
#include "geo/geodesic.h"

namespace sonar {

/// What a map shows: latitudes, and longitudes that run on over 180 instead of jumping (west in [-180, 180), east up to
/// 360 more).
struct GeoExtent {
  double south_deg = 0.0;
  double north_deg = 0.0;
  double west_deg = 0.0;
  double east_deg = 0.0;

  [[nodiscard]] Geographic middle() const;
  [[nodiscard]] bool contains(const Geographic& place) const;
  friend bool operator==(const GeoExtent&, const GeoExtent&) = default;
};

/// The smallest extent of these places: over 180 degrees where that is the shorter way round. Places that are not finite
/// are left out; empty where none is left.
[[nodiscard]] std::optional<GeoExtent> extent_of(std::span<const Geographic> places);
/// Wider by a distance on every side; latitudes stop at the poles, longitudes at a full turn.
[[nodiscard]] GeoExtent widened(const GeoExtent& extent, double by_m);

/// A conformal map projection of the WGS 84 ellipsoid, metres, fitted to an extent: polar stereographic from 70 degrees
/// on, transverse Mercator for what is narrow, Mercator about the equator, else Lambert conformal conic. The middle of
/// the extent lies at or near (0, 0).
/// threads  one object belongs to one thread; copies are independent
class MapProjection {
 public:
  explicit MapProjection(const GeoExtent& extent);
  MapProjection(const MapProjection& other);
  MapProjection& operator=(const MapProjection& other);
  MapProjection(MapProjection&&) noexcept;
  MapProjection& operator=(MapProjection&&) noexcept;
  ~MapProjection();

  /// x right, y up on the map, m; empty where the projection has no place for it (the far pole).
  [[nodiscard]] std::optional<PlanePoint> forward(const Geographic& place) const;
  [[nodiscard]] std::optional<Geographic> inverse(const PlanePoint& point) const;

  /// Map metres per true metre at a place, the same in every direction.
  [[nodiscard]] double scale_at(const Geographic& place) const;
  /// Direction of true north on the map, radians clockwise from its y axis.
  [[nodiscard]] double north_rad(const Geographic& place) const;

  /// For the legend: "Lambert conformal conic, 59.50° N and 60.50° N, central meridian 4.00° E; WGS 84".
  [[nodiscard]] const std::string& name() const;
  /// As PROJ takes it.
  [[nodiscard]] const std::string& definition() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sonar
