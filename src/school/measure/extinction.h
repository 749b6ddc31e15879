// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/array.h"
#include "model/extinction_params.h"
#include "model/mask.h"
#include "model/school.h"
#include "school/measure/measure_input.h"

namespace sonar {

// Fish take sound out of a beam, so that what lies behind them, and their own far side, is heard too weakly:
//   sv observed(r) = sv(r) exp(-2 k S(r)), S(r) = integral of sv to r, k = 4 pi sigma_e / sigma, sigma = 4 pi sigma_bs
// (single scattering; Foote 1990, J. Acoust. Soc. Am. 88:1543; Zhao & Ona 2003, ICES J. Mar. Sci. 60:155). With A(r) the
// integral of what is observed, exp(2 k S) = 1 / (1 - 2 k A): no steps from the ship outwards that could build up errors.

/// What a beam's samples were before extinction, as a factor of what is heard of them.
struct BeamGain {
  std::vector<double> within;  ///< [sample] of its mean sv, >= 1
  std::vector<double> behind;  ///< [sample] at its far border: 10 log10 of it is the two-way loss up to there
  bool capped = false;         ///< no echo can be told where nothing more comes back: the factor stays at the cap
};
/// observed  [sample] mean sv of fish, m^-1, 0 where there are none
/// ratio     sigma_e / sigma
/// most_db   two-way loss above which none is told
[[nodiscard]] BeamGain beam_gain(std::span<const double> observed, double spacing_m, double ratio, double most_db);

/// The beams of a ping under one ratio. Fish are the members of its schools; beams without one are empty and lose nothing.
using PingGain = std::vector<BeamGain>;  ///< [row]
[[nodiscard]] PingGain ping_gain(const MeasureInput& ping, std::span<const PingMask* const> masks, double ratio,
                                 double most_db);

/// A ping's Sv as it would be without extinction: background + gain x (sv - background).
/// sv       counts, filtered or not
/// of_mean  what they are of the mean: 1, and ln 2 of filtered ones, which are medians of Rayleigh fading
[[nodiscard]] Array3<std::int16_t> without_extinction(View3<const std::int16_t> sv, const Background& background,
                                                      const PingGain& gain, double of_mean);

/// What extinction does to the schools of a ping, at the ratio and at both ends of its interval.
class PingShadow {
 public:
  /// masks  of the ping's schools that take sound out, and of those that are told; borrowed with the ping
  PingShadow(const MeasureInput& ping, std::span<const PingMask* const> masks, const ExtinctionParams& params);

  /// Fills the columns of extinction of a school.
  void tell(const PingMask& mask, SchoolPingRow& row) const;
  [[nodiscard]] const PingGain& gain() const { return gain_; }

 private:
  [[nodiscard]] double lost_share(const PingMask& mask, const PingGain& gain) const;
  const MeasureInput ping_;
  PingGain gain_;
  PingGain low_;
  PingGain high_;
  bool corrected_;
};

}  // namespace sonar
