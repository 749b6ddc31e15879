// SPDX-License-Identifier: Apache-2.0
#include "io/mask_outlines.h"

#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "geo/geodesic.h"
#include "io/map_geometry.h"

namespace sonar {
namespace {

void append(GeoArea& area, const OGRLinearRing& ring, const Geographic& origin) {
  std::vector<Geographic>& places = area.rings.emplace_back();
  for (int i = 0; i + 1 < ring.getNumPoints(); ++i) {
    places.push_back(to_geographic(Point<Enu>{ring.getX(i), ring.getY(i), 0.0}, origin));
  }
}

/// From the plane about a place to degrees.
GeoArea area_of(const OGRMultiPolygon& polygons, const Geographic& origin) {
  GeoArea area;
  for (const OGRPolygon* polygon : polygons) {
    for (const OGRLinearRing* ring : *polygon) append(area, *ring, origin);
  }
  return area;
}

bool has_place(const PingNavigation& ping) { return ping.has_position() && std::isfinite(ping.heading_deg); }

GeoArea swept(const ObservationProduct& product, const Sector& sector, const PlacementOf& placed) {
  std::optional<Geographic> origin;
  std::vector<Ring> footprints;
  for (const PingNavigation& ping : product.pings) {
    if (!has_place(ping)) continue;
    if (!origin) origin = ping.transducer;
    const PlaneShift into(ping.transducer, *origin);
    Ring ring = footprint(*product.grid, sector, placed(ping));
    for (PlanePoint& p : ring) p = into.apply(p);
    footprints.push_back(std::move(ring));
  }
  return origin ? area_of(*united(footprints), *origin) : GeoArea{};
}

GeoArea school_area(const ObservationProduct& product, const Sector& sector, std::int64_t school_id,
                    const PlacementOf& placed) {
  std::optional<Geographic> origin;
  std::vector<std::unique_ptr<OGRMultiPolygon>> parts;
  for (const SchoolMask& mask : product.masks) {
    const auto pings = static_cast<std::int64_t>(product.pings.size());
    if (mask.school_id != school_id || mask.ping_index < 0 || mask.ping_index >= pings) continue;
    const PingNavigation& ping = product.pings[static_cast<std::size_t>(mask.ping_index)];
    if (!has_place(ping)) continue;
    if (!origin) origin = ping.transducer;
    auto outline = united(mask_rings(sector, mask.mask, placed(ping)));
    shift(*outline, PlaneShift(ping.transducer, *origin));
    parts.push_back(std::move(outline));
  }
  return origin ? area_of(*united(parts), *origin) : GeoArea{};
}

}  // namespace

ObservationOutlines map_outlines(const ObservationProduct& product, const PlacementOf& placed) {
  ObservationOutlines out;
  out.observation = product.observation;
  std::optional<Sector> sector;
  if (product.grid) {
    sector = product.grid->grid.sector(product.grid->range);
    out.swept = swept(product, *sector, placed);
  }
  for (const SchoolRow& school : product.schools) {
    out.schools.push_back(
        {school.school_id, sector ? school_area(product, *sector, school.school_id, placed) : GeoArea{}});
  }
  return out;
}

GeoArea swept_outline(const ObservationProduct& product, const PlacementOf& placed) {
  return product.grid ? swept(product, product.grid->grid.sector(product.grid->range), placed) : GeoArea{};
}

GeoArea school_outline(const ObservationProduct& product, std::int64_t school_id, const PlacementOf& placed) {
  return product.grid ? school_area(product, product.grid->grid.sector(product.grid->range), school_id, placed)
                      : GeoArea{};
}

}  // namespace sonar
