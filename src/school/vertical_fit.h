// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

namespace sonar {

/// Mean echo of one fan over a school's stretch of beams and ranges.
struct FanEcho {
  double elevation_rad = 0.0;
  double sigma_rad = 0.0;   ///< of a two-way Gaussian beam of this fan's -3 dB width
  double echo = 0.0;        ///< mean sv, background included, m^-1; > 0
  double background = 0.0;  ///< mean sv of the background
  double looks = 0.0;       ///< how many samples it is the mean of
};

/// What is taken for the beam. Beams of one -3 dB width differ in their flanks: a shaded array's is near a Gaussian, a
/// uniform line's is steeper and has side lobes.
struct BeamModel {
  double gaussian_share = 0.5;  ///< 1 = Gaussian, 0 = a uniform line array, in between a mean of both
  double pedestal = 0.1;  ///< share of the strongest fan, added to echo and model alike: flanks below decide nothing
};

struct VerticalFit {
  double centre_rad = 0.0;
  double body_variance_rad2 = 0.0;  ///< of the body alone, beam taken out; >= 0
  double evidence = 0.0;            ///< log-likelihood above that of a body without height
};

/// Two-way pattern at an angle off the axis, 1 on it; both shapes are half power at one-way width / 2.
/// off_axis  angle in units of FanEcho::sigma_rad
[[nodiscard]] double two_way_pattern(const BeamModel& beam, double off_axis);

/// Most likely height of a uniform ellipsoid seen through such beams, from means of exponentially distributed echo.
/// Fans may be missing at either end (surface, border of the sector): what is there is enough.
/// out     empty with fewer than three fans, or where the search does not settle
/// source  gamma likelihood of averaged Rayleigh-fading echo
[[nodiscard]] std::optional<VerticalFit> fit_vertical(const std::vector<FanEcho>& fans, const BeamModel& beam);

}  // namespace sonar
