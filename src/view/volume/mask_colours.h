// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "base/describe.h"
#include "view/image.h"

namespace sonar {

/// How the voxels of masks are coloured from above and from the side.
enum class MaskColouring : std::uint8_t {
  schools,     ///< each school its own colour, the core opaque, the fuzzy area translucent
  core_fuzzy,  ///< core green, fuzzy area yellow, as Balabanian et al. 2007
  confidence,  ///< viridis
};
inline constexpr std::array<std::string_view, 3> kMaskColouringNames{"schools", "core-fuzzy", "confidence"};

struct MaskPalette {
  MaskColouring colouring = MaskColouring::schools;
  double core_at = 0.64;            ///< confidence from which a voxel is core
  double fuzzy_above = 0.0;         ///< what lies at or below it is not shown
  std::vector<bool> rejected = {};  ///< [number of a school's colour, modulo its length]: drawn grey
  friend bool operator==(const MaskPalette&, const MaskPalette&) = default;
};

template <class Visitor>
void describe(Visitor& v, MaskPalette& p) {
  v.choice("colouring", p.colouring, kMaskColouringNames, "how the voxels of masks are coloured");
  v.field("core_at", p.core_at, {.unit = "1", .min = 0, .max = 1, .text = "confidence from which a voxel is core"});
}

/// school      number of the school's colour; confidence 1..255, 0 = clear
[[nodiscard]] Rgba8 mask_colour(const MaskPalette& palette, int school, std::uint8_t confidence);

}  // namespace sonar
