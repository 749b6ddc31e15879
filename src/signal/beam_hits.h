// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "signal/level_misfit.h"

namespace sonar {

/// How well a sphere was heard by each beam.
struct BeamHits {
  std::vector<int> count;     ///< [beam] levels inside the -6 dB contour that take part
  std::vector<bool> crossed;  ///< [beam] they lie on all sides of its centre
};

/// beams       [beam] as fitted so far
/// misfits     [heard] those of weight 0 take no part
/// directions  [ping] of the sphere
[[nodiscard]] BeamHits hits_of(std::span<const FittedBeam> beams, std::span<const HeardLevel> heard,
                               std::span<const Misfit> misfits, std::span<const FaceDirection> directions);

}  // namespace sonar
