// SPDX-License-Identifier: Apache-2.0
#include "io/map_geometry.h"

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

/// Keeps the polygons of whatever a union gave.
void collect(const OGRGeometry& from, OGRMultiPolygon& into) {
  const OGRwkbGeometryType type = wkbFlatten(from.getGeometryType());
  if (type == wkbPolygon) {
    if (!from.IsEmpty()) into.addGeometry(&from);
  } else if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection) != 0) {
    for (const OGRGeometry* part : *from.toGeometryCollection()) collect(*part, into);
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
