// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "base/array.h"
#include "base/sample_flags.h"
#include "geo/frames.h"
#include "geo/sector.h"
#include "model/beam_grid.h"
#include "model/extinction_params.h"
#include "model/mask.h"
#include "school/detect/noise_level.h"
#include "school/integrate/cells.h"
#include "school/seabed/seabed.h"

namespace sonar {

/// What one ping offers for echo integration; borrowed.
struct IntegrationInput {
  View3<const std::int16_t> sv;    ///< unfiltered Sv counts
  View3<const SampleFlags> flags;  ///< seabed included
  View3<const std::int16_t>
      filtered;  ///< median-filtered Sv counts: stand in for faulty members where they take sound out
  const Sector* sector = nullptr;
  const BeamGrid* grid = nullptr;
  Background background;
  Placement placement;
  double pulse_m = 0.0;                      ///< extent of the pulse along range, c tau / 2
  const Seabed* seabed = nullptr;            ///< null = none seen
  std::span<const PingMask* const> schools;  ///< no voxel in two
  ExtinctionParams extinction = {};          ///< whether, and how, what schools took out of the beams is given back
};

/// Sums of a ping over range bins and depth channels: linear, weighted by voxel volume, background taken off and negative
/// remainders kept. Beyond where a beam hears the seabed by its edge only members of schools count. A voxel belongs to the
/// range bin of its centre, and to depth channels by its vertical extent. Where extinction is corrected, echo within and
/// behind schools is that times the gain of school/measure/extinction.h, and so are its errors and the background beside it.
/// threads  pure; sums in the order of rows and samples
/// cost     linear in voxels; ten times as much of it where the beams are not stabilised
[[nodiscard]] PingCells integrate_ping(const IntegrationInput& ping, const CellLayout& layout);

}  // namespace sonar
