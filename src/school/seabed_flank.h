// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "school/seabed_echoes.h"
#include "school/seabed_plane.h"

namespace sonar {

/// Where the beams meet the seabed.
struct Ground {
  SeabedPlane plane;
  double roughness_m = 0.0;           ///< spread of the ground about the plane
  std::vector<std::int32_t> loudest;  ///< [row] sample at which the plane is loudest; -1 = no plane there
  std::vector<std::int32_t> first;    ///< [row] sample from which the beam's axis is within the seabed's margin
};

/// Gives back to the water what stands out of the seabed's flank. The lower flank of a wide beam hears the seabed long
/// before the beam's axis meets it, about as loud in all beams of a fan, each seen from where it meets the plane; a school
/// in that water fills some of them. What stands no higher above the plane than the ground itself does may be a hill.
/// seabed  with first_sample; open is set
/// cost    the flanks' samples, every fourth of which is sorted over a fan's beams
void open_flank(const SeabedWater& water, const Ground& ground, Seabed& seabed);

}  // namespace sonar
