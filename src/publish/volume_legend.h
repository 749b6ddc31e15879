// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "publish/volume_figure.h"

namespace sonar {

/// What colours, lines and marks of a volume's picture mean.
struct LegendRow {
  enum class Sign : std::uint8_t { area, mark, broken_line, whole_line };
  Sign sign = Sign::area;
  Rgba8 colour;
  std::string words;
};
/// The schools are left out where they are many or have no room: their numbers stand beside them.
/// place  of the volume in the picture
[[nodiscard]] std::vector<LegendRow> volume_legend(const VolumeFigure& figure, const PictureOptions& options,
                                                   const PixelRect& place, const Theme& theme);
/// What the legend covers, in the lower left corner of the volume; without rows nothing.
[[nodiscard]] PixelRect legend_place(const std::vector<LegendRow>& rows, const PixelRect& place, const Theme& theme);
void add_volume_legend(FrameDescription& frame, const std::vector<LegendRow>& rows, const PixelRect& place,
                       const Theme& theme);

}  // namespace sonar
