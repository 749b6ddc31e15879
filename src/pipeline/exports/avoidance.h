// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "model/avoidance.h"
#include "model/product.h"

namespace sonar {

/// How schools behave against the ship: speed, direction, depth and density in bins of range (50 m), of bearing from the
/// bow (30 degrees) and of time to the closest approach (30 s). Each school counts once in a bin, with the mean of its
/// pings there: pings of one school tell of one school, and standard errors are those between schools.
/// Left out are rejected schools, and pings in which a school lies within 25 m of where the ship sailed in the last ten
/// minutes and reaches into the upper 25 m: what is seen there may be the ship's own wake.
/// Quartiles are of the schools' means in the bin, of Sv in dB.
/// products  as merged; rows joined by `continues` are one school
/// out       bins with pings, by rising limits; errors unknown where a bin has one school
[[nodiscard]] std::vector<AvoidanceRow> avoidance_table(std::span<const ObservationProduct> products);

}  // namespace sonar
