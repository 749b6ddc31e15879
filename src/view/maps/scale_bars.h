// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "base/units.h"
#include "view/maps/map_frame.h"
#include "view/theme.h"

namespace sonar {

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

/// Nautical miles over kilometres, in a box.
struct ScaleBars {
  std::array<ScaleBar, 2> bars;
  PixelRect place;  ///< what they cover of the map
};
/// In the lower left, lower right or upper left corner of the map, the first that hides fewest symbols, and of those the one
/// that hides least else; empty in a map so low that they would cover a quarter of it and more.
/// symbols  where the ship may stand, starts, schools
/// else_shown  places all over what the map shows besides
[[nodiscard]] std::optional<ScaleBars> scale_bars(const MapFrame& map, const Theme& theme,
                                                  std::span<const PixelPoint> symbols,
                                                  std::span<const PixelPoint> else_shown = {});
void add_scale_bars(FrameDescription& frame, const ScaleBars& bars, const Theme& theme);

/// An arrow in the map's upper right corner where north is not up: over 1 degree off somewhere.
void add_north(FrameDescription& frame, const MapFrame& map, const Theme& theme);

}  // namespace sonar
