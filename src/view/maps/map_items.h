// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "model/map_outlines.h"
#include "model/navigation.h"
#include "model/product.h"
#include "view/maps/map_frame.h"
#include "view/theme.h"

namespace sonar {

/// An area on a map; vertices closer than half a pixel are left out. No parts where it is empty.
[[nodiscard]] PathItem area_item(const MapFrame& map, const GeoArea& area, Rgba8 fill, Stroke stroke);
/// The ship's path, broken where positions are unknown.
[[nodiscard]] PathItem track_item(const MapFrame& map, std::span<const PingNavigation> pings, Stroke stroke);
/// A round marker.
[[nodiscard]] PathItem circle_item(PixelPoint centre, double radius_px, Rgba8 fill, Stroke stroke = {});
/// Lines of a text that is wider than `width_px`, broken at spaces.
[[nodiscard]] std::vector<std::string> wrapped(const std::string& text, double width_px, double size_px);
/// "2009-11-13 08:11:49"; to the minute where seconds are not asked for.
[[nodiscard]] std::string clock_text(TimeNs time, bool seconds);
/// "2009-11-13 08:11 – 09:20 UTC"; the second date only where it differs. Empty for 0.
[[nodiscard]] std::string time_span_text(TimeNs first, TimeNs last);
/// "12 schools"; "2 of 12 schools" and "12 schools, not shown" where the picture leaves some or all of them out.
[[nodiscard]] std::string schools_text(std::size_t shown, std::size_t left_out);
/// The products' common title, without the observations' names; says SYNTHETIC where one of them does.
[[nodiscard]] std::string survey_title(std::span<const ObservationProduct> products);

/// "obs-0001 of <survey>", from a product's title; the name alone where the survey has none.
[[nodiscard]] std::string observation_title(const ObservationProduct& product);

/// Green: where an observation begins.
inline constexpr Rgba8 kStartColour{30, 170, 70, 255};

}  // namespace sonar
