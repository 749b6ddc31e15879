// SPDX-License-Identifier: Apache-2.0
#include "view/volume/propagation_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "view/axes.h"
#include "view/label_room.h"
#include "view/maps/map_items.h"
#include "view/shapes.h"

namespace sonar {

void add_ping_label(FrameDescription& frame, const PropagationPanel& panel, const PropagationStyle& style, bool timed,
                    const PixelRect& place, const Theme& theme) {
  const double em = theme.text_px;
  const double middle = place.x + place.width / 2.0;
  double y = place.y - 0.8 * em;
  const auto add = [&](const std::string& words, double size, Rgba8 colour) -> TextItem& {
    frame.items.emplace_back(
        text_item({middle, y}, elided(words, size, place.width + 0.5 * em), size, colour, TextAnchor::centre));
    y -= 1.3 * em;
    return std::get<TextItem>(frame.items.back());
  };
  if (timed && panel.time != 0) {
    const std::string clock = clock_text(panel.time, true);
    add(clock.substr(11) + (style.dates ? " UTC" : ""), small_text_px(theme, 0.9), theme.muted);
    if (style.dates) add(clock.substr(0, 10), small_text_px(theme, 0.9), theme.muted);
  } else if (timed) {
    y -= (style.dates ? 2.6 : 1.3) * em;
  }
  add(fmt::format("ping {}", panel.ping_index), em, theme.text).bold = panel.current;
}

void add_depth_scale(FrameDescription& frame, double middle_m, double px_per_m, const PixelRect& place,
                     const Theme& theme) {
  const double size = small_text_px(theme, 0.8);
  const double half_m = 0.5 * place.height / px_per_m;
  const double shallow = middle_m - half_m;
  const double deep = middle_m + half_m;
  const auto y_of = [&](double depth) { return place.y + (depth - shallow) * px_per_m; };
  if (shallow < 0.0 && deep > 0.0) {
    frame.items.emplace_back(
        line_item({place.x, y_of(0.0)}, {place.x + place.width, y_of(0.0)}, theme.track, 1.5 * theme.line_px));
  }
  const Unit unit = theme.units.length();
  const Ticks ticks = nice_ticks(unit.of(std::max(0.0, shallow)), unit.of(deep),
                                 std::max(2, static_cast<int>(place.height / (3.0 * theme.text_px))));
  for (const double tick : ticks.major) {
    const double depth = tick * unit.si;
    const double y = y_of(depth);
    if (y - 0.7 * size < place.y || y + 0.7 * size > place.y + place.height) continue;
    frame.items.emplace_back(line_item({place.x, y}, {place.x + 0.5 * size, y}, theme.axis, theme.line_px));
    // The surface's own label stands on its line.
    const double words_y = depth > 0.0 ? y : std::max(place.y + 0.6 * size, y - 0.8 * size);
    TextItem text = text_item({place.x + 0.7 * size, words_y},
                              fmt::format("{} {}", tick_text(tick, ticks.decimals), unit.name), size, theme.text);
    text.halo = theme.halo;
    frame.items.emplace_back(std::move(text));
  }
}

void add_panel_numbers(FrameDescription& frame, std::span<const PanelNumber> numbers, const PixelRect& place,
                       const Theme& theme) {
  const double size = small_text_px(theme, 0.9);
  const double gap = 0.4 * size;
  LabelRoom room(place);
  for (const PanelNumber& number : numbers) room.take(number.mask);
  for (const PanelNumber& number : numbers) {
    const PixelRect& m = number.mask;
    const double wide = text_width_px(number.text.c_str(), size);
    const double right = m.x + m.width + gap;
    const double left = m.x - gap - wide;
    const double middle = m.x + (m.width - wide) / 2.0;
    const double y = m.y + m.height / 2.0;
    const double above = m.y - 0.8 * size;
    const double below = m.y + m.height + 0.8 * size;
    TextItem text = text_item({right, y}, number.text, size, theme.text);
    text.halo = theme.halo;
    const std::vector<PixelPoint> places{{right, y},     {left, y},      {middle, above}, {middle, below},
                                         {right, above}, {right, below}, {left, above},   {left, below}};
    if (auto placed = room.place(text, places)) {
      text = std::move(*placed);
    } else if (right + wide > place.x + place.width) {
      text.at.x = left;
    }
    frame.items.emplace_back(std::move(text));
  }
}

void add_panel_note(FrameDescription& frame, const std::string& note, const PixelRect& place, const Theme& theme) {
  const double size = small_text_px(theme, 0.85);
  const std::vector<std::string> lines = wrapped(note, place.width - size, size);
  double y = place.y + place.height - 0.4 * size - 1.25 * size * (static_cast<double>(lines.size()) - 0.5);
  for (const std::string& line : lines) {
    TextItem text = text_item({place.x + place.width / 2.0, y}, line, size, theme.accent, TextAnchor::centre);
    text.halo = theme.halo;
    if (y > place.y) frame.items.emplace_back(std::move(text));
    y += 1.25 * size;
  }
}

}  // namespace sonar
