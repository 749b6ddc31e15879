// SPDX-License-Identifier: Apache-2.0
#include "session/maps/dock_theme.h"

#include <algorithm>

namespace sonar {

Theme dock_theme(PixelSize size, bool dark) {
  constexpr double kLeast_px = 10.5;
  constexpr double kMost_px = 13.0;
  constexpr double kTitle = 1.15;
  Theme theme = dark ? dark_theme(size) : light_theme(size);
  theme.text_px = std::clamp(theme.text_px, kLeast_px, kMost_px);
  theme.title_px = kTitle * theme.text_px;
  return theme;
}

}  // namespace sonar
