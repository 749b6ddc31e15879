// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "view/maps/map_frame.h"
#include "view/theme.h"

namespace sonar {

/// Parallels and meridians of a map.
struct Graticule {
  struct Label {
    PixelPoint at;  ///< where the line meets the map's left (parallels) or lower edge (meridians)
    std::string text;
    double degrees = 0.0;
  };
  std::vector<std::vector<PixelPoint>> lines;
  std::vector<Label> latitudes;
  std::vector<Label> longitudes;
};

/// Lines at round degrees, minutes or seconds, about as far apart as asked for.
[[nodiscard]] Graticule graticule(const MapFrame& map, double spacing_px);

/// "60°30′ N", "179°59′30″ W"; minutes and seconds as far as the step needs them.
[[nodiscard]] std::string latitude_text(double degrees, double step_deg);
[[nodiscard]] std::string longitude_text(double degrees, double step_deg);

/// Draws lines (cut to the map), the frame and labels outside it at the left and below.
void add_graticule(FrameDescription& frame, const MapFrame& map, const Theme& theme);

}  // namespace sonar
