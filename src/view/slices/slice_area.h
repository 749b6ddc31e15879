// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "geo/sector.h"
#include "model/mask.h"
#include "view/image.h"
#include "view/slices/slice.h"

namespace sonar {

/// Whether a place lies within a closed line, by the even-odd rule: what the line encloses twice is outside. The last
/// point is joined to the first.
[[nodiscard]] bool within_outline(std::span<const PixelPoint> outline, PixelPoint at);

/// Slice coordinates of the same places when another direction points up. Slices that have a direction of their own stay.
/// by_rad  added to SliceView::up_rad by those who go from a view to ship-up; less than 0 the other way
[[nodiscard]] PixelPoint turned_up(const Slice& slice, PixelPoint at, double by_rad);

/// The voxels of a slice whose places (SliceMap::place_of) lie within an outline, however large they are drawn.
/// outline   slice coordinates, ship-up
/// all_fans  a slice from above: those of every fan that lie within the outline seen from above
/// out       sorted, not overlapping
/// cost      about 50 ns a voxel of the slice
[[nodiscard]] std::vector<Run> runs_within(const Sector& sector, const Slice& slice,
                                           std::span<const PixelPoint> outline, bool all_fans = false);

}  // namespace sonar
