// SPDX-License-Identifier: Apache-2.0
#include "geo/frames.h"

#include "geo/refraction.h"

namespace sonar {

Point<Enu> to_enu(const Point<Sonar>& p, double heading_rad) {
  const double c = std::cos(heading_rad);
  const double s = std::sin(heading_rad);
  return {p.x * s + p.y * c, p.x * c - p.y * s, -p.z};
}

Point<Sonar> to_sonar(const Point<Enu>& p, double heading_rad) {
  const double c = std::cos(heading_rad);
  const double s = std::sin(heading_rad);
  return {p.x * s + p.y * c, p.x * c - p.y * s, -p.z};
}

Point<Sonar> level(const Point<Vessel>& p, double roll_rad, double pitch_rad) {
  const double cr = std::cos(roll_rad);
  const double sr = std::sin(roll_rad);
  const double cp = std::cos(pitch_rad);
  const double sp = std::sin(pitch_rad);
  const double y = p.y * cr - p.z * sr;
  const double z = p.y * sr + p.z * cr;
  return {p.x * cp + z * sp, y, -p.x * sp + z * cp};
}

Point<Sonar> levelled_direction(const Point<Sonar>& direction, const Placement& placement) {
  if (placement.roll_rad == 0.0 && placement.pitch_rad == 0.0) return direction;
  return level(Point<Vessel>{direction.x, direction.y, direction.z}, placement.roll_rad, placement.pitch_rad);
}

namespace {

Point<Sonar> turned_back(const Point<Sonar>& p, const Placement& placement) {
  if (placement.roll_rad == 0.0 && placement.pitch_rad == 0.0) return p;
  const double cr = std::cos(placement.roll_rad);
  const double sr = std::sin(placement.roll_rad);
  const double cp = std::cos(placement.pitch_rad);
  const double sp = std::sin(placement.pitch_rad);
  const double z = p.x * sp + p.z * cp;
  return {p.x * cp - p.z * sp, p.y * cr + z * sr, -p.y * sr + z * cr};
}

}  // namespace

Point<Sonar> levelled(const Point<Sonar>& p, const Placement& placement) {
  const Point<Sonar> straight = levelled_direction(p, placement);
  return placement.rays ? placement.rays->bent(straight) : straight;
}

Point<Sonar> unlevelled(const Point<Sonar>& p, const Placement& placement) {
  return turned_back(placement.rays ? placement.rays->straightened(p) : p, placement);
}

double wrap_360(double deg) {
  const double wrapped = deg - 360.0 * std::floor(deg / 360.0);
  return wrapped >= 360.0 ? 0.0 : wrapped;
}

double wrap_180(double deg) { return wrap_360(deg + 180.0) - 180.0; }

}  // namespace sonar
