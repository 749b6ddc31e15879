// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "base/array.h"
#include "geo/frames.h"
#include "model/local_frame.h"
#include "model/product.h"

namespace sonar {

// Files of VTK's XML formats, as ParaView and VisIt open them: places in metres of LocalFrame, numbers as they lie in memory
// (little-endian) behind the XML. What a file is told once: TimeValue, seconds after the observation's first ping.

/// A ping's Sv and masks on the sector's grid, for a .vts.
struct VtkGrid {
  View3<const std::int16_t> sv;        ///< unfiltered Sv counts; no data becomes NaN
  View3<const std::int16_t> filtered;  ///< the same after the median filter
};

/// .vts: a curvilinear grid with a point at the centre of every voxel (sample fastest, then beam, then fan) and the arrays Sv,
/// Sv_filtered (dB re 1 m-1), school_id (0 = none) and confidence (0..1).
/// masks  of that ping, each fitting the grid
[[nodiscard]] std::string vts_bytes(const VtkGrid& grid, std::span<const SchoolMask* const> masks, const Sector& sector,
                                    const LocalFrame::Ping& into, double seconds);

/// .vtu: every voxel of the masks as a cell with eight corners and the arrays school_id and confidence. Neighbours share their
/// corners.
[[nodiscard]] std::string vtu_bytes(std::span<const SchoolMask* const> masks, const Sector& sector,
                                    const LocalFrame::Ping& into, double seconds);

/// One file of a series and when it is.
struct VtkStep {
  double seconds = 0.0;
  std::string file;  ///< name beside the .pvd
};
/// .pvd: the files of a series with their times, so that ParaView plays them.
[[nodiscard]] std::string pvd_bytes(std::span<const VtkStep> steps, const Geographic& origin);

}  // namespace sonar
