// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "view/theme.h"

namespace sonar {

/// The theme of a picture in a dock: text stays readable however small the dock is.
[[nodiscard]] Theme dock_theme(PixelSize pixels, double scale, bool dark);

}  // namespace sonar
