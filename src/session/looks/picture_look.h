// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "view/image.h"
#include "view/theme.h"

namespace sonar {

/// Where a picture is drawn and what it looks like there: in a view of the window, or as a panel of a page.
struct PictureLook {
  PixelSize size;      ///< pixels
  double scale = 1.0;  ///< pixels a unit: of the window, or 1/96 inch of a page
  bool dark = false;
  std::optional<PanelLook> panel;  ///< empty = in the window
  Units units{};
  friend bool operator==(const PictureLook&, const PictureLook&) = default;
};

}  // namespace sonar
