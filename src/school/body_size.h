// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/mask.h"
#include "school/measure.h"

namespace sonar {

/// A school's body with the sonar's blur taken out.
struct BodySize {
  bool known = false;
  double length_m = 0.0;
  double width_m = 0.0;
  double height_m = 0.0;
  double volume_m3 = 0.0;
};

/// Second moments of the echo in and round the mask, less those of beam and pulse, as a uniform ellipsoid's extents.
/// The mask ends where the echo falls below its threshold, and moments cut there would be too small; so the echo is
/// taken from a wider stretch of water, where it dies away by itself.
[[nodiscard]] BodySize body_size(const MeasureInput& ping, const PingMask& mask, const MeasureParams& params);

}  // namespace sonar
