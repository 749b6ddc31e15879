// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace sonar {

/// A least-squares straight line through places in a plane over time, and how uncertain its slope is where neighbouring
/// deviations from it are alike: masks change slowly, and the centre of one wanders with them.
struct LineFit {
  double slope_x = 0.0;
  double slope_y = 0.0;
  double variance_xx = 0.0;  ///< of the slopes
  double variance_xy = 0.0;
  double variance_yy = 0.0;
};

/// t     rising, n >= 3; not all alike
/// x, y  [n]
/// The deviations are taken for an autoregressive process of first order, of correlation exp(-dt / tau). Of a few tau from
/// none to 64 intervals the one is taken whose restricted likelihood is largest: residuals of a short track seem less
/// alike than the deviations are, as the line has followed them, and that likelihood knows it.
/// source  Harville 1977, JASA 72, 320 (restricted likelihood); the slope's variance is that of the plain least-squares
///         line under such deviations
/// cost    linear in n
[[nodiscard]] LineFit fit_line(const std::vector<double>& t, const std::vector<double>& x,
                               const std::vector<double>& y);

}  // namespace sonar
