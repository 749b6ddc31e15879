// SPDX-License-Identifier: Apache-2.0
#include "session/looks/screen_theme.h"

#include <algorithm>
#include <cmath>

namespace sonar {
namespace {

/// With sizes of text and lines times a factor.
Theme scaled(Theme theme, double factor) {
  theme.text_px *= factor;
  theme.title_px *= factor;
  theme.line_px *= factor;
  theme.least_text_px *= static_cast<float>(factor);
  return theme;
}

Theme read_in(Theme theme, const PictureLook& look) {
  theme.units = look.units;
  return theme;
}

}  // namespace

Theme screen_theme(PixelSize pixels, double scale, bool dark) {
  const PixelSize units{static_cast<int>(std::lround(pixels.width / scale)),
                        static_cast<int>(std::lround(pixels.height / scale))};
  return scaled(with_text(dark ? dark_theme(units) : light_theme(units), kLeastText_px), scale);
}

Theme dock_theme(PixelSize pixels, double scale, bool dark) {
  constexpr double kMost_px = 13.5;
  constexpr double kTitle = 1.15;
  Theme theme = screen_theme(pixels, scale, dark);
  theme.text_px = std::min(theme.text_px, kMost_px * scale);
  theme.title_px = kTitle * theme.text_px;
  return theme;
}

Theme screen_theme(PixelSize pixels, const PictureLook& look) {
  return read_in(look.panel ? panel_theme(*look.panel, look.dark) : screen_theme(pixels, look.scale, look.dark), look);
}

Theme dock_theme(PixelSize pixels, const PictureLook& look) {
  return read_in(look.panel ? panel_theme(*look.panel, look.dark) : dock_theme(pixels, look.scale, look.dark), look);
}

}  // namespace sonar
