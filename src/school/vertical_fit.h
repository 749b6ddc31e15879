// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

namespace sonar {

/// Mean echo of one fan over a school's stretch of beams and ranges.
struct FanEcho {
  double elevation_rad = 0.0;
  double sigma_rad = 0.0;   ///< of the two-way beam
  double echo = 0.0;        ///< mean sv, background included, m^-1; > 0
  double background = 0.0;  ///< mean sv of the background
  double looks = 0.0;       ///< how many samples it is the mean of
};

struct VerticalFit {
  double centre_rad = 0.0;
  double body_variance_rad2 = 0.0;  ///< of the body alone, beam taken out; >= 0
};

/// Most likely height of a uniform ellipsoid seen through Gaussian beams, from means of exponentially distributed echo.
/// Fans may be missing at either end (surface, border of the sector): what is there is enough.
/// pedestal  share of the strongest fan below which a beam is no Gaussian any more: added to echo and model alike, it
///           keeps the far flanks from deciding
/// out     empty with fewer than three fans, or where the search does not settle
/// source  gamma likelihood of averaged Rayleigh-fading echo
[[nodiscard]] std::optional<VerticalFit> fit_vertical(const std::vector<FanEcho>& fans, double pedestal);

}  // namespace sonar
