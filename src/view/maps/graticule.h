// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
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

/// A bar of round length, true at its place.
struct ScaleBar {
  double length_m = 0.0;
  PixelPoint from;
  PixelPoint to;
  std::string text;  ///< "5 nmi", "10 km"
};
/// left  of the bar; most_px  its longest length. Units: nautical miles or kilometres, metres where short.
[[nodiscard]] ScaleBar scale_bar(const MapFrame& map, PixelPoint left, double most_px, bool nautical,
                                 const Units& units = {});
/// Both bars in the map's lower left corner, but in a map so low that they would lie over what it shows; where north is not
/// up (over 1 degree off somewhere), an arrow in its upper right corner.
void add_scale_and_north(FrameDescription& frame, const MapFrame& map, const Theme& theme);
/// What the bars cover of the map; empty where there are none.
[[nodiscard]] std::optional<PixelRect> scale_bars_place(const MapFrame& map, const Theme& theme);

}  // namespace sonar
