// SPDX-License-Identifier: Apache-2.0
#include "view/volume/mask_colours.h"

#include "view/colour_map.h"
#include "view/theme.h"

namespace sonar {
namespace {

constexpr int kFuzzyAlpha = 120;
constexpr Rgba8 kRejected{140, 140, 140, 255};
constexpr Rgba8 kCore{20, 160, 60, 255};
constexpr Rgba8 kFuzzy{250, 210, 30, 190};

}  // namespace

Rgba8 mask_colour(const MaskPalette& palette, int school, std::uint8_t confidence) {
  if (confidence == 0) return {0, 0, 0, 0};
  const double f = confidence / 255.0;
  if (f <= palette.fuzzy_above) return {0, 0, 0, 0};
  const bool core = f >= palette.core_at;
  if (!palette.rejected.empty() && palette.rejected[static_cast<std::size_t>(school) % palette.rejected.size()]) {
    return with_alpha(kRejected, core ? 255 : kFuzzyAlpha);
  }
  switch (palette.colouring) {
    case MaskColouring::core_fuzzy:
      return core ? kCore : kFuzzy;
    case MaskColouring::confidence:
      return colour_map(ColourMapName::viridis).at(f);
    case MaskColouring::schools:
      break;
  }
  return with_alpha(school_colour(school), core ? 255 : kFuzzyAlpha);
}

}  // namespace sonar
