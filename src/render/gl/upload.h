// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "render/gl/gl_object.h"
#include "view/image.h"

namespace sonar {

// Textures from memory. Neither set nor needs any state but what plain_copies() sets; each leaves its target unbound.

enum class Texels : std::uint8_t { r32f, rg32f, rgba32f, rg8ui, r16i };

/// Nearest texel, no mipmaps. `data` may be null: texels without values.
[[nodiscard]] Texture texture_2d(std::string_view label, PixelSize size, Texels texels, const void* data);
/// Colour and depth targets of pictures.
[[nodiscard]] Texture colour_target(PixelSize size);
[[nodiscard]] Texture stencil_target(PixelSize size);

/// How samples lie in a 3-D texture; channels 1, 2 or 4 (3 are stored as 4).
enum class Voxels : std::uint8_t { float32, snorm16, unorm8, uint16 };
/// Interpolated where the type allows it (not uint16). data holds size[0] x size[1] x size[2] x channels values.
[[nodiscard]] Texture texture_3d(std::string_view label, std::array<int, 3> size, Voxels voxels, int channels,
                                 const void* data);

}  // namespace sonar
