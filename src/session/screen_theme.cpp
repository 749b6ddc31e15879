// SPDX-License-Identifier: Apache-2.0
#include "session/screen_theme.h"

#include <algorithm>
#include <cmath>

namespace sonar {
namespace {

constexpr double kLeastText_px = 12.0;  ///< 9 pt at 96 dots per inch: below that few read it
constexpr double kTitle = 1.15;         ///< of the text

}  // namespace

Theme scaled(Theme theme, double factor) {
  theme.text_px *= factor;
  theme.title_px *= factor;
  theme.line_px *= factor;
  return theme;
}

Theme screen_theme(PixelSize pixels, double scale, bool dark) {
  const PixelSize units{static_cast<int>(std::lround(pixels.width / scale)),
                        static_cast<int>(std::lround(pixels.height / scale))};
  Theme theme = dark ? dark_theme(units) : light_theme(units);
  theme.text_px = std::max(theme.text_px, kLeastText_px);
  theme.title_px = std::max(theme.title_px, kTitle * theme.text_px);
  return scaled(theme, scale);
}

Theme dock_theme(PixelSize pixels, double scale, bool dark) {
  constexpr double kMost_px = 13.5;
  Theme theme = screen_theme(pixels, scale, dark);
  theme.text_px = std::min(theme.text_px, kMost_px * scale);
  theme.title_px = kTitle * theme.text_px;
  return theme;
}

}  // namespace sonar
