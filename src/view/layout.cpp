// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "view/axes.h"
#include "view/shapes.h"

namespace sonar {

Layout lay_out(PixelSize size, const Theme& theme, const LayoutNeeds& needs) {
  const double em = theme.text_px;
  const double pad = 0.9 * em;
  const double title_height = needs.title_lines > 0 ? 1.5 * theme.title_px + 1.45 * em * (needs.title_lines - 1) : 0.0;
  const double left =
      needs.y_axis ? std::round((0.45 + 0.3 + 0.64 * needs.y_label_characters + 1.8) * em + pad / 2) : pad;
  const double bottom = needs.x_axis ? std::round(3.3 * em + pad / 2) : pad;
  const double top = std::round(pad + title_height + (needs.title_lines > 0 ? 0.35 * em : 0.0));
  const double right = std::round(needs.colour_bar ? 8.8 * em : 1.2 * pad);
  Layout out;
  out.plot = {std::round(left), top, std::max(8.0, std::round(size.width - left - right)),
              std::max(8.0, std::round(size.height - top - bottom))};
  out.title = {out.plot.x, pad, std::max(8.0, size.width - out.plot.x - pad), title_height};
  if (needs.colour_bar) {
    const double height = std::round(std::min(out.plot.height - 3.0 * em, std::max(10.0 * em, 0.86 * out.plot.height)));
    out.colour_bar = {out.plot.x + out.plot.width + std::round(1.5 * em), out.plot.y + std::round(0.5 * em),
                      std::round(1.3 * em), std::max(8.0, height)};
  }
  return out;
}

void add_title(FrameDescription& frame, const Layout& layout, const Theme& theme, const std::vector<std::string>& lines,
               const std::string& right) {
  double y = layout.title.y + 0.6 * theme.title_px;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    TextItem item = text_item({layout.title.x, y}, lines[i], i == 0 ? theme.title_px : theme.text_px,
                              i == 0 ? theme.text : theme.muted);
    item.bold = i == 0;
    frame.items.emplace_back(std::move(item));
    if (i == 0 && !right.empty()) {
      // Where both do not fit, the right-hand text goes down to the second line's end.
      const bool fits = text_width_px(lines[0].c_str(), 1.1 * theme.title_px) +
                            text_width_px(right.c_str(), theme.text_px) + theme.text_px <
                        layout.title.width;
      const double down = fits || lines.size() < 2 ? 0.0 : 0.75 * theme.title_px + 0.7 * theme.text_px;
      frame.items.emplace_back(text_item({layout.title.x + layout.title.width, y + down}, right, theme.text_px,
                                         theme.muted, TextAnchor::right));
    }
    y += i == 0 ? 0.75 * theme.title_px + 0.7 * theme.text_px : 1.45 * theme.text_px;
  }
}

}  // namespace sonar
