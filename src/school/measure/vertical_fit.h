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

/// What is taken for the beam. Beams of one -3 dB width differ in their skirts: a shaded array's is near a Gaussian, a
/// uniform line's is steeper and has side lobes.
struct BeamModel {
  double gaussian_share = 0.5;  ///< 1 = Gaussian, 0 = a uniform line array, in between a mean of both
  double pedestal = 0.1;  ///< share of the strongest fan, added to echo and model alike: skirts below decide nothing
  double transmit_ratio = 1.0;  ///< width of receiving over that of sending: 1 = alike, 0 = sent everywhere
};

/// Two-way pattern at an angle off the axis, 1 on it; both shapes receive half the power at one-way width / 2.
/// off_axis  angle in units of FanEcho::sigma_rad
[[nodiscard]] double two_way_pattern(const BeamModel& beam, double off_axis);

/// How likely a body's half height is, whatever its centre and strength. Of one body seen several times likelihoods add
/// up, and those under several beam models can be compared.
struct HeightLikelihood {
  std::vector<double>
      at;           ///< [k] log-likelihood of half_height_m(k), less that of a model that fits all; empty = unknown
  int freedom = 0;  ///< fans less what is fitted beside the height

  /// How much worse than chance the best height fits, >= 1: no body is an ellipsoid. Likelihoods are to be divided by it.
  /// source  quasi-likelihood (McCullagh & Nelder 1989, chapter 9)
  [[nodiscard]] double overdispersion() const;
};

/// 0 for k = 0, then in steps that grow by a tenth: fine where a beam can still tell.
[[nodiscard]] double half_height_m(std::size_t k);

/// Of a uniform ellipsoid seen through such beams, from means of exponentially distributed echo. Fans may be missing at
/// either end (surface, border of the sector): what is there is enough.
/// range_m  of the body
/// out      up to the height of all fans; empty with fewer than three, or where the search does not settle
/// source   gamma likelihood of averaged Rayleigh-fading echo
[[nodiscard]] HeightLikelihood height_likelihood(const std::vector<FanEcho>& fans, const BeamModel& beam,
                                                 double range_m);

/// Adds one more sighting of the body. Where the two end at different heights, the sum ends at the lower one.
/// dispersion  what its likelihoods are to be divided by
void add_sighting(HeightLikelihood& sum, const HeightLikelihood& more, double dispersion);

struct LikelyHeight {
  double variance_m2 = 0.0;  ///< of the ellipsoid along the height, beam taken out
  double evidence = 0.0;     ///< log-likelihood above that of a body without height, over the overdispersion
};
/// The peak, between the entries by a parabola; empty for an empty likelihood.
[[nodiscard]] std::optional<LikelyHeight> most_likely_height(const HeightLikelihood& heights);

}  // namespace sonar
