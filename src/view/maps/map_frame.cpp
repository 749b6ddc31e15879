// SPDX-License-Identifier: Apache-2.0
#include "view/maps/map_frame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace sonar {
namespace {

constexpr int kEdgeSteps = 32;

/// Calls f(u, v) for places along the edge and inside of a unit square.
template <class F>
void sample_square(const F& f) {
  for (int i = 0; i <= kEdgeSteps; ++i) {
    for (int j = 0; j <= kEdgeSteps; ++j) f(i / static_cast<double>(kEdgeSteps), j / static_cast<double>(kEdgeSteps));
  }
}

}  // namespace

PixelPoint MapFrame::at(const PlanePoint& p) const {
  return {place.x + place.width / 2.0 + (p.x - centre.x) / metres_per_px,
          place.y + place.height / 2.0 - (p.y - centre.y) / metres_per_px};
}

std::optional<PixelPoint> MapFrame::at(const Geographic& p) const {
  const auto point = projection.forward(p);
  if (!point) return std::nullopt;
  return at(*point);
}

PlanePoint MapFrame::plane(const PixelPoint& p) const {
  return {centre.x + (p.x - place.x - place.width / 2.0) * metres_per_px,
          centre.y - (p.y - place.y - place.height / 2.0) * metres_per_px};
}

std::optional<Geographic> MapFrame::geographic(const PixelPoint& p) const { return projection.inverse(plane(p)); }

double MapFrame::true_metres_per_px(const Geographic& p) const { return metres_per_px / projection.scale_at(p); }

MapFrame fit_map(const GeoExtent& extent, const PixelRect& place) {
  MapFrame map{MapProjection(extent), place, {}, 1.0};
  double low_x = std::numeric_limits<double>::infinity();
  double low_y = low_x;
  double high_x = -low_x;
  double high_y = -low_x;
  sample_square([&](double u, double v) {
    const auto p = map.projection.forward({extent.south_deg + (extent.north_deg - extent.south_deg) * v,
                                           wrap_180(extent.west_deg + (extent.east_deg - extent.west_deg) * u)});
    if (!p) return;
    low_x = std::min(low_x, p->x);
    high_x = std::max(high_x, p->x);
    low_y = std::min(low_y, p->y);
    high_y = std::max(high_y, p->y);
  });
  if (!(high_x >= low_x)) return map;
  map.centre = {(low_x + high_x) / 2.0, (low_y + high_y) / 2.0};
  const double wide = (high_x - low_x) / std::max(1.0, place.width);
  const double high = (high_y - low_y) / std::max(1.0, place.height);
  map.metres_per_px = std::max({wide, high, 1e-3});
  return map;
}

MapFrame zoomed(MapFrame whole, const MapZoom& zoom) {
  whole.centre = {whole.centre.x + zoom.moved.x, whole.centre.y + zoom.moved.y};
  whole.metres_per_px /= zoom.factor;
  return whole;
}

MapZoom zoomed_about(const PixelRect& place, double whole_metres_per_px, const MapZoom& zoom, PixelPoint at,
                     double times) {
  constexpr double kMost = 1000.0;
  MapZoom next = zoom;
  next.factor = std::clamp(zoom.factor * times, 1.0, kMost);
  if (next.factor == 1.0) return {};
  const double metres = whole_metres_per_px * (1.0 / zoom.factor - 1.0 / next.factor);
  next.moved.x += (at.x - place.x - place.width / 2.0) * metres;
  next.moved.y -= (at.y - place.y - place.height / 2.0) * metres;
  return next;
}

MapZoom dragged(double whole_metres_per_px, const MapZoom& zoom, PixelPoint from, PixelPoint to) {
  const double metres = whole_metres_per_px / zoom.factor;
  MapZoom next = zoom;
  next.moved.x -= (to.x - from.x) * metres;
  next.moved.y += (to.y - from.y) * metres;
  return next;
}

GeoExtent shown_extent(const MapFrame& map) {
  std::vector<Geographic> places;
  sample_square([&](double u, double v) {
    const auto p = map.geographic({map.place.x + u * map.place.width, map.place.y + v * map.place.height});
    if (p) places.push_back(*p);
  });
  // A pole inside the picture: every meridian is there.
  GeoExtent extent = extent_of(places).value_or(GeoExtent{});
  for (const double pole : {90.0, -90.0}) {
    const auto p = map.at(Geographic{pole, 0.0});
    if (!p || p->x < map.place.x || p->x > map.place.x + map.place.width) continue;
    if (p->y < map.place.y || p->y > map.place.y + map.place.height) continue;
    (pole > 0.0 ? extent.north_deg : extent.south_deg) = pole;
    extent.west_deg = wrap_180(extent.middle().longitude_deg - 180.0);
    extent.east_deg = extent.west_deg + 360.0;
  }
  return extent;
}

PixelPlaces::PixelPlaces(const MapFrame& map, PixelSize size, double pixels_per_step)
    : columns_(size.width / kLattice + 2) {
  const double middle_deg = map.projection.inverse(map.centre).value_or(Geographic{0.0, 0.0}).longitude_deg;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (int j = 0; j < size.height / kLattice + 2; ++j) {
    for (int i = 0; i < columns_; ++i) {
      const auto p = map.geographic(
          {map.place.x + (i * kLattice + 0.5) * pixels_per_step, map.place.y + (j * kLattice + 0.5) * pixels_per_step});
      if (p) {
        nodes_.push_back({p->latitude_deg, middle_deg + wrap_180(p->longitude_deg - middle_deg)});
      } else {
        nodes_.push_back({kNone, kNone});
      }
    }
  }
}

Geographic PixelPlaces::at(int x, int y) const {
  const int i = x / kLattice;
  const int j = y / kLattice;
  const double u = (x - i * kLattice) / static_cast<double>(kLattice);
  const double v = (y - j * kLattice) / static_cast<double>(kLattice);
  const auto node = [&](int di, int dj) {
    return nodes_[static_cast<std::size_t>(j + dj) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(i + di)];
  };
  const auto mix = [&](double a, double b, double c, double d) {
    return (a * (1 - u) + b * u) * (1 - v) + (c * (1 - u) + d * u) * v;
  };
  const Geographic a = node(0, 0);
  const Geographic b = node(1, 0);
  const Geographic c = node(0, 1);
  const Geographic d = node(1, 1);
  return {mix(a.latitude_deg, b.latitude_deg, c.latitude_deg, d.latitude_deg),
          mix(a.longitude_deg, b.longitude_deg, c.longitude_deg, d.longitude_deg)};
}

}  // namespace sonar
