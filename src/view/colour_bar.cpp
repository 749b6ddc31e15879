// SPDX-License-Identifier: Apache-2.0
#include "view/colour_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

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

/// Beside a short bar it is cut, for above lies the title: first what its decibels refer to, then by whole words.
void add_label(FrameDescription& frame, const PixelRect& place, const Theme& theme, std::string label) {
  const double room = place.height + 1.6 * theme.text_px;
  const auto refers = label.find(" re ");
  if (refers != std::string::npos && text_width_px(label.c_str(), theme.text_px) > room) {
    label.replace(refers, label.find(')', refers) - refers, "");
  }
  TextItem item = text_item({place.x + place.width + 4.7 * theme.text_px, place.y + place.height / 2},
                            elided_line(label, theme.text_px, room), theme.text_px, theme.muted, TextAnchor::centre);
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
  frame.items.emplace_back(text_item({x, y}, "threshold", small_text_px(theme, 0.9), theme.muted));
  TextItem figure =
      text_item({x, y + 1.25 * em}, tick_text(threshold_db, 1) + " dB", small_text_px(theme, 0.9), theme.accent);
  figure.bold = true;
  frame.items.emplace_back(std::move(figure));
}

int most_ticks(const PixelRect& place, const Theme& theme) {
  return std::max(2, static_cast<int>(place.height / (1.7 * theme.text_px)));
}

Ticks ticks_of(const ColourBar& bar, int most) {
  return bar.step > 0.0 ? step_ticks(bar.low, bar.high, bar.low, bar.step, most)
                        : nice_ticks(bar.low, bar.high, std::min(most, 9));
}

void draw_upright(FrameDescription& frame, const PixelRect& place, const ColourBar& bar, const Theme& theme) {
  std::vector<Rgba8> upwards = bar.colours;
  if (bar.rising_down) std::reverse(upwards.begin(), upwards.end());
  const BarAxis axis = bar.rising_down ? BarAxis{place, bar.high, bar.low} : BarAxis{place, bar.low, bar.high};
  add_blocks(frame, place, upwards, theme);
  add_ticks(frame, axis, ticks_of(bar, most_ticks(place, theme)), theme);
  add_label(frame, place, theme, bar.label);
  if (bar.threshold_db) add_threshold(frame, axis, *bar.threshold_db, theme);
}

// --- lying --------------------------------------------------------------------------------------------------------

void add_tick_below(FrameDescription& frame, const PixelRect& place, double x, const std::string& words, bool bold,
                    const Theme& theme) {
  const double em = theme.text_px;
  const double bottom = place.y + place.height;
  frame.items.emplace_back(line_item({x, bottom}, {x, bottom + (bold ? 0.55 : 0.35) * em}, theme.axis, theme.line_px));
  TextItem text = text_item({x, bottom + 1.15 * em}, words, em, theme.text, TextAnchor::centre);
  text.bold = bold;
  frame.items.emplace_back(std::move(text));
}

void add_level_threshold(FrameDescription& frame, const PixelRect& r, double x, const Theme& theme) {
  const double em = theme.text_px;
  frame.items.emplace_back(rectangle_item({r.x, r.y, x - r.x, r.height}, with_alpha(theme.water, 215)));
  frame.items.emplace_back(line_item({x, r.y}, {x, r.y + r.height}, theme.accent, 1.5 * theme.line_px));
  frame.items.emplace_back(
      polyline_item({{x, r.y - 0.1 * em}, {x - 0.4 * em, r.y - 0.75 * em}, {x + 0.4 * em, r.y - 0.75 * em}}, true,
                    {0, 0, 0, 0}, 0.0, theme.accent));
}

}  // namespace

ColourBar colour_bar(const SvColours& colours, std::string label) {
  ColourBar bar{colours.bar, colours.low_db, colours.high_db, colours.step_db, {}, false, std::move(label)};
  if (colours.threshold_db > kNoThreshold_db) bar.threshold_db = colours.threshold_db;
  return bar;
}

ColourBar colour_bar(const ColourMap& map, double low, double high, std::string label, bool rising_down) {
  ColourBar bar{{}, low, high, 0.0, {}, rising_down, std::move(label)};
  const int blocks = map.stepped ? static_cast<int>(map.knots.size()) : 192;
  for (int i = 0; i < blocks; ++i) bar.colours.push_back(map.at((i + 0.5) / blocks));
  return bar;
}

void add_colour_bar(FrameDescription& frame, const PixelRect& place, ColourBar bar, const Theme& theme) {
  if (theme.bars) return draw_upright(frame, place, bar, theme);
  frame.bars.push_back(std::move(bar));
}

void add_level_colour_bar(FrameDescription& frame, const PixelRect& place, const ColourBar& bar, const Theme& theme) {
  const double em = theme.text_px;
  auto image = std::make_shared<Image>(PixelSize{static_cast<int>(bar.colours.size()), 1});
  std::copy(bar.colours.begin(), bar.colours.end(), image->pixels.begin());
  frame.items.emplace_back(rectangle_item(place, theme.water));
  frame.items.emplace_back(ImageItem{place, std::move(image), false});
  frame.items.emplace_back(rectangle_item(place, {0, 0, 0, 0}, theme.axis, theme.line_px));
  const auto x_of = [&](double value) { return place.x + place.width * (value - bar.low) / (bar.high - bar.low); };
  const Ticks ticks = ticks_of(bar, std::max(2, static_cast<int>(place.width / (3.6 * em))));
  int end_decimals = 0;
  for (const double end : {bar.low, bar.high}) {
    if (std::abs(end - std::round(end)) > 1e-6) end_decimals = std::max(1, ticks.decimals);
  }
  const auto half = [&](const std::string& words) { return 0.55 * text_width_px(words.c_str(), em); };
  const std::string low = tick_text(bar.low, end_decimals);
  const std::string high = tick_text(bar.high, end_decimals);
  for (const double value : ticks.major) {
    const std::string words = tick_text(value, ticks.decimals);
    const double x = x_of(value);
    const bool room = x - half(words) > place.x + half(low) + 0.4 * em &&
                      x + half(words) < place.x + place.width - half(high) - 0.4 * em;
    if (room) add_tick_below(frame, place, x, words, false, theme);
  }
  add_tick_below(frame, place, place.x, low, true, theme);
  add_tick_below(frame, place, place.x + place.width, high, true, theme);
  std::string label = bar.label;
  if (bar.threshold_db) {
    if (*bar.threshold_db > bar.low && *bar.threshold_db < bar.high) {
      add_level_threshold(frame, place, x_of(*bar.threshold_db), theme);
    }
    label += "; threshold " + tick_text(*bar.threshold_db, 1) + " dB";
  }
  frame.items.emplace_back(text_item({place.x + place.width / 2.0, place.y + place.height + 2.55 * em}, label, em,
                                     theme.muted, TextAnchor::centre));
}

}  // namespace sonar
