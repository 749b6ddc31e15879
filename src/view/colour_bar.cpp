// SPDX-License-Identifier: Apache-2.0
#include "view/colour_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

#include "view/shapes.h"

namespace sonar {
namespace {

/// Value to height in the bar.
struct BarAxis {
  PixelRect place;
  double bottom = 0.0;
  double top = 1.0;
  [[nodiscard]] double y_of(double value) const { return place.y + place.height * (top - value) / (top - bottom); }
};

/// One block a colour; `colours` from the bottom up.
void add_blocks(FrameDescription& frame, const PixelRect& place, const std::vector<Rgba8>& colours,
                const Theme& theme) {
  auto image = std::make_shared<Image>(PixelSize{1, static_cast<int>(colours.size())});
  std::copy(colours.rbegin(), colours.rend(), image->pixels.begin());
  frame.items.emplace_back(rectangle_item(place, theme.water));
  frame.items.emplace_back(ImageItem{place, std::move(image), false});
  frame.items.emplace_back(rectangle_item(place, {0, 0, 0, 0}, theme.axis, theme.line_px));
}

void add_tick(FrameDescription& frame, const BarAxis& axis, double value, int decimals, bool bold, const Theme& theme) {
  const double y = axis.y_of(value);
  const double right = axis.place.x + axis.place.width;
  const double length = (bold ? 0.55 : 0.35) * theme.text_px;
  frame.items.emplace_back(line_item({right, y}, {right + length, y}, theme.axis, theme.line_px));
  TextItem text = text_item({right + 0.8 * theme.text_px, y}, tick_text(value, decimals), theme.text_px, theme.text);
  text.bold = bold;
  frame.items.emplace_back(std::move(text));
}

/// The two ends in bold, and the ticks that leave them room.
void add_ticks(FrameDescription& frame, const BarAxis& axis, const Ticks& ticks, const Theme& theme) {
  const double room = 1.15 * theme.text_px;
  int end_decimals = 0;
  for (const double end : {axis.bottom, axis.top}) {
    if (std::abs(end - std::round(end)) > 1e-6) end_decimals = std::max(1, ticks.decimals);
  }
  for (const double value : ticks.major) {
    const double y = axis.y_of(value);
    if (y - axis.place.y < room || axis.place.y + axis.place.height - y < room) continue;
    add_tick(frame, axis, value, ticks.decimals, false, theme);
  }
  add_tick(frame, axis, axis.bottom, end_decimals, true, theme);
  add_tick(frame, axis, axis.top, end_decimals, true, theme);
}

void add_label(FrameDescription& frame, const PixelRect& place, const Theme& theme, const std::string& label) {
  TextItem item = text_item({place.x + place.width + 4.7 * theme.text_px, place.y + place.height / 2}, label,
                            theme.text_px, theme.muted, TextAnchor::centre);
  item.turned_deg = -90.0;
  frame.items.emplace_back(std::move(item));
}

/// A mark of its own, left of the bar, and its figure below the bar.
void add_threshold(FrameDescription& frame, const BarAxis& axis, double threshold_db, const Theme& theme) {
  const PixelRect& r = axis.place;
  const double em = theme.text_px;
  const bool inside = threshold_db > axis.bottom && threshold_db < axis.top;
  if (inside) {
    const double y = axis.y_of(threshold_db);
    frame.items.emplace_back(rectangle_item({r.x, y, r.width, r.y + r.height - y}, with_alpha(theme.water, 215)));
    frame.items.emplace_back(line_item({r.x, y}, {r.x + r.width, y}, theme.accent, 1.5 * theme.line_px));
    frame.items.emplace_back(
        polyline_item({{r.x - 0.1 * em, y}, {r.x - 0.75 * em, y - 0.4 * em}, {r.x - 0.75 * em, y + 0.4 * em}}, true,
                      {0, 0, 0, 0}, 0.0, theme.accent));
  }
  const double x = r.x - 0.75 * em;
  const double y = r.y + r.height + 1.6 * em;
  frame.items.emplace_back(text_item({x, y}, "threshold", 0.9 * em, theme.muted));
  TextItem figure = text_item({x, y + 1.25 * em}, tick_text(threshold_db, 1) + " dB", 0.9 * em, theme.accent);
  figure.bold = true;
  frame.items.emplace_back(std::move(figure));
}

int most_ticks(const PixelRect& place, const Theme& theme) {
  return std::max(2, static_cast<int>(place.height / (1.7 * theme.text_px)));
}

}  // namespace

void add_colour_bar(FrameDescription& frame, const PixelRect& place, const SvColours& colours, const Theme& theme,
                    const std::string& label) {
  const BarAxis axis{place, colours.low_db, colours.high_db};
  add_blocks(frame, place, colours.bar, theme);
  const int most = most_ticks(place, theme);
  add_ticks(frame, axis,
            colours.step_db > 0.0 ? step_ticks(colours.low_db, colours.high_db, colours.low_db, colours.step_db, most)
                                  : nice_ticks(colours.low_db, colours.high_db, std::min(most, 9)),
            theme);
  add_label(frame, place, theme, label);
  if (colours.threshold_db > kNoThreshold_db) add_threshold(frame, axis, colours.threshold_db, theme);
}

void add_colour_bar(FrameDescription& frame, const PixelRect& place, const ColourMap& map, double low, double high,
                    const Theme& theme, const std::string& label, bool rising_down) {
  const int blocks = map.stepped ? static_cast<int>(map.knots.size()) : 192;
  std::vector<Rgba8> colours;
  for (int i = 0; i < blocks; ++i) {
    const double t = (i + 0.5) / blocks;
    colours.push_back(map.at(rising_down ? 1.0 - t : t));
  }
  const BarAxis axis = rising_down ? BarAxis{place, high, low} : BarAxis{place, low, high};
  add_blocks(frame, place, colours, theme);
  add_ticks(frame, axis, nice_ticks(low, high, std::min(most_ticks(place, theme), 9)), theme);
  add_label(frame, place, theme, label);
}

}  // namespace sonar
