// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <memory>

namespace sonar {

/// Frames are types: a point in one cannot be passed where another is meant. Metres.
struct Vessel;  ///< x bow, y starboard, z down; fixed to the hull
struct Sonar;   ///< vessel axes with roll and pitch removed, origin at the transducer: x bow, y starboard, z down
struct Enu;     ///< x east, y north, z up; origin at a ping's transducer, or at a stated place

template <class Frame>
struct Point {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  friend Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Point operator*(const Point& a, double k) { return {a.x * k, a.y * k, a.z * k}; }
  friend bool operator==(const Point&, const Point&) = default;
};

template <class Frame>
[[nodiscard]] double norm(const Point<Frame>& p) {
  return std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
}

class Refraction;

/// WGS 84, degrees; longitude in [-180, 180).
struct Geographic {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  friend bool operator==(const Geographic&, const Geographic&) = default;
};

/// Where a ping was made: the transducer, not the antenna.
struct Placement {
  Geographic transducer;
  double heading_rad = 0.0;         ///< clockwise from true north
  double transducer_depth_m = 0.0;  ///< below the mean water line, heave included where it applies
  double roll_rad = 0.0;            ///< of beams that are fixed to the hull, positive port up; 0 = stabilised beams
  double pitch_rad = 0.0;           ///< the same, positive bow up
  std::shared_ptr<const Refraction> rays{};  ///< along which sound travels; null = straight paths
};

/// Turns by heading only (roll and pitch are already out of the sonar frame).
[[nodiscard]] Point<Enu> to_enu(const Point<Sonar>& p, double heading_rad);
[[nodiscard]] Point<Sonar> to_sonar(const Point<Enu>& p, double heading_rad);

/// Full attitude: roll positive port up (starboard down), pitch positive bow up; radians.
[[nodiscard]] Point<Sonar> level(const Point<Vessel>& p, double roll_rad, double pitch_rad);

/// Where a place in the sector lies once the beams are turned by the placement's roll and pitch (stabilised beams stay) and
/// bent along its rays: the one place where refraction enters.
[[nodiscard]] Point<Sonar> levelled(const Point<Sonar>& p, const Placement& placement);
/// Where a direction in the sector points then: turned, and not bent, as a ray begins along it.
[[nodiscard]] Point<Sonar> levelled_direction(const Point<Sonar>& direction, const Placement& placement);
/// The other way of levelled().
[[nodiscard]] Point<Sonar> unlevelled(const Point<Sonar>& p, const Placement& placement);

/// Wraps to [0, 360).
[[nodiscard]] double wrap_360(double deg);
/// Wraps to [-180, 180).
[[nodiscard]] double wrap_180(double deg);

}  // namespace sonar
