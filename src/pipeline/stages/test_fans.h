// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/array.h"
#include "base/units.h"
#include "geo/sector.h"
#include "model/mask.h"

// Three fans of nine beams, for tests that work out sums over cells by hand.
namespace sonar::test {

inline constexpr Shape3 kFans{3, 9, 60};

/// Fans of 10 degrees, beams of 3 degrees, shells of 0.5 m from 20 m on.
inline Sector fans_sector() {
  const auto radians = [](std::vector<double> degrees) {
    for (double& d : degrees) d = rad_from_deg(d);
    return degrees;
  };
  return Sector(radians({-30.0, -20.0, -10.0}), radians({258, 261, 264, 267, 270, 273, 276, 279, 282}),
                {20.0, 0.5, kFans.samples});
}

/// The same confidence in all voxels.
inline PingMask mask_of(std::vector<Run> runs, std::uint8_t confidence) {
  PingMask mask;
  for (const Run& run : runs)
    mask.confidence.insert(mask.confidence.end(), static_cast<std::size_t>(run.count), confidence);
  mask.runs = std::move(runs);
  return mask;
}

}  // namespace sonar::test
