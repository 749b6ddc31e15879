// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "base/array.h"
#include "base/sample_flags.h"
#include "geo/sector.h"
#include "model/mask.h"

namespace sonar {

/// Water that members enclose on all sides. Near field, surface, seabed and what lies beyond the sector open it.
struct EnclosedWater {
  std::vector<Run> runs;     ///< sorted
  double volume_m3 = 0.0;    ///< of all that is enclosed
  int vacuoles = 0;          ///< pieces as long as the pulse or longer: shorter ones the sonar cannot see
  double vacuoles_m3 = 0.0;  ///< their volume
};
/// pulse_m  extent of the pulse along range
/// cost     linear in the mask's runs and in the rows of its box
[[nodiscard]] EnclosedWater enclosed_water(const PingMask& mask, View3<const SampleFlags> flags, const Sector& sector,
                                           double pulse_m);

/// A body of cells without its outermost beams and fans, and without so many samples at either end of each run: what no
/// echo from outside is mixed into.
/// runs  sorted, apart
/// out   sorted, apart; empty where the body is no thicker than that
[[nodiscard]] std::vector<Run> core_runs(const std::vector<Run>& runs, const Shape3& shape, int samples);

}  // namespace sonar
