// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "base/units.h"
#include "geo/frames.h"

namespace sonar {

/// z = offset + slope_x x + slope_y y in the sonar frame, m; z down.
struct SeabedPlane {
  double offset = 0.0;
  double slope_x = 0.0;
  double slope_y = 0.0;
  [[nodiscard]] double z(double x, double y) const { return offset + slope_x * x + slope_y * y; }
  [[nodiscard]] double slope() const { return std::hypot(slope_x, slope_y); }
  /// Range where a direction meets it; infinite where it never does.
  [[nodiscard]] double range(const Point<Sonar>& u) const {
    const double approach = u.z - slope_x * u.x - slope_y * u.y;
    return approach > 1e-6 && offset > 0.0 ? offset / approach : std::numeric_limits<double>::infinity();
  }
  /// How the echo's peak changes over the plane, dB: Lambert's law, and the patch that a beam lights up against the
  /// volume that it fills (flat beams light up longer patches in larger volumes).
  /// source  Sv of a surface: S_b x patch / volume
  [[nodiscard]] double lambert_db(const Point<Sonar>& u, double range_m) const {
    const double sine = (u.z - slope_x * u.x - slope_y * u.y) / std::hypot(1.0, slope());
    if (!(sine > 0.0)) return -std::numeric_limits<double>::infinity();
    const double cosine = std::sqrt(std::max(1.0 - sine * sine, 0.01));
    return db_from_linear(sine * sine / (range_m * cosine));
  }
};

/// The plane through three places; none where the triangle between them, seen from above, is smaller than half of an area.
[[nodiscard]] inline std::optional<SeabedPlane> plane_through(const std::array<Point<Sonar>, 3>& p, double least_m2) {
  const double x1 = p[1].x - p[0].x;
  const double y1 = p[1].y - p[0].y;
  const double x2 = p[2].x - p[0].x;
  const double y2 = p[2].y - p[0].y;
  const double area = x1 * y2 - x2 * y1;
  if (std::abs(area) < least_m2) return std::nullopt;
  SeabedPlane plane;
  plane.slope_x = ((p[1].z - p[0].z) * y2 - (p[2].z - p[0].z) * y1) / area;
  plane.slope_y = (x1 * (p[2].z - p[0].z) - x2 * (p[1].z - p[0].z)) / area;
  plane.offset = p[0].z - plane.slope_x * p[0].x - plane.slope_y * p[0].y;
  return plane;
}

}  // namespace sonar
