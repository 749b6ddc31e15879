// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/array.h"
#include "base/result.h"
#include "view/slices/slice_picture.h"

namespace sonar {

/// `weight_of_b` of 255.
[[nodiscard]] inline std::uint8_t mixed(std::uint8_t a, std::uint8_t b, int weight_of_b) {
  return static_cast<std::uint8_t>((a * (255 - weight_of_b) + b * weight_of_b + 127) / 255);
}
[[nodiscard]] inline Rgba8 mixed(Rgba8 a, Rgba8 b, int weight_of_b) {
  return {mixed(a.r, b.r, weight_of_b), mixed(a.g, b.g, weight_of_b), mixed(a.b, b.b, weight_of_b), 255};
}

/// Blends the masks of a ping over the image of its slice.
/// errors  mismatch: a mask that does not belong on the map's sector; nothing is blended then
[[nodiscard]] Result<void> blend_masks(Image& image, const SliceMap& map, const std::vector<MaskLayer>& masks,
                                       const SliceMaskStyle& style, const Theme& theme);

}  // namespace sonar
