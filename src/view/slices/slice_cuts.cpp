// SPDX-License-Identifier: Apache-2.0
#include "view/slices/slice_cuts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "view/maps/contours.h"
#include "view/slices/plane_outline.h"
#include "view/slices/slice_geometry.h"

namespace sonar {
namespace {

constexpr int kCells = 64;             ///< of the lattice in which lines are looked for, each way
constexpr double kStraight_px = 0.25;  ///< a bend that nobody sees

double dot(const Point<Sonar>& a, const Point<Sonar>& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Ranges between two others at which a plane has corners of a beam's cell on both sides; the farthest sample of it.
std::optional<Voxel> farthest_in_plane(const Sector& sector, const PlaneSlice& plane, const Run& run) {
  const Voxel beam{run.row / sector.beams(), run.row % sector.beams(), 0};
  const Point<Sonar> normal = normal_of(plane);
  const double away_m = dot(plane.origin, normal);
  const AngleBounds e = sector.elevation_bounds(beam.fan);
  const AngleBounds a = sector.azimuth_bounds(beam.beam);
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for (const double elevation : {e.lower, e.upper}) {
    for (const double azimuth : {a.lower, a.upper}) {
      const double rise = dot(Sector::direction(elevation, azimuth), normal);
      least = std::min(least, rise);
      most = std::max(most, rise);
    }
  }
  // At a range r the corners lie between r * least and r * most along the normal: two conditions, each linear in r.
  double first_m = std::max(0.0, sector.range().range_m(run.first_sample - 0.5));
  double last_m = sector.range().range_m(run.end() - 0.5);
  const auto at_most = [&](double rise, double limit) {  // r * rise <= limit
    if (rise > 0.0) last_m = std::min(last_m, limit / rise);
    if (rise < 0.0) first_m = std::max(first_m, limit / rise);
    if (rise == 0.0 && limit < 0.0) last_m = -1.0;
  };
  at_most(least, away_m);
  at_most(-most, -away_m);
  if (last_m < first_m) return std::nullopt;
  const double sample = std::ceil(sector.range().sample_at(last_m) - 0.5);
  return Voxel{beam.fan, beam.beam, std::clamp(static_cast<int>(sample), run.first_sample, run.end() - 1)};
}

/// A surface that a slice lies in: signed distances to it, m, 0 upon it.
class Surface {
 public:
  Surface(const Sector& sector, const Slice& slice) : slice_(slice) {
    if (const auto* top = std::get_if<TopSlice>(&slice)) angle_ = sector.elevation_rad(top->fan);
    if (const auto* side = std::get_if<SideSlice>(&slice)) angle_ = sector.azimuth_rad(side->beam);
    if (const auto* range = std::get_if<RangeSlice>(&slice)) range_m_ = sector.range().range_m(range->sample);
    if (const auto* plane = std::get_if<PlaneSlice>(&slice)) normal_ = normal_of(*plane);
    cos_ = std::cos(angle_);
    sin_ = std::sin(angle_);
  }

  [[nodiscard]] double distance(const Point<Sonar>& p) const {
    switch (kind_of(slice_)) {
      case SliceKind::top:
        return p.z * cos_ + std::hypot(p.x, p.y) * sin_;
      case SliceKind::side:
        return p.y * cos_ - p.x * sin_;
      case SliceKind::range:
        return norm(p) - range_m_;
      case SliceKind::plane:
        break;
    }
    return dot(p - std::get<PlaneSlice>(slice_).origin, normal_);
  }
  /// Negative where the surface is not the slice's: behind the sonar a beam goes on as the opposite one.
  [[nodiscard]] double belongs(const Point<Sonar>& p) const {
    if (kind_of(slice_) != SliceKind::side) return std::numeric_limits<double>::infinity();
    return p.x * cos_ + p.y * sin_;
  }

 private:
  Slice slice_;
  double angle_ = 0.0;
  double cos_ = 1.0;
  double sin_ = 0.0;
  double range_m_ = 0.0;
  Point<Sonar> normal_;
};

double distance_px(PixelPoint p, PixelPoint a, PixelPoint b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double length = std::hypot(dx, dy);
  if (length < 1e-9) return std::hypot(p.x - a.x, p.y - a.y);
  return std::abs((p.x - a.x) * dy - (p.y - a.y) * dx) / length;
}

/// The same line with fewer places (Douglas and Peucker).
void add_simpler(const std::vector<PixelPoint>& line, std::size_t first, std::size_t last,
                 std::vector<PixelPoint>& out) {
  std::size_t farthest = first;
  double most = kStraight_px;
  for (std::size_t i = first + 1; i < last; ++i) {
    const double off = distance_px(line[i], line[first], line[last]);
    if (!(off > most)) continue;
    most = off;
    farthest = i;
  }
  if (farthest != first) {
    add_simpler(line, first, farthest, out);
    add_simpler(line, farthest, last, out);
    return;
  }
  out.push_back(line[last]);
}

std::vector<PixelPoint> simpler(const std::vector<PixelPoint>& line) {
  std::vector<PixelPoint> out{line.front()};
  add_simpler(line, 0, line.size() - 1, out);
  return out;
}

/// The parts of a line where a value, linear between its places, is not negative.
template <class Value>
void add_inside(const std::vector<PixelPoint>& line, const Value& value, std::vector<std::vector<PixelPoint>>& out) {
  std::vector<PixelPoint> part;
  const auto end_part = [&] {
    if (part.size() > 1) out.push_back(simpler(part));
    part.clear();
  };
  double before = 0.0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const double now = value(line[i]);
    if (i > 0 && (before < 0.0) != (now < 0.0)) {
      const double t = before / (before - now);
      part.push_back(
          {line[i - 1].x + t * (line[i].x - line[i - 1].x), line[i - 1].y + t * (line[i].y - line[i - 1].y)});
    }
    if (now < 0.0) {
      end_part();
    } else {
      part.push_back(line[i]);
    }
    before = now;
  }
  end_part();
}

}  // namespace

std::optional<Voxel> farthest_cut(const Sector& sector, const Slice& slice, const Run& run) {
  if (run.count <= 0) return std::nullopt;
  const Voxel last{run.row / sector.beams(), run.row % sector.beams(), run.end() - 1};
  if (const auto* top = std::get_if<TopSlice>(&slice)) return last.fan == top->fan ? std::optional(last) : std::nullopt;
  if (const auto* side = std::get_if<SideSlice>(&slice)) {
    return last.beam == side->beam ? std::optional(last) : std::nullopt;
  }
  if (const auto* range = std::get_if<RangeSlice>(&slice)) {
    if (range->sample < run.first_sample || range->sample >= run.end()) return std::nullopt;
    return Voxel{last.fan, last.beam, range->sample};
  }
  return farthest_in_plane(sector, std::get<PlaneSlice>(slice), run);
}

bool cuts(const Sector& sector, const Slice& slice, const PingMask& mask) {
  return std::any_of(mask.runs.begin(), mask.runs.end(),
                     [&](const Run& run) { return farthest_cut(sector, slice, run).has_value(); });
}

std::vector<std::vector<PixelPoint>> slice_cut(const SliceMap& map, const Slice& other) {
  const SliceGeometry geometry(map.sector(), map.view());
  const Surface surface(map.sector(), other);
  const auto point = [&](PixelPoint pixel) {
    const PixelPoint p = map.slice_coordinates(pixel);
    return geometry.point(p.x, p.y);
  };
  const double step_x = 1.0 * map.size().width / kCells;
  const double step_y = 1.0 * map.size().height / kCells;
  ScalarField field;
  field.size = {kCells + 1, kCells + 1};
  field.values.reserve(field.size.count());
  for (int y = 0; y <= kCells; ++y) {
    for (int x = 0; x <= kCells; ++x) {
      field.values.push_back(static_cast<float>(surface.distance(point({x * step_x, y * step_y}))));
    }
  }
  // A plane may be the other slice itself: then it is cut nowhere, and all that is left is rounding.
  constexpr float kSame_m = 1e-3F;
  if (std::ranges::all_of(field.values, [](float off_m) { return std::abs(off_m) < kSame_m; })) return {};
  // Where everything meets, at the sonar, the lattice is too coarse: lines begin a cell away from it.
  const bool in_metres = kind_of(map.view().slice) != SliceKind::range;
  const SliceExtent& e = map.extent();
  const double begin_m = in_metres ? 1.5 * std::max(e.x1 - e.x0, e.y1 - e.y0) / kCells : 0.0;
  const auto inside = [&](PixelPoint pixel) {
    const Point<Sonar> p = point(pixel);
    return std::min({inside_by_m(map.sector(), p), surface.belongs(p), norm(p) - begin_m});
  };
  std::vector<std::vector<PixelPoint>> lines;
  for (const ContourLine& contour : contour_lines(field, 0.0)) {
    std::vector<PixelPoint> line;
    for (const PixelPoint& p : contour.points) line.push_back({p.x * step_x, p.y * step_y});
    if (contour.closed && !line.empty()) line.push_back(line.front());
    if (line.size() > 1) add_inside(line, inside, lines);
  }
  return lines;
}

}  // namespace sonar
