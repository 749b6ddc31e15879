// SPDX-License-Identifier: Apache-2.0
#include "session/maps/dock_theme.h"

#include <algorithm>

#include "session/screen_theme.h"

namespace sonar {

Theme dock_theme(PixelSize pixels, double scale, bool dark) {
  constexpr double kLeast_px = 10.5;
  constexpr double kMost_px = 13.0;
  constexpr double kTitle = 1.15;
  Theme theme = screen_theme(pixels, scale, dark);
  theme.text_px = std::clamp(theme.text_px, kLeast_px * scale, kMost_px * scale);
  theme.title_px = kTitle * theme.text_px;
  return theme;
}

}  // namespace sonar
