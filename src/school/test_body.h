// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geo/sector.h"
#include "model/mask.h"

namespace sonar::test {

/// The cells whose centres lie in a body: what a sonar without beam width would mark.
/// inside  of a place in the sonar frame
template <class Inside>
PingMask body_mask(const Sector& sector, Inside inside) {
  PingMask mask;
  for (int row = 0; row < sector.fans() * sector.beams(); ++row) {
    const Point<Sonar> along =
        Sector::direction(sector.elevation_rad(row / sector.beams()), sector.azimuth_rad(row % sector.beams()));
    for (int s = 0; s < sector.range().count; ++s) {
      if (!inside(along * sector.range().range_m(s))) continue;
      if (mask.runs.empty() || mask.runs.back().row != row || mask.runs.back().end() != s) {
        mask.runs.push_back({row, s, 0});
      }
      ++mask.runs.back().count;
      mask.confidence.push_back(255);
    }
  }
  return mask;
}

}  // namespace sonar::test
