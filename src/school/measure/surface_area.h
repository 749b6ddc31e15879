// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "base/array.h"
#include "geo/sector.h"
#include "model/mask.h"

namespace sonar {

/// Area of the surface of a body of cells, m^2. The faces of its cells overstate it, as stairs are longer than a ramp; so
/// each face counts with the cosine of the angle between it and the surface. The surface's normal comes from the faces
/// round about, within one beam, one fan and as many metres along range.
/// runs    sorted, not empty, apart
/// source  Coeurjolly, Flin, Teytaud & Tougne 2003, Multigrid convergence and surface area estimation, LNCS 2616
/// cost    linear in runs and in the body's box
[[nodiscard]] double surface_m2(std::span<const Run> runs, const Sector& sector);

/// Area that a body of cells covers, seen from above, m^2. The beams of all fans have the same azimuths, so it is the
/// union of stretches of horizontal range in each of them.
/// runs  sorted
[[nodiscard]] double area_from_above_m2(std::span<const Run> runs, const Sector& sector);

}  // namespace sonar
