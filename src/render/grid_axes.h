// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "geo/sector.h"

namespace sonar {

/// Monotone stand-in for an angle, without trigonometry: y / (|x| + |y|) for x >= 0, and 2 - that (or -2 - that for
/// y < 0) behind. -2..2 for a full turn, once differentiable everywhere. Elevations use it with x = rho >= 0, y = -z.
[[nodiscard]] double diamond_angle(double x, double y);

/// Fractional index of an angle by a table over its diamond angle, linear in between:
/// index = value[k] + (u - k) (value[k + 1] - value[k]), u = (diamond - first) * per_unit, clamped to 0..size - 1.
/// It holds atan and the uneven spacing of the beams together; a kink is off by at most 1/2000 of a beam or so.
struct AngleTable {
  double first = 0.0;
  double per_unit = 1.0;
  std::vector<float> value;  ///< [kAngleEntries] index, 0..count - 1
};
inline constexpr int kAngleEntries = 2048;

/// The grid in the fan frame: x along the middle azimuth, z down as ever, y starboard of the middle.
///   x_fan = x cos(middle) + y sin(middle), y_fan = -x sin(middle) + y cos(middle)
/// A place lies in the sector (first to last centre) where, with rho = hypot(x, y) and r = hypot(rho, z):
///   x sin(half_width) - |y| cos(half_width) >= 0,
///   -z cos(e0) - rho sin(e0) >= 0,  rho sin(e1) + z cos(e1) >= 0,
///   first_m <= r <= last_m,  z >= surface.
struct GridAxes {
  int fans = 0;
  int beams = 0;
  int samples = 0;
  double middle_rad = 0.0;
  double half_width_rad = 0.0;  ///< at most pi
  double first_elevation_rad = 0.0;
  double last_elevation_rad = 0.0;
  double first_m = 0.0;  ///< of the axis; may be negative
  double spacing_m = 1.0;
  double nearest_m = 0.0;  ///< max(0, first_m): nothing is drawn nearer
  double farthest_m = 0.0;
  AngleTable beam_of;                 ///< from diamond_angle(x_fan, y_fan)
  AngleTable fan_of;                  ///< from diamond_angle(rho, -z)
  std::vector<float> sin_azimuth;     ///< [beam] in the fan frame: the plane of a beam is sin x - cos y = 0
  std::vector<float> cos_azimuth;     ///< [beam]
  std::vector<float> sin2_elevation;  ///< [fan]: the cone of a fan is z^2 = sin2 r^2
  std::vector<float> beams_per_rad;   ///< [beam - 1] slope of the index, for gradients
  std::vector<float> fans_per_rad;    ///< [fan - 1]
  bool even_beams = false;            ///< even, and within 45 degrees of the fan frame's x axis and of the level: the
                                      ///< angle gives the index, as exactly as the table does
  bool even_fans = false;
  double least_beam_rad = 0.0;  ///< smallest spacing
  double least_fan_rad = 0.0;
};

[[nodiscard]] GridAxes grid_axes(const Sector& sector);

}  // namespace sonar
