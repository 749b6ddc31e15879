// SPDX-License-Identifier: Apache-2.0
#include "view/key_rows.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "view/shapes.h"

namespace sonar {
namespace {

constexpr double kText = 0.9;  ///< of the theme's text
constexpr double kSwatch_em = 1.7;
constexpr double kBeside_em = 0.5;  ///< between a swatch and its words
constexpr double kBetween_em = 1.5;

/// Where each entry begins: line and x, px.
std::vector<std::pair<int, double>> places(std::span<const KeyEntry> entries, double width_px, const Theme& theme) {
  std::vector<std::pair<int, double>> out;
  const double em = theme.text_px;
  int line = 0;
  double x = 0.0;
  for (const KeyEntry& entry : entries) {
    const double width =
        (kSwatch_em + kBeside_em) * em + text_width_px(entry.text.c_str(), small_text_px(theme, kText));
    if (x > 0.0 && x + width > width_px) {
      ++line;
      x = 0.0;
    }
    out.emplace_back(line, x);
    x += width + kBetween_em * em;
  }
  return out;
}

}  // namespace

int key_lines(std::span<const KeyEntry> entries, double width_px, const Theme& theme) {
  return entries.empty() ? 0 : places(entries, width_px, theme).back().first + 1;
}

void add_key(FrameDescription& frame, const PixelRect& place, std::span<const KeyEntry> entries, const Theme& theme) {
  const double em = theme.text_px;
  const double size = small_text_px(theme, kText);
  const auto at = places(entries, place.width, theme);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (!entries[i].draw) continue;
    const double middle = place.y + (at[i].first + 0.5) * kFootLine_em * em;
    const PixelRect swatch{std::round(place.x + at[i].second), std::round(middle - 0.5 * em),
                           std::round(kSwatch_em * em), std::round(em)};
    entries[i].draw(frame, swatch);
    const double words = swatch.x + (kSwatch_em + kBeside_em) * em;
    frame.items.emplace_back(
        text_item({words, middle}, elided(entries[i].text, size, place.x + place.width - words), size, theme.text));
  }
}

}  // namespace sonar
