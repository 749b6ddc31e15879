// SPDX-License-Identifier: Apache-2.0
#include "session/screen_theme.h"

#include <cmath>

namespace sonar {

Theme scaled(Theme theme, double factor) {
  theme.text_px *= factor;
  theme.title_px *= factor;
  theme.line_px *= factor;
  return theme;
}

Theme screen_theme(PixelSize pixels, double scale, bool dark) {
  const PixelSize units{static_cast<int>(std::lround(pixels.width / scale)),
                        static_cast<int>(std::lround(pixels.height / scale))};
  return scaled(dark ? dark_theme(units) : light_theme(units), scale);
}

}  // namespace sonar
