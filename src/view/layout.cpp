// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "view/axes.h"
#include "view/shapes.h"

namespace sonar {

namespace {

constexpr double kLeastPlot_em = 5.0;  ///< of height, before the title's lines are left out
constexpr double kFirstLine = 1.5;     ///< of the title's text
constexpr double kNextLine = 1.45;     ///< of the text

double title_height(int lines, const Theme& theme) {
  return lines > 0 ? kFirstLine * theme.title_px + kNextLine * theme.text_px * (lines - 1) : 0.0;
}

/// Lines of a title that a place has room for.
std::size_t lines_in(const PixelRect& place, const Theme& theme) {
  const double next = (place.height - title_height(1, theme)) / (kNextLine * theme.text_px);
  return next < -1e-6 ? 0 : 1 + static_cast<std::size_t>(next + 1e-6);
}

}  // namespace

Layout lay_out(PixelSize size, const Theme& theme, const LayoutNeeds& wanted) {
  LayoutNeeds needs = wanted;
  if (!theme.titles) needs.title_lines = 0;
  needs.colour_bar = needs.colour_bar && theme.bars;
  const double em = theme.text_px;
  const double pad = 0.9 * em;
  const double left =
      needs.y_axis ? std::round((0.45 + 0.3 + 0.64 * needs.y_label_characters + 1.8) * em + pad / 2) : pad;
  const double foot = needs.foot_lines * kFootLine_em * em;
  const double bottom = (needs.x_axis ? std::round(3.3 * em + pad / 2) : pad) + std::round(foot);
  const auto top_with = [&](int lines) {
    return std::round(pad + title_height(lines, theme) + (lines > 0 ? 0.35 * em : 0.0));
  };
  // A flat picture would rather be seen than titled.
  while (needs.title_lines > 0 && size.height - top_with(needs.title_lines) - bottom < kLeastPlot_em * em) {
    --needs.title_lines;
  }
  const double top = top_with(needs.title_lines);
  const double right = std::round(needs.colour_bar ? 8.8 * em : 1.2 * pad);
  Layout out;
  out.plot = {std::round(left), top, std::max(8.0, std::round(size.width - left - right)),
              std::max(8.0, std::round(size.height - top - bottom))};
  out.title = {out.plot.x, pad, std::max(8.0, size.width - out.plot.x - pad), title_height(needs.title_lines, theme)};
  if (needs.foot_lines > 0)
    out.foot = {out.plot.x, size.height - 0.5 * pad - foot, std::max(8.0, size.width - out.plot.x - pad), foot};
  if (needs.colour_bar) {
    const double height = std::round(std::min(out.plot.height - 3.0 * em, std::max(10.0 * em, 0.86 * out.plot.height)));
    out.colour_bar = {out.plot.x + out.plot.width + std::round(1.5 * em), out.plot.y + std::round(0.5 * em),
                      std::round(1.3 * em), std::max(8.0, height)};
  }
  return out;
}

double map_top_px(const Theme& theme) {
  return theme.titles ? 1.6 * theme.text_px + 1.5 * theme.title_px + 1.1 * theme.text_px : theme.text_px;
}

namespace {

constexpr double kBold = 1.1;      ///< bold letters, of the width of plain ones
constexpr double kSmaller = 0.85;  ///< of the text that stands at a title's right

/// By whole words, or by letters where not even one of them has room.
std::string elided_title(const std::string& title, double size_px, double width_px) {
  std::string words = elided_line(title, size_px, width_px);
  return words.empty() ? elided(title, size_px, width_px) : words;
}

/// A title shortened to a width; data that nobody has recorded must still be known by it.
std::string shortened_title(std::string title, double size_px, double width_px) {
  constexpr const char* kMark = "SYNTHETIC";
  constexpr std::string_view kSaysLittle = "Fish schools of ";
  if (title.starts_with(kSaysLittle) && text_width_px(title.c_str(), kBold * size_px) > width_px) {
    title.erase(0, kSaysLittle.size());
  }
  std::string out = elided_title(title, kBold * size_px, width_px);
  const bool lost = title.find(kMark) != std::string::npos && out.find(kMark) == std::string::npos;
  return lost ? elided_title(std::string(kMark) + " " + title, kBold * size_px, width_px) : out;
}

/// "2020-01-04 08:00:50 UTC" without its day; other texts as they are.
std::string without_day(const std::string& text) {
  constexpr std::size_t kDay = 11;
  const bool day = text.size() > kDay && text[4] == '-' && text[7] == '-' && text[10] == ' ';
  return day ? text.substr(kDay) : text;
}

/// The right-hand text with its day, where the title or else the second line leaves room for it.
std::string right_text(const Layout& layout, const Theme& theme, const std::vector<std::string>& lines,
                       const std::string& right) {
  if (right.empty() || lines.empty()) return right;
  const double words = text_width_px(right.c_str(), small_text_px(theme, kSmaller)) + theme.text_px;
  const double below = text_width_px(right.c_str(), theme.text_px) + theme.text_px;
  const bool beside = text_width_px(lines[0].c_str(), kBold * theme.title_px) + words < layout.title.width;
  const bool second = lines.size() > 1 && text_width_px(lines[1].c_str(), theme.text_px) + below < layout.title.width;
  return beside || second ? right : without_day(right);
}

}  // namespace

void add_title(FrameDescription& frame, const Layout& layout, const Theme& theme, const std::vector<std::string>& lines,
               const std::string& whole_right) {
  const std::size_t shown = std::min(lines.size(), lines_in(layout.title, theme));
  if (!theme.titles || shown == 0) return;
  const std::string right = right_text(layout, theme, lines, whole_right);
  // The plot's width is no limit, the picture's is.
  const double width = std::max(layout.title.width, frame.size.width - layout.title.x - 0.5 * theme.text_px);
  const auto width_at = [&](double size) {
    return right.empty() ? 0.0 : text_width_px(right.c_str(), size) + theme.text_px;
  };
  const auto fits_at = [&](double size) {
    return !lines.empty() &&
           text_width_px(lines[0].c_str(), kBold * theme.title_px) + width_at(size) < layout.title.width;
  };
  // Where both do not fit, the right-hand text becomes smaller, else it goes down to the second line's end.
  const double small = small_text_px(theme, kSmaller);
  const double right_size = !fits_at(theme.text_px) && fits_at(small) ? small : theme.text_px;
  const double right_width = width_at(right_size);
  const bool beside = fits_at(right_size);
  const bool below = !beside && shown > 1;
  // It stays away where it would take more than half of the second line's own words.
  const double own = below ? 0.5 * text_width_px(lines[1].c_str(), theme.text_px) : 0.0;
  const bool stays =
      !right.empty() && (beside || layout.title.width - right_width > std::max(8.0 * theme.text_px, own));
  double y = layout.title.y + 0.6 * theme.title_px;
  for (std::size_t i = 0; i < shown; ++i) {
    const bool first = i == 0;
    const bool shared = stays && i == (below ? 1U : 0U);
    const double room = shared ? layout.title.width - right_width : width;
    const bool large = first && text_width_px(lines[i].c_str(), kBold * theme.title_px) <= room;
    const double size = large ? theme.title_px : theme.text_px;
    TextItem item = text_item({layout.title.x, y},
                              first ? shortened_title(lines[i], size, room) : elided_line(lines[i], size, room), size,
                              first ? theme.text : theme.muted);
    item.bold = first;
    frame.items.emplace_back(std::move(item));
    if (shared) {
      frame.items.emplace_back(
          text_item({layout.title.x + layout.title.width, y}, right, right_size, theme.muted, TextAnchor::right));
    }
    y += first ? 0.75 * theme.title_px + 0.7 * theme.text_px : 1.45 * theme.text_px;
  }
}

}  // namespace sonar
