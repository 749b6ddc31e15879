// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "render/gl/fold_plan.h"
#include "render/grid_axes.h"
#include "render/ray_rules.h"
#include "render/transfer_table.h"
#include "view/volume/volume_scene.h"

namespace sonar {

using Vec4 = std::array<float, 4>;
using IVec4 = std::array<std::int32_t, 4>;

/// The uniform block of shaders/block.glsl (std140), line by line; what the lines mean stands there.
struct RayBlock {
  Vec4 right, up, forward, eye, light, lighting;
  Vec4 sides, cones, angle, range, table, texel, stride, stack, mask, ground, frame;
  std::array<Vec4, kSkyRays> sky;
  IVec4 picture, cells, pieces, size;
};
static_assert(sizeof(RayBlock) == 29 * 16);

/// Units of the textures; the one list that shaders and passes share.
struct TextureSlot {
  const char* sampler;
  int unit;
};
inline constexpr int kSvUnit = 0, kKnownUnit = 1, kAngleUnit = 2, kFacesUnit = 3, kOpticsUnit = 4, kStateUnit = 5,
                     kMeansUnit = 6, kLargestUnit = 7, kMaskUnit = 8, kMaskColoursUnit = 9, kOpaqueUnit = 10,
                     kUnits = 11;
inline constexpr std::array<TextureSlot, kUnits> kTextureSlots = {{{"sv_texture", kSvUnit},
                                                                   {"known_texture", kKnownUnit},
                                                                   {"angle_texture", kAngleUnit},
                                                                   {"faces_texture", kFacesUnit},
                                                                   {"optics_texture", kOpticsUnit},
                                                                   {"state_texture", kStateUnit},
                                                                   {"means_texture", kMeansUnit},
                                                                   {"largest_texture", kLargestUnit},
                                                                   {"mask_texture", kMaskUnit},
                                                                   {"mask_colours", kMaskColoursUnit},
                                                                   {"opaque_texture", kOpaqueUnit}}};

/// What a block is filled from.
struct RayBlockSource {
  const VolumeView& view;
  const DrawQuality& quality;
  const GridAxes& axes;
  const TransferTable& table;
  const FoldPlan& plan;
  double surface_z_m;
  double counts_per_unit;  ///< of the volume's texture
  std::array<int, 3> cells;
};
[[nodiscard]] RayBlock ray_block(const RayBlockSource& source);

}  // namespace sonar
