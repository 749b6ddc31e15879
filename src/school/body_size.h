// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/mask.h"
#include "school/measure.h"

namespace sonar {

/// A school's body with the sonar's blur taken out; NaN = the blur is all that is seen.
struct BodySize {
  double length_m = kUnknown;
  double width_m = kUnknown;
  double height_m = kUnknown;
};

/// Second moments of the echo in and round the mask, less those of beam and pulse, as a uniform ellipsoid's extents.
/// The mask ends where the echo falls below its threshold, and moments cut there would be too small; so the echo is
/// taken from a wider stretch of water, where it dies away by itself.
[[nodiscard]] BodySize body_size(const MeasureInput& ping, const PingMask& mask, const MeasureParams& params);

}  // namespace sonar
