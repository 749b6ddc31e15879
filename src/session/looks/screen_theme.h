// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/looks/picture_look.h"
#include "view/theme.h"

namespace sonar {

/// Of what is shown on a screen, in the window's units: 9 pt at 96 dots per inch, below which few read it. Views that are
/// too flat for their words have fewer of them.
inline constexpr double kLeastText_px = 12.0;

/// Colours and sizes of a picture on the screen: text and lines as large as its extent in the window's units asks for, in
/// its own pixels.
/// scale  pixels a unit of the window
[[nodiscard]] Theme screen_theme(PixelSize pixels, double scale, bool dark);

/// The theme of a picture in a dock: text stays readable however small the dock is.
[[nodiscard]] Theme dock_theme(PixelSize pixels, double scale, bool dark);

/// The same of a picture wherever it is drawn: a panel's is the page's.
[[nodiscard]] Theme screen_theme(PixelSize pixels, const PictureLook& look);
[[nodiscard]] Theme dock_theme(PixelSize pixels, const PictureLook& look);

}  // namespace sonar
