// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "base/array.h"
#include "base/sample_flags.h"
#include "model/mask.h"
#include "school/runs.h"

namespace sonar {

// What a human does to a mask by hand. Voxels that come in have confidence 1 (255), those that stay keep theirs;
// kNeverMember voxels and those that no beam of the fan recorded never come in. All functions are pure.

/// A mask from runs in any order that may overlap.
/// flags   [fan][beam][sample]; every run lies inside
[[nodiscard]] PingMask brushed(std::vector<Run> runs, View3<const SampleFlags> flags);

/// The mask and everything it encloses: voxels from which no path over faces leads out of it. What lies outside the grid
/// counts as out, so that nothing at a border is enclosed by it.
[[nodiscard]] PingMask fill_holes(const PingMask& mask, View3<const SampleFlags> flags);

/// A voxel is kept, or comes in, where more than half of the 3 x 3 x 3 voxels round it (itself included, those outside
/// the grid left out) are in the mask.
[[nodiscard]] PingMask smoothed(const PingMask& mask, View3<const SampleFlags> flags);

/// The pieces that hang together, in order of their first voxel.
[[nodiscard]] std::vector<PingMask> parts(const PingMask& mask, const Shape3& shape, Connectivity connectivity);

/// The piece with most voxels; of equal ones the first. Empty for an empty mask.
[[nodiscard]] PingMask largest_part(const PingMask& mask, const Shape3& shape, Connectivity connectivity);

/// Whether a voxel is in a mask.
[[nodiscard]] bool contains(const PingMask& mask, int row, int sample);

}  // namespace sonar
