// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ogr_geometry.h>

#include <memory>
#include <optional>
#include <vector>

#include "geo/geodesic.h"
#include "model/outline.h"
#include "model/product.h"

namespace sonar {

/// From a plane about a place to degrees: longitudes near `reference_longitude_deg`, also beyond 180.
class ToDegrees {
 public:
  ToDegrees(const Geographic& origin, double reference_longitude_deg)
      : origin_(origin), reference_deg_(reference_longitude_deg) {}
  [[nodiscard]] OGRPoint point(const PlanePoint& p) const;
  /// Turns every vertex of a polygon or multi-polygon.
  void apply(OGRGeometry& geometry) const;

 private:
  Geographic origin_;
  double reference_deg_;
};

/// The longitude that lies within half a turn of the reference.
[[nodiscard]] double near_longitude(double longitude_deg, double reference_deg);

/// The same place with longitudes in [-180, 180]: moved by whole turns, and cut where it crosses the date line, which
/// makes a LineString or Polygon a MultiLineString or MultiPolygon. Points, lines, polygons and collections of them.
[[nodiscard]] std::unique_ptr<OGRGeometry> cut_at_date_line(const OGRGeometry& geometry);

/// Union of rings, in their plane; empty where GEOS gives none.
[[nodiscard]] std::unique_ptr<OGRMultiPolygon> united(const std::vector<Ring>& rings);
[[nodiscard]] std::unique_ptr<OGRMultiPolygon> united(const std::vector<std::unique_ptr<OGRMultiPolygon>>& parts);

/// One polygon of several pieces, joined by strips of 4 cm between their nearest vertices.
[[nodiscard]] std::unique_ptr<OGRPolygon> in_one_piece(const OGRMultiPolygon& pieces);

[[nodiscard]] std::unique_ptr<OGRPolygon> polygon_of(const Ring& ring);
/// Every vertex moved into another plane.
void shift(OGRGeometry& geometry, const PlaneShift& into);

}  // namespace sonar
