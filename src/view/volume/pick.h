// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "view/volume/volume_scene.h"

namespace sonar {

/// The voxel of a ping that a place of a picture shows.
struct Picked {
  int fan = 0;
  int beam = 0;
  int sample = 0;
  Point<Sonar> position;    ///< on the ray, not the voxel's centre
  double distance_m = 0.0;  ///< from the eye
  double sv_db = 0.0;       ///< the voxel's own value
  int mask = -1;            ///< index of the mask whose surface was met; -1 = the data
};

/// First thing that the ray through a pixel meets, on plain data (no picture is needed).
///   first_hit   the first place at first_hit_db or above
///   maximum     the place of the largest Sv
///   accumulate  the first place by which half of the ray's opacity has gathered: what one sees there, not the thin
///               haze before it
///   volume_and_surface  the same; a surface is opaque
/// A mask's fuzzy surface before that place is met first (and alone where the data is not shown).
/// A mask's surface gives a member of the mask, however the place lies between members and others.
/// Where the voxel at the place has no data, the nearest of the interpolation's corners that has some is given.
/// cost   one ray, two samples a range sample: below a millisecond
/// result empty where nothing visible is met
[[nodiscard]] std::optional<Picked> pick(const VolumeData& volume, const OpticalTable& table,
                                         std::span<const MaskLayer> masks, const VolumeView& view, PixelPoint pixel);

}  // namespace sonar
