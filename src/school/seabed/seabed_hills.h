// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "school/seabed/seabed_echoes.h"
#include "school/seabed/seabed_plane.h"

namespace sonar {

/// Brings the seabed nearer in the beams that hit a hill before the plane: there the beam ends.
///
/// Going up from fan to fan the beams of one azimuth hit the seabed farther and farther away, whatever its shape. An
/// echo that lies before the plane goes with the seabed where no lower beam of its azimuth has seen the seabed beyond
/// it, and where the plane is not seen behind it either. Under a school that hangs in the water there is a beam that
/// sees the seabed farther away, or the beam through it sees the seabed behind.
/// echoes        of all beams, cut ones too, by row
/// strength_db   what to add to the plane's lambert_db()
/// first_sample  [row] first sample of the plane's seabed, its beam-edge echo included or not; only ever becomes less
void find_hills(const SeabedWater& water, const std::vector<SeabedEcho>& echoes, const SeabedPlane& plane,
                double strength_db, const std::vector<double>& vertical_width_deg,
                std::vector<std::int32_t>& first_sample);

}  // namespace sonar
