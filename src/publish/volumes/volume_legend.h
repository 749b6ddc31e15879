// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
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

/// What lies in a volume's picture where the legend and the scale bar may stand.
struct KeptClear {
  std::vector<ConvexOutline> always;  ///< schools and words: nothing stands on these
  ConvexOutline sector;               ///< nothing stands on it where there is room beside it
};
/// free_place() off the schools, and off the sector unless told otherwise.
[[nodiscard]] std::optional<PixelRect> place_off(const KeptClear& kept_clear, bool over_sector, const PixelRect& inside,
                                                 double width, double height, Corner corner);

/// A legend where nothing lies that must be seen.
struct PlacedLegend {
  std::vector<LegendRow> rows;  ///< none where there was no room
  PixelRect place;              ///< what they cover
  bool left_out = false;        ///< there was no room for rows
};
/// In the lower left corner of the volume, else along its edges. Where there is no room the rows of single schools go first,
/// then what words tell after their first part; then it lies over the sector, and at last, where schools lie everywhere, it
/// is left out.
[[nodiscard]] PlacedLegend placed_legend(const VolumeFigure& figure, const PictureOptions& options,
                                         const PixelRect& place, const Theme& theme, const KeptClear& kept_clear);
void add_volume_legend(FrameDescription& frame, const PlacedLegend& legend, const Theme& theme);

}  // namespace sonar
