// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace sonar {

/// How QGIS draws a layer of the survey map when it is opened: a style of its own kind (QML). Tracks and outlines are lines,
/// schools have the colour of their mean Sv (grey where it is unknown), areas are tints through which the others are seen.
/// Empty for other layers.
[[nodiscard]] std::string layer_style_qml(std::string_view layer);

}  // namespace sonar
