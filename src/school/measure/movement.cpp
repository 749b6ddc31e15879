// SPDX-License-Identifier: Apache-2.0
#include "school/measure/movement.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/units.h"
#include "geo/geodesic.h"

namespace sonar {
namespace {

constexpr double kLeastRelative_mps = 0.25;
constexpr TimeNs kWakeAge = 600 * kSecondNs;

Point<Enu> velocity(double speed_mps, double course_deg) {
  const double course = rad_from_deg(course_deg);
  return {speed_mps * std::sin(course), speed_mps * std::cos(course), 0.0};
}

double dot(const Point<Enu>& a, const Point<Enu>& b) { return a.x * b.x + a.y * b.y; }

/// The places of a track within half a window of place i: [first, last).
std::pair<std::size_t, std::size_t> window_about(const CentreTrack& track, std::size_t i, double window_s) {
  const std::vector<double>& t = track.places.t;
  const auto first = std::lower_bound(t.begin(), t.end(), t[i] - window_s / 2.0);
  const auto last = std::upper_bound(first, t.end(), t[i] + window_s / 2.0);
  return {static_cast<std::size_t>(first - t.begin()), static_cast<std::size_t>(last - t.begin())};
}

using PartOf = TimedPlaces (*)(const CentreTrack& track, std::size_t first, std::size_t last);
TimedPlaces places_of(const CentreTrack& track, std::size_t first, std::size_t last) { return track.part(first, last); }
/// Depth in both coordinates.
TimedPlaces depths_of(const CentreTrack& track, std::size_t first, std::size_t last) {
  TimedPlaces out = track.part(first, last);
  out.x.assign(track.depth_m.begin() + static_cast<std::ptrdiff_t>(first),
               track.depth_m.begin() + static_cast<std::ptrdiff_t>(last));
  out.y = out.x;
  return out;
}

/// Scatter about lines of one window each; empty where none has three places.
std::optional<Scatter> scatter_of(const CentreTrack& track, double window_s, PartOf part) {
  std::vector<TimedPlaces> pieces;
  for (const auto& [first, last] : stretches(track, window_s)) {
    if (track.tells_line(first, last)) pieces.push_back(part(track, first, last));
  }
  return pieces.empty() ? std::nullopt : std::optional(common_scatter(pieces));
}

/// Variance and covariance as a form of two directions.
double form(double xx, double xy, double yy, const Point<Enu>& a, const Point<Enu>& b) {
  return a.x * b.x * xx + (a.x * b.y + a.y * b.x) * xy + a.y * b.y * yy;
}

/// Standard error of a line's slope along a direction of length 1.
double error_along(const LineFit& line, const Point<Enu>& away) {
  return std::sqrt(std::max(form(line.variance_xx, line.variance_xy, line.variance_yy, away, away), 0.0));
}

/// Distance of a place, seen from the origin, to the line between two others.
double distance_to(const Point<Enu>& place, const Point<Enu>& from, const Point<Enu>& to) {
  const Point<Enu> way = to - from;
  const double square = dot(way, way);
  const double share = square > 0.0 ? std::clamp(dot(place - from, way) / square, 0.0, 1.0) : 0.0;
  const Point<Enu> off = place - (from + way * share);
  return std::hypot(off.x, off.y);
}

/// A school's velocities at the places of its track.
class Velocities {
 public:
  Velocities(std::span<const SchoolPingRow> rows, const SummariseParams& params, const WaterCurrents* water)
      : track_(uncut_track(rows)),
        window_s_(params.movement_window_s),
        scatter_(scatter_of(track_, window_s_, places_of)),
        depth_scatter_(scatter_of(track_, window_s_, depths_of)) {
    if (water != nullptr && track_.size() > 0) water_ = drifted_water(track_, rows, *water);
  }

  struct Now {
    LineFit line;
    Scatter scatter;          ///< of places about lines
    double with_place = 0.0;  ///< covariance of place and velocity, over the scatter
    LineFit down;             ///< of depth, in x
    std::optional<CurrentAlong> current;

    /// Standard error of what changes so with the school's place and velocity, to first order.
    [[nodiscard]] double error_of(const Point<Enu>& by_place, const Point<Enu>& by_velocity) const {
      const auto scattered = [this](const Point<Enu>& a, const Point<Enu>& b) {
        return form(scatter.variance_xx, scatter.variance_xy, scatter.variance_yy, a, b);
      };
      const double velocity = form(line.variance_xx, line.variance_xy, line.variance_yy, by_velocity, by_velocity);
      const double variance =
          scattered(by_place, by_place) + velocity + 2.0 * with_place * scattered(by_place, by_velocity);
      return std::sqrt(std::max(variance, 0.0));
    }
  };
  /// By place of the track.
  [[nodiscard]] std::optional<Now> at(std::size_t i) const {
    if (!scatter_) return std::nullopt;
    const auto [first, last] = window_about(track_, i, window_s_);
    if (!track_.tells_line(first, last)) return std::nullopt;
    const TimedPlaces places = track_.part(first, last);
    Now now{fit_line(places, *scatter_),
            *scatter_,
            covariance_with_slope(places.t, scatter_->tau_s, i - first),
            fit_line(depths_of(track_, first, last), *depth_scatter_),
            {}};
    if (water_) now.current = water_->along(first, last);
    return now;
  }
  [[nodiscard]] const CentreTrack& track() const { return track_; }

 private:
  CentreTrack track_;
  double window_s_;
  std::optional<Scatter> scatter_;
  std::optional<Scatter> depth_scatter_;  ///< known where scatter_ is
  std::optional<DriftedWater> water_;
};

void take_velocity(const Velocities::Now& now, SchoolPingRow& row) {
  const Speed speed = speed_of(now.line);
  row.speed_smoothed_mps = speed.speed_mps;
  row.speed_smoothed_se_mps = speed.speed_se_mps;
  row.course_smoothed_deg = speed.course_deg;
  row.course_smoothed_se_deg = speed.course_se_deg;
  row.vertical_speed_smoothed_mps = now.down.slope_x;
  row.vertical_speed_smoothed_se_mps = std::sqrt(std::max(now.down.variance_xx, 0.0));
  if (!now.current) return;
  const Speed water = speed_through_water(now.line, *now.current);
  row.speed_water_smoothed_mps = water.speed_mps;
  row.course_water_smoothed_deg = water.course_deg;
  row.speed_water_smoothed_se_mps = water.speed_se_mps;
  row.course_water_smoothed_se_deg = water.course_se_deg;
}

/// Of the school's velocity along the horizontal line from the ship.
/// school  place of its centre from the ship, not 0
void take_away(const Velocities::Now& now, const Point<Enu>& school, SchoolPingRow& row) {
  const double distance_m = std::hypot(school.x, school.y);
  const Point<Enu> away = school * (1.0 / distance_m);
  row.speed_away_mps = now.line.slope_x * away.x + now.line.slope_y * away.y;
  row.speed_away_se_mps = error_along(now.line, away);
  if (now.current) {
    const LineFit water = through_water(now.line, now.current->drift);
    row.speed_away_water_mps = water.slope_x * away.x + water.slope_y * away.y;
    if (std::isfinite(now.current->error_mps)) row.speed_away_water_se_mps = error_along(water, away);
  }
  row.course_away_deg = std::abs(wrap_180(row.course_smoothed_deg - deg_from_rad(std::atan2(school.x, school.y))));
  if (!std::isfinite(row.course_away_deg)) return;
  // A bearing turns by what a place moves across it, over the distance; a course likewise, over the speed as it is told.
  const double square = std::hypot(now.line.slope_x, now.line.slope_y) * row.speed_smoothed_mps;
  const Point<Enu> by_place{-away.y / distance_m, away.x / distance_m, 0.0};
  const Point<Enu> by_velocity{now.line.slope_y / square, -now.line.slope_x / square, 0.0};
  row.course_away_se_deg = deg_from_rad(now.error_of(by_place, by_velocity));
}

/// How sure an approach is: the school's place and velocity err, the ship's are taken for exact.
/// school, relative  as of closest_approach()
void take_approach_errors(const Velocities::Now& now, const ClosestApproach& closest, const Point<Enu>& school,
                          const Point<Enu>& relative, SchoolPingRow& row) {
  const double square = dot(relative, relative);
  row.time_to_cpa_se_s =
      now.error_of(relative * (-1.0 / square), (school + relative * (2.0 * closest.time_s)) * (-1.0 / square));
  const Point<Enu> across = Point<Enu>{relative.y, -relative.x, 0.0} * (1.0 / std::sqrt(square));
  row.cpa_se_m = now.error_of(across, across * closest.time_s);
}

/// now  null = its velocity is unknown, and it is taken for still: against a ship that sails, it nearly is
void take_ship(const Velocities::Now* now, const ShipWay& way, SchoolPingRow& row) {
  const PingNavigation& ship = way.at(row.ping_index);
  row.ship_speed_mps = ship.speed_mps;
  row.relative_bearing_deg = wrap_180(row.bearing_deg - ship.heading_deg);
  if (!ship.has_position() || !std::isfinite(row.latitude) || !std::isfinite(row.longitude)) return;
  row.wake_distance_m = way.wake_distance_m(row.ping_index, {row.latitude, row.longitude});
  const Point<Enu> school = to_enu({row.latitude, row.longitude}, ship.transducer);
  const double distance_m = std::hypot(school.x, school.y);
  const Point<Enu> own = now != nullptr ? Point<Enu>{now->line.slope_x, now->line.slope_y, 0.0} : Point<Enu>{};
  if (now != nullptr && distance_m > 0.0) take_away(*now, school, row);
  if (!std::isfinite(ship.speed_mps) || !std::isfinite(ship.course_deg)) return;
  const Point<Enu> relative = own - velocity(ship.speed_mps, ship.course_deg);
  if (const auto closest = closest_approach(school, relative)) {
    row.time_to_cpa_s = closest->time_s;
    row.cpa_m = closest->distance_m;
    if (now != nullptr) take_approach_errors(*now, *closest, school, relative, row);
  }
}

}  // namespace

std::optional<ClosestApproach> closest_approach(const Point<Enu>& school, const Point<Enu>& relative) {
  const double square = dot(relative, relative);
  if (!(square >= kLeastRelative_mps * kLeastRelative_mps)) return std::nullopt;
  const double time_s = -dot(school, relative) / square;
  const Point<Enu> then = school + relative * time_s;
  return ClosestApproach{time_s, std::hypot(then.x, then.y)};
}

ShipWay::ShipWay(std::span<const PingNavigation> pings) : pings_(pings), places_(pings.size()) {
  bool first = true;
  for (std::size_t i = 0; i < pings.size(); ++i) {
    if (!pings[i].has_position()) continue;
    if (std::exchange(first, false)) origin_ = pings[i].transducer;
    places_[i] = to_enu(pings[i].transducer, origin_);
  }
}

const PingNavigation& ShipWay::at(std::int64_t ping_index) const {
  return pings_[static_cast<std::size_t>(ping_index)];
}

double ShipWay::wake_distance_m(std::int64_t ping_index, const Geographic& place) const {
  const auto now = static_cast<std::size_t>(ping_index);
  if (!pings_[now].has_position()) return kUnknown;
  const Point<Enu> at = to_enu(place, origin_);
  std::size_t later = now;
  double least_m = distance_to(at, places_[now], places_[now]);
  for (std::size_t i = now; i-- > 0 && pings_[now].time - pings_[i].time <= kWakeAge;) {
    if (!pings_[i].has_position()) continue;
    least_m = std::min(least_m, distance_to(at, places_[i], places_[later]));
    later = i;
  }
  return least_m;
}

void add_movement(std::span<SchoolPingRow> rows, const ShipWay& ship, const SummariseParams& params,
                  const WaterCurrents* water) {
  const Velocities velocities(rows, params, water);
  const std::vector<std::size_t>& uncut = velocities.track().rows;
  std::size_t place = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::optional<Velocities::Now> now;
    if (place < uncut.size() && uncut[place] == i) now = velocities.at(place++);
    if (now) take_velocity(*now, rows[i]);
    take_ship(now ? &*now : nullptr, ship, rows[i]);
  }
}

}  // namespace sonar
