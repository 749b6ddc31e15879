// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "model/depth_grid.h"
#include "view/colour_map.h"
#include "view/maps/contours.h"
#include "view/maps/map_frame.h"
#include "view/theme.h"

namespace sonar {

/// The seabed of a map: bands of depth, muted so that what lies over them is clear.
struct DepthBands {
  std::vector<double> levels_m;  ///< rising, round; the isobaths. Bands lie between neighbours
  ColourMap map;                 ///< stepped, one colour a band; pale = shallow
  bool land = false;             ///< some of what is seen lies above the sea
  bool unknown = false;          ///< some of what is seen is not covered

  [[nodiscard]] Rgba8 colour(double depth_m) const;
};

/// Depths at the middle of every pixel of a map.
[[nodiscard]] ScalarField depth_field(const MapFrame& map, const DepthGrid& grid);
/// Levels that suit what is seen. No known depth: no levels.
[[nodiscard]] DepthBands depth_bands(const ScalarField& field, const Theme& theme);

/// Coloured bands, isobaths and their labels, cut to the map; unknown stays as it was. Isobaths
/// end where the grid's known nodes do.
/// taken  where the isobaths' labels keep off
DepthBands add_depth_layer(FrameDescription& frame, const MapFrame& map, const DepthGrid& grid, const Theme& theme,
                           std::vector<PixelPoint> taken = {});
/// Depths at every `step`-th pixel, only where the four nodes about it are known: nothing is continued.
[[nodiscard]] ScalarField contour_field(const MapFrame& map, const DepthGrid& grid, int step);

}  // namespace sonar
