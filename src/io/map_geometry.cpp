// SPDX-License-Identifier: Apache-2.0
#include "io/map_geometry.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace sonar {
namespace {

constexpr double kStrip_m = 0.04;

/// Calls f(ring) for every ring of a polygon or a multi-polygon.
template <class F>
void each_ring(OGRGeometry& geometry, const F& f) {
  if (wkbFlatten(geometry.getGeometryType()) == wkbPolygon) {
    for (OGRLinearRing* ring : *geometry.toPolygon()) f(*ring);
  } else if (wkbFlatten(geometry.getGeometryType()) == wkbMultiPolygon) {
    for (OGRPolygon* polygon : *geometry.toMultiPolygon()) each_ring(*polygon, f);
  }
}

/// Keeps the polygons (or the lines, into lines) of whatever GEOS gave.
void collect(const OGRGeometry& from, OGRGeometryCollection& into) {
  const OGRwkbGeometryType type = wkbFlatten(from.getGeometryType());
  if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection) != 0) {
    for (const OGRGeometry* part : *from.toGeometryCollection()) collect(*part, into);
  } else if (OGR_GT_GetCollection(type) == wkbFlatten(into.getGeometryType())) {
    if (!from.IsEmpty()) into.addGeometry(&from);
  }
}

/// Longitudes less so many turns; what rounding leaves beyond the line goes onto it.
void turn_back(OGRGeometry& geometry, int turns) {
  const auto turned = [&](double longitude_deg) { return std::clamp(longitude_deg - turns * 360.0, -180.0, 180.0); };
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (type == wkbPoint) {
    geometry.toPoint()->setX(turned(geometry.toPoint()->getX()));
  } else if (type == wkbLineString) {
    OGRSimpleCurve* line = geometry.toSimpleCurve();
    for (int i = 0; i < line->getNumPoints(); ++i) line->setPoint(i, turned(line->getX(i)), line->getY(i));
  } else if (type == wkbPolygon) {
    for (OGRLinearRing* ring : *geometry.toPolygon()) turn_back(*ring, turns);
  } else if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection) != 0) {
    for (OGRGeometry* part : *geometry.toGeometryCollection()) turn_back(*part, turns);
  }
}

std::unique_ptr<OGRMultiPolygon> union_of(const OGRMultiPolygon& parts) {
  auto out = std::make_unique<OGRMultiPolygon>();
  if (parts.IsEmpty()) return out;
  const std::unique_ptr<OGRGeometry> whole(parts.UnionCascaded());
  if (whole) collect(*whole, *out);
  return out;
}

std::vector<PlanePoint> vertices(const OGRPolygon& polygon) {
  std::vector<PlanePoint> points;
  const OGRLinearRing* ring = polygon.getExteriorRing();
  for (int i = 0; ring != nullptr && i < ring->getNumPoints(); ++i) points.push_back({ring->getX(i), ring->getY(i)});
  return points;
}

/// A strip that reaches a little into both pieces.
Ring strip(const PlanePoint& a, const PlanePoint& b) {
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  const double ux = length > 0.0 ? (b.x - a.x) / length * kStrip_m / 2 : kStrip_m / 2;
  const double uy = length > 0.0 ? (b.y - a.y) / length * kStrip_m / 2 : 0.0;
  return {{a.x - ux - uy, a.y - uy + ux},
          {b.x + ux - uy, b.y + uy + ux},
          {b.x + ux + uy, b.y + uy - ux},
          {a.x - ux + uy, a.y - uy - ux}};
}

struct Link {
  double distance_m = std::numeric_limits<double>::infinity();
  PlanePoint from;
  PlanePoint to;
};

/// Notes where the newly joined piece is nearer to a piece that is still apart.
void update_links(std::vector<Link>& links, const std::vector<bool>& done,
                  const std::vector<std::vector<PlanePoint>>& pieces, std::size_t joined) {
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (done[i]) continue;
    for (const PlanePoint& a : pieces[joined]) {
      for (const PlanePoint& b : pieces[i]) {
        const double d = std::hypot(a.x - b.x, a.y - b.y);
        if (d < links[i].distance_m) links[i] = {d, a, b};
      }
    }
  }
}

}  // namespace

std::unique_ptr<OGRGeometry> cut_at_date_line(const OGRGeometry& geometry) {
  OGREnvelope box;
  geometry.getEnvelope(&box);
  const int first_turn = static_cast<int>(std::floor((box.MinX + 180.0) / 360.0));
  const int last_turn = static_cast<int>(std::ceil((box.MaxX - 180.0) / 360.0));
  std::unique_ptr<OGRGeometry> whole(geometry.clone());
  if (last_turn <= first_turn) {
    // A point on the line itself may stay.
    if (last_turn != 0) turn_back(*whole, last_turn);
    return whole;
  }
  std::unique_ptr<OGRGeometryCollection> parts;
  if (geometry.getDimension() == 1) {
    parts = std::make_unique<OGRMultiLineString>();
  } else {
    parts = std::make_unique<OGRMultiPolygon>();
  }
  for (int turn = first_turn; turn <= last_turn; ++turn) {
    const double west = turn * 360.0 - 180.0;
    const Ring world = {{west, -90.0}, {west + 360.0, -90.0}, {west + 360.0, 90.0}, {west, 90.0}};
    const std::unique_ptr<OGRGeometry> part(geometry.Intersection(polygon_of(world).get()));
    if (!part) continue;
    turn_back(*part, turn);
    collect(*part, *parts);
  }
  return parts;
}

double near_longitude(double longitude_deg, double reference_deg) {
  return reference_deg + wrap_180(longitude_deg - reference_deg);
}

OGRPoint ToDegrees::point(const PlanePoint& p) const {
  const Geographic place = to_geographic(Point<Enu>{p.x, p.y, 0.0}, origin_);
  return {near_longitude(place.longitude_deg, reference_deg_), place.latitude_deg};
}

void ToDegrees::apply(OGRGeometry& geometry) const {
  each_ring(geometry, [&](OGRLinearRing& ring) {
    for (int i = 0; i < ring.getNumPoints(); ++i) {
      const OGRPoint turned = point({ring.getX(i), ring.getY(i)});
      ring.setPoint(i, turned.getX(), turned.getY());
    }
    // First and last vertex are one place: make them equal to the bit.
    ring.setPoint(ring.getNumPoints() - 1, ring.getX(0), ring.getY(0));
  });
}

void shift(OGRGeometry& geometry, const PlaneShift& into) {
  each_ring(geometry, [&](OGRLinearRing& ring) {
    for (int i = 0; i < ring.getNumPoints(); ++i) {
      const PlanePoint p = into.apply({ring.getX(i), ring.getY(i)});
      ring.setPoint(i, p.x, p.y);
    }
  });
}

std::unique_ptr<OGRPolygon> polygon_of(const Ring& ring) {
  auto polygon = std::make_unique<OGRPolygon>();
  if (ring.size() < 3) return polygon;
  auto line = std::make_unique<OGRLinearRing>();
  for (const PlanePoint& p : ring) line->addPoint(p.x, p.y);
  line->closeRings();
  polygon->addRingDirectly(line.release());
  return polygon;
}

std::unique_ptr<OGRMultiPolygon> united(const std::vector<Ring>& rings) {
  OGRMultiPolygon parts;
  for (const Ring& ring : rings) {
    if (ring.size() >= 3) parts.addGeometryDirectly(polygon_of(ring).release());
  }
  return union_of(parts);
}

std::unique_ptr<OGRMultiPolygon> united(const std::vector<std::unique_ptr<OGRMultiPolygon>>& parts) {
  OGRMultiPolygon all;
  for (const auto& part : parts) collect(*part, all);
  return union_of(all);
}

std::unique_ptr<OGRPolygon> in_one_piece(const OGRMultiPolygon& pieces) {
  if (pieces.getNumGeometries() == 0) return std::make_unique<OGRPolygon>();
  if (pieces.getNumGeometries() == 1) {
    return std::unique_ptr<OGRPolygon>(pieces.getGeometryRef(0)->clone());
  }
  std::vector<std::vector<PlanePoint>> corners;
  for (const OGRPolygon* piece : pieces) corners.push_back(vertices(*piece));
  std::vector<bool> done(corners.size(), false);
  std::vector<Link> links(corners.size());
  OGRMultiPolygon parts(pieces);
  std::size_t next = 0;
  for (std::size_t n = 1; n < corners.size(); ++n) {
    done[next] = true;
    update_links(links, done, corners, next);
    next = corners.size();
    for (std::size_t i = 0; i < links.size(); ++i) {
      if (!done[i] && (next == corners.size() || links[i].distance_m < links[next].distance_m)) next = i;
    }
    parts.addGeometryDirectly(polygon_of(strip(links[next].from, links[next].to)).release());
  }
  const auto whole = union_of(parts);
  if (whole->getNumGeometries() == 0) return std::unique_ptr<OGRPolygon>(pieces.getGeometryRef(0)->clone());
  int largest = 0;
  for (int i = 1; i < whole->getNumGeometries(); ++i) {
    if (whole->getGeometryRef(i)->get_Area() > whole->getGeometryRef(largest)->get_Area()) largest = i;
  }
  return std::unique_ptr<OGRPolygon>(whole->getGeometryRef(largest)->clone());
}

}  // namespace sonar
