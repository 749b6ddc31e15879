// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

#include "view/colour_map.h"
#include "view/theme.h"

namespace sonar::contrast_example {

/// Relative luminance 0..1 of an sRGB colour (WCAG 2.1).
inline double luminance(Rgba8 c) {
  const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  return 0.2126 * linear(c.r / 255.0) + 0.7152 * linear(c.g / 255.0) + 0.0722 * linear(c.b / 255.0);
}

/// Contrast of two colours, 1..21 (WCAG 2.1).
inline double contrast(Rgba8 a, Rgba8 b) {
  const auto [low, high] = std::minmax({luminance(a), luminance(b)});
  return (high + 0.05) / (low + 0.05);
}

struct DataColour {
  std::string_view map;
  Rgba8 colour;
};

/// 17 colours of every colour map.
inline std::vector<DataColour> data_colours() {
  std::vector<DataColour> out;
  for (int map = 0; map < kColourMaps; ++map) {
    for (int i = 0; i <= 16; ++i) {
      out.push_back({colour_map_names()[static_cast<std::size_t>(map)],
                     colour_map(static_cast<ColourMapName>(map)).at(i / 16.0)});
    }
  }
  return out;
}

inline std::array<Theme, 2> both_themes(PixelSize size) { return {light_theme(size), dark_theme(size)}; }

}  // namespace sonar::contrast_example
