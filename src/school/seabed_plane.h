// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

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

}  // namespace sonar
