// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "model/mask.h"
#include "model/school.h"
#include "school/measure_input.h"
#include "school/measure_params.h"

namespace sonar {

/// A school's echo along range, all beams together. The sonar sees as sharply nowhere else, so this tells how the
/// density changes from heart to rim; across the beam it is taken to change alike.
struct RangeProfile {
  double kurtosis = kUnknown;  ///< fourth moment over the square of the second, pulse taken out
  double looks = 0.0;          ///< independent ones: members, over the samples of a pulse
};

/// background_factors  [fan] of the background near the school, as a multiple of the expected
/// out                 unknown where pulse is all that is seen
[[nodiscard]] RangeProfile range_profile(const MeasureInput& ping, const PingMask& mask,
                                         std::span<const double> background_factors, const MeasureParams& params);

/// Square of an ellipsoid's half axis over the variance of its echo along it: 5 with an even density, more with a dense
/// heart, less if hollow.
/// kurtosis  of its echo, 15/7 with an even density
/// most_db   heart and rim differ by no more
/// source    density falling off as exp(-c r^2) from the heart to the rim r = 1, c by the kurtosis
[[nodiscard]] double shape_variance(double kurtosis, double most_db);

/// The same from several sights of one school, times params.shape_variance / 5; unknown ones have no say. What few looks
/// tell is drawn to an even density, and so is what a ragged rim may have done.
[[nodiscard]] double shape_variance(std::span<const RangeProfile> sights, const MeasureParams& params);

}  // namespace sonar
