// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/mask.h"
#include "model/school.h"
#include "school/mask_shape.h"
#include "school/measure/measure_input.h"

namespace sonar {

/// Fills the columns of SchoolDescriptors and those of the box and the centre of mass, but for incidence_deg, which
/// correct_sizes() knows. The row has its other columns already.
/// shape  of the mask, its weight above 0
/// cost   linear in the mask's voxels
void describe_school(const MeasureInput& ping, const PingMask& mask, const MaskShape& shape, SchoolPingRow& row);

/// Relative size of an echo across the beam: its width over that of the beam at the echo's own level. Below 1.5 or so the
/// beam decides what is seen, not the school.
/// extent_deg  of the echo, seen from the transducer
/// width_deg   of the beam, one way, to -3 dB
/// above_db    mean Sv of the echo above its threshold
/// out         unknown where that is not above 0
/// source      Diner 2001, Aquatic Living Resources 14, 211: Nb = L / (2 D tan(B / 2)), B = 0.44 width above_db^0.45
[[nodiscard]] double diner_relative_size(double extent_deg, double width_deg, double above_db);

}  // namespace sonar
