// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace sonar {

/// Places in a plane over time.
struct TimedPlaces {
  std::vector<double> t;  ///< rising
  std::vector<double> x;  ///< [n]
  std::vector<double> y;  ///< [n]
};

/// How places scatter about straight lines: variances, and for how long deviations are alike: masks change slowly, and the
/// centre of one wanders with them.
struct Scatter {
  double tau_s = 0.0;  ///< correlation is exp(-dt / tau); 0 = none
  double variance_xx = 0.0;
  double variance_xy = 0.0;
  double variance_yy = 0.0;
};

/// A least-squares straight line through places in a plane over time, and how uncertain its slope is.
struct LineFit {
  double slope_x = 0.0;
  double slope_y = 0.0;
  double variance_xx = 0.0;  ///< of the slopes
  double variance_xy = 0.0;
  double variance_yy = 0.0;
};

/// The scatter about one line for each of the pieces, of which all have the same.
/// pieces  at least one; each of n >= 3 places, not all at one time
/// The deviations are taken for an autoregressive process of first order, of correlation exp(-dt / tau). Of a few tau from
/// none to 64 intervals the one is taken whose restricted likelihood is largest: residuals of a short track seem less
/// alike than the deviations are, as the line has followed them, and that likelihood knows it.
/// source  Harville 1977, JASA 72, 320 (restricted likelihood)
/// cost    linear in n
[[nodiscard]] Scatter common_scatter(std::span<const TimedPlaces> pieces);

/// places  n >= 2, not all at one time
/// out     the slope's variance is that of the plain least-squares line under such deviations
[[nodiscard]] LineFit fit_line(const TimedPlaces& places, const Scatter& scatter);

/// Covariance of one place's deviation with the slope of the plain line, over the deviations' variance, s^-1: both hang on
/// the same places, and neighbours deviate alike.
/// t      as of fit_line(); place < n
/// source the slope is the sum of (t_i - mean) x_i over that of (t_i - mean)^2
[[nodiscard]] double covariance_with_slope(const std::vector<double>& t, double tau_s, std::size_t place);

/// Of one piece, with the scatter about it; as above.
[[nodiscard]] LineFit fit_line(const std::vector<double>& t, const std::vector<double>& x,
                               const std::vector<double>& y);

}  // namespace sonar
