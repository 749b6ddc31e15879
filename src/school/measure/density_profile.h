// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "geo/frames.h"
#include "school/measure/measure_params.h"

namespace sonar {

/// Moments of an echo over slant range and azimuth, to the fourth: they tell along any level axis how its density changes
/// from core to margin. All fans lie in one plane, so that what the beam blurs upright has no part in them.
struct LevelMoments {
  struct Cumulants {
    double variance = 0.0;  ///< m^2
    double fourth = 0.0;    ///< fourth cumulant, m^4
  };

  /// Echo of one beam. of_range  sums of weight x range^k, k = 0 .. 4
  void add(double azimuth_rad, std::span<const double, 5> of_range);
  /// Along a level axis.
  /// axis_rad  from the bow towards starboard
  /// centre    of the echo
  [[nodiscard]] Cumulants along(double axis_rad, const Point<Sonar>& centre) const;

  std::array<std::array<double, 5>, 5> sums{};  ///< weight x x^i y^j, i + j <= 4
};

/// What one sighting tells of a body along one axis.
struct AxisSighting {
  double variance = 0.0;         ///< of the body, m^2
  double echo_variance = 0.0;    ///< beam's and pulse's blur in it, m^2
  double fourth_cumulant = 0.0;  ///< m^4; cumulants add up: a Gaussian beam has none, a pulse next to none
  double looks = 0.0;            ///< independent ones
};

/// Square of a half axis over the variance of the body's density along it, by the kurtosis of that density.
/// source  the curve through two lumps (1, 1) and an even ellipsoid (15/7, 5); within 8.5 % in length of an even box
///         (9/5, 3), hoops and shells, within 3 % of cores up to 10 dB denser than the margin. Denser ones count as that.
[[nodiscard]] double shape_variance(double kurtosis);

/// The same from several sightings of one school, times params.shape_variance / 5. What few looks tell is drawn to an even
/// density, and so is a body that is small beside the blur: the skirts of a beam, which nobody knows, may look like a dense
/// core or a hollow, by as much as the blur is of the echo.
[[nodiscard]] double shape_variance(std::span<const AxisSighting> sightings, const MeasureParams& params);

}  // namespace sonar
