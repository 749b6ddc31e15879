// SPDX-License-Identifier: Apache-2.0
#include "view/volume/distance_bar.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "view/label_room.h"
#include "view/shapes.h"

namespace sonar {
namespace {

std::string words_of(const DistanceBar& bar, const Theme& theme) {
  return round_text(bar.length_m, theme.units.length()) + " at the view's centre";
}

TextItem words_item(const DistanceBar& bar, PixelPoint at, const Theme& theme) {
  return {at, words_of(bar, theme), theme.text_px, theme.text, TextAnchor::right, 0.0, false, theme.halo};
}

}  // namespace

std::optional<DistanceBar> distance_bar(const Camera& camera, PixelSize size, double most_px, const Unit& unit) {
  const double distance_m = norm(camera.target - camera.eye);
  if (!(distance_m > 0.0) || size.height <= 0 || !(most_px > 1.0)) return std::nullopt;
  const double px_per_m = 0.5 * size.height / (std::tan(0.5 * camera.vertical_fov_rad) * distance_m);
  const double length_m = round_below(most_px / px_per_m, unit);
  if (!std::isfinite(length_m) || !(length_m > 0.0)) return std::nullopt;
  return DistanceBar{length_m, length_m * px_per_m};
}

PixelRect distance_bar_place(const DistanceBar& bar, double right, double bottom, const Theme& theme) {
  const double em = theme.text_px;
  const double width = std::max(bar.length_px, LabelRoom::box_of(words_item(bar, {}, theme)).width);
  const double height = 2.3 * em;
  return {right - width, bottom - height, width, height};
}

void add_distance_bar(FrameDescription& frame, const DistanceBar& bar, const PixelRect& place, const Theme& theme) {
  const double em = theme.text_px;
  const double right = place.x + place.width;
  const double left = right - bar.length_px;
  const double y = place.y + place.height - 0.4 * em;
  const auto stroke = [&](Rgba8 colour, double width_px) {
    PathItem item =
        polyline_item({{left, y - 0.35 * em}, {left, y}, {right, y}, {right, y - 0.35 * em}}, false, colour, width_px);
    frame.items.emplace_back(std::move(item));
  };
  stroke(theme.halo, 4.0 * theme.line_px);
  stroke(theme.text, 1.5 * theme.line_px);
  frame.items.emplace_back(words_item(bar, {right, place.y + 0.6 * em}, theme));
}

}  // namespace sonar
