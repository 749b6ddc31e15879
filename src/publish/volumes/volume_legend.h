// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "publish/volumes/volume_figure.h"
#include "view/free_place.h"

namespace sonar {

/// What colours, lines and marks of a volume's picture mean.
struct LegendRow {
  enum class Sign : std::uint8_t { area, mark, broken_line, whole_line };
  Sign sign = Sign::area;
  Rgba8 colour;
  std::string words;
  bool one_school = false;  ///< its number in the picture says the same
};
/// The schools are left out where they are many or have no room: their numbers stand beside them.
/// place  of the volume in the picture; words that are wider are shortened, see elided_line(), or their row is left out
[[nodiscard]] std::vector<LegendRow> volume_legend(const VolumeFigure& figure, const PictureOptions& options,
                                                   const PixelRect& place, const Theme& theme);

/// A legend where nothing lies that must be seen.
struct PlacedLegend {
  std::vector<LegendRow> rows;  ///< none where there was no room
  PixelRect place;              ///< what they cover
  bool left_out = false;        ///< there was no room for rows
};
/// In the lower left corner of the volume, else along its edges; without the schools where there is room for no more.
/// kept_clear  what it does not lie on
[[nodiscard]] PlacedLegend placed_legend(const VolumeFigure& figure, const PictureOptions& options,
                                         const PixelRect& place, const Theme& theme,
                                         std::span<const ConvexOutline> kept_clear);
void add_volume_legend(FrameDescription& frame, const PlacedLegend& legend, const Theme& theme);

}  // namespace sonar
