// SPDX-License-Identifier: Apache-2.0
#include "model/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "base/units.h"

namespace sonar {
namespace {

/// Arcs are drawn with chords of at most this angle: they leave the arc by 0.03 % of the range.
constexpr double kChord_rad = 0.05;
constexpr double kHair_rad = 0.002 * std::numbers::pi / 180.0;

/// Level distances from the transducer, m.
struct Interval {
  double near_m;
  double far_m;
  friend auto operator<=>(const Interval&, const Interval&) = default;
};

/// x = bow, y = starboard becomes x = east, y = north.
PlanePoint turned(double azimuth_rad, double distance_m, double heading_rad) {
  const double bearing = azimuth_rad + heading_rad;
  return {distance_m * std::sin(bearing), distance_m * std::cos(bearing)};
}

void append_arc(Ring& ring, double from_rad, double to_rad, double distance_m, double heading_rad) {
  const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(to_rad - from_rad) / kChord_rad)));
  for (int i = 0; i <= steps; ++i) {
    ring.push_back(turned(from_rad + (to_rad - from_rad) * i / steps, distance_m, heading_rad));
  }
}

Ring annular_piece(const AngleBounds& azimuth, const Interval& interval, double heading_rad) {
  Ring ring;
  const double first = azimuth.lower - kHair_rad;
  const double last = azimuth.upper + kHair_rad;
  append_arc(ring, first, last, interval.far_m, heading_rad);
  if (interval.near_m > 1e-3) {
    append_arc(ring, last, first, interval.near_m, heading_rad);
  } else {
    ring.push_back({0.0, 0.0});
  }
  return ring;
}

/// Level interval of a run of one cell row; elevations beyond the vertical are none of a cell's.
Interval level_interval(const Sector& sector, const Run& run, int fan) {
  const AngleBounds e = sector.elevation_bounds(fan);
  const RangeAxis& axis = sector.range();
  const double r1 = std::max(0.0, axis.range_m(run.first_sample) - axis.spacing_m / 2);
  const double r2 = std::max(0.0, axis.range_m(run.end() - 1) + axis.spacing_m / 2);
  const bool level = e.lower < 0.0 && e.upper > 0.0;
  const double steepest = std::min(std::cos(e.lower), std::cos(e.upper));
  const double flattest = level ? 1.0 : std::max(std::cos(e.lower), std::cos(e.upper));
  return {r1 * std::max(0.0, steepest), r2 * std::max(0.0, flattest)};
}

/// The same along rays: of the cell row's corners.
Interval bent_interval(const Sector& sector, const Run& run, int fan, const Placement& placement) {
  const AngleBounds e = sector.elevation_bounds(fan);
  const RangeAxis& axis = sector.range();
  Interval out{std::numeric_limits<double>::infinity(), 0.0};
  for (const double elevation : {e.lower, std::clamp(0.0, e.lower, e.upper), e.upper}) {
    for (const double sample : {run.first_sample - 0.5, run.end() - 0.5}) {
      const double r = std::max(0.0, axis.range_m(sample));
      const Point<Sonar> place = levelled(Sector::direction(elevation, 0.0) * r, placement);
      const double level_m = std::hypot(place.x, place.y);
      out = {std::min(out.near_m, level_m), std::max(out.far_m, level_m)};
    }
  }
  return out;
}

std::vector<Interval> joined(std::vector<Interval> intervals) {
  std::sort(intervals.begin(), intervals.end());
  std::vector<Interval> out;
  for (const Interval& i : intervals) {
    if (!out.empty() && i.near_m <= out.back().far_m + 1e-6) {
      out.back().far_m = std::max(out.back().far_m, i.far_m);
    } else {
      out.push_back(i);
    }
  }
  return out;
}

bool turns(const Placement& placement) { return placement.roll_rad != 0.0 || placement.pitch_rad != 0.0; }
/// A damaged product may say anything.
bool known(const Placement& placement) { return std::isfinite(norm(levelled(Point<Sonar>{1.0, 0.0, 1.0}, placement))); }

/// Angle number i of `steps` equal steps.
double angle_at(const AngleBounds& bounds, int i, int steps) {
  return bounds.lower + (bounds.upper - bounds.lower) * i / steps;
}

int chords(const AngleBounds& bounds) {
  return std::max(1, static_cast<int>(std::ceil((bounds.upper - bounds.lower) / kChord_rad)));
}

/// A row of cells whose beam is turned no longer lies between circles about the transducer: piece by piece of its azimuth
/// it is the hull of its corners.
void append_turned(std::vector<Ring>& rings, const Sector& sector, const Run& run, const Placement& placement) {
  constexpr double kUp_rad = std::numbers::pi / 2;
  const AngleBounds a = sector.azimuth_bounds(run.row % sector.beams());
  const AngleBounds e = sector.elevation_bounds(run.row / sector.beams());
  const AngleBounds azimuth{a.lower - kHair_rad, a.upper + kHair_rad};
  const AngleBounds elevation{std::max(e.lower - kHair_rad, -kUp_rad), std::min(e.upper + kHair_rad, kUp_rad)};
  const RangeAxis& axis = sector.range();
  const std::array ends_m{std::max(0.0, axis.range_m(run.first_sample - 0.5)),
                          std::max(0.0, axis.range_m(run.end() - 0.5))};
  const int pieces = chords(azimuth);
  const int rows = chords(elevation);
  const auto append_corners = [&](std::vector<PlanePoint>& corners, double azimuth_rad) {
    for (int i = 0; i <= rows; ++i) {
      const Point<Sonar> direction = Sector::direction(angle_at(elevation, i, rows), azimuth_rad);
      for (const double r : ends_m) {
        const Point<Enu> at = to_enu(levelled(direction * r, placement), placement.heading_rad);
        corners.push_back({at.x, at.y});
      }
    }
  };
  for (int piece = 0; piece < pieces; ++piece) {
    std::vector<PlanePoint> corners;
    append_corners(corners, angle_at(azimuth, piece, pieces));
    append_corners(corners, angle_at(azimuth, piece + 1, pieces));
    rings.push_back(convex_hull(std::move(corners)));
  }
}

/// The farthest that fans reach along an azimuth of the sector once they are turned.
/// along_m  [fan], of the beams
PlanePoint farthest(const Sector& sector, const std::vector<double>& along_m, double azimuth_rad,
                    const Placement& placement) {
  PlanePoint out{0.0, 0.0};
  for (int fan = 0; fan < sector.fans(); ++fan) {
    const AngleBounds e = sector.elevation_bounds(fan);
    const int rows = chords(e);
    for (int i = 0; i <= rows; ++i) {
      const Point<Sonar> direction = Sector::direction(angle_at(e, i, rows), azimuth_rad);
      const Point<Sonar> turned = levelled_direction(direction, placement) * along_m[static_cast<std::size_t>(fan)];
      const Point<Enu> at = to_enu(turned, placement.heading_rad);
      if (std::hypot(at.x, at.y) > std::hypot(out.x, out.y)) out = {at.x, at.y};
    }
  }
  return out;
}

}  // namespace

Ring footprint(const GridRecord& record, const Sector& sector, const Placement& placement) {
  double reach_m = 0.0;
  std::vector<double> along_m(static_cast<std::size_t>(sector.fans()), 0.0);
  for (int fan = 0; fan < sector.fans(); ++fan) {
    const auto f = static_cast<std::size_t>(fan);
    const int samples = std::min(record.sample_count[f], record.range.count);
    if (samples <= 0) continue;
    along_m[f] = std::max(0.0, sector.range().range_m(samples - 0.5));
    reach_m = std::max(reach_m, level_interval(sector, {0, samples - 1, 1}, fan).far_m);
  }
  Ring ring;
  if (reach_m <= 0.0 || !known(placement)) return ring;
  AngleBounds azimuth{sector.azimuth_bounds(0).lower, sector.azimuth_bounds(sector.beams() - 1).upper};
  const bool round = azimuth.upper - azimuth.lower >= 2.0 * std::numbers::pi - 1e-6;
  if (round) azimuth = {0.0, 2.0 * std::numbers::pi};
  if (turns(placement)) {
    const int steps = chords(azimuth);
    for (int i = 0; i <= steps; ++i) {
      ring.push_back(farthest(sector, along_m, angle_at(azimuth, i, steps), placement));
    }
  } else {
    append_arc(ring, azimuth.lower, azimuth.upper, reach_m, placement.heading_rad);
  }
  if (round) {
    ring.pop_back();
  } else {
    ring.push_back({0.0, 0.0});
  }
  return ring;
}

std::vector<Ring> mask_rings(const Sector& sector, const PingMask& mask, const Placement& placement) {
  std::vector<Ring> rings;
  if (!known(placement)) return rings;
  if (turns(placement)) {
    for (const Run& run : mask.runs) append_turned(rings, sector, run, placement);
    return rings;
  }
  const int beams = sector.beams();
  std::vector<std::vector<Interval>> of_beam(static_cast<std::size_t>(beams));
  for (const Run& run : mask.runs) {
    const int fan = run.row / beams;
    const Interval interval =
        placement.rays ? bent_interval(sector, run, fan, placement) : level_interval(sector, run, fan);
    if (interval.far_m > interval.near_m) of_beam[static_cast<std::size_t>(run.row % beams)].push_back(interval);
  }
  for (int beam = 0; beam < beams; ++beam) {
    for (const Interval& interval : joined(std::move(of_beam[static_cast<std::size_t>(beam)]))) {
      rings.push_back(annular_piece(sector.azimuth_bounds(beam), interval, placement.heading_rad));
    }
  }
  return rings;
}

PlaneShift::PlaneShift(const Geographic& ping, const Geographic& origin) {
  const Point<Enu> here = to_enu(ping, origin);
  shift_ = {here.x, here.y};
  // A kilometre north of the ping, seen in the other plane, shows the turn.
  const Point<Enu> north = to_enu(destination(ping, 1000.0, 0.0), origin);
  const double length = std::hypot(north.x - here.x, north.y - here.y);
  sine_ = (north.x - here.x) / length;
  cosine_ = (north.y - here.y) / length;
}

PlanePoint PlaneShift::apply(const PlanePoint& p) const {
  return {shift_.x + p.x * cosine_ + p.y * sine_, shift_.y - p.x * sine_ + p.y * cosine_};
}

PlanePoint PlaneShift::back(const PlanePoint& p) const {
  const PlanePoint d{p.x - shift_.x, p.y - shift_.y};
  return {d.x * cosine_ - d.y * sine_, d.x * sine_ + d.y * cosine_};
}

}  // namespace sonar
