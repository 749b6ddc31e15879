// SPDX-License-Identifier: Apache-2.0
#include "view/figures/figure_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "view/axes.h"
#include "view/colour_bar.h"
#include "view/composed_figure.h"
#include "view/maps/map_items.h"
#include "view/shapes.h"

namespace sonar {
namespace {

/// "Sv (dB re 1 m-1)" in its quantity and " (dB re 1 m-1)".
std::pair<std::string, std::string> quantity_and_unit(const std::string& label) {
  const std::size_t at = label.rfind(" (");
  return at == std::string::npos ? std::pair{label, std::string()} : std::pair{label.substr(0, at), label.substr(at)};
}

bool same_scale(const ColourBar& a, const ColourBar& b) {
  ColourBar named = b;
  named.label = a.label;
  return a == named && quantity_and_unit(a.label).second == quantity_and_unit(b.label).second;
}

std::string letters_text(std::span<const std::size_t> panels) {
  std::vector<std::string> letters;
  for (const std::size_t panel : panels) letters.push_back(panel_letter(panel));
  return fmt::format("{}", fmt::join(letters, ", "));
}

/// Of panels that read one scale.
class Quantities {
 public:
  void add(const std::string& label, std::size_t panel) {
    const std::string quantity = quantity_and_unit(label).first;
    auto found = std::find_if(list_.begin(), list_.end(), [&](const auto& one) { return one.first == quantity; });
    if (found == list_.end()) found = list_.insert(list_.end(), {quantity, {}});
    if (found->second.empty() || found->second.back() != panel) found->second.push_back(panel);
  }
  /// "a, b: Sv; c: largest Sv (dB re 1 m-1)".
  [[nodiscard]] std::string label(const std::string& any, bool letters) const {
    if (list_.size() == 1) return any;
    std::vector<std::string> words;
    for (const auto& [quantity, panels] : list_) {
      words.push_back(letters ? letters_text(panels) + ": " + quantity : quantity);
    }
    return fmt::format("{}{}", fmt::join(words, letters ? "; " : ", "), quantity_and_unit(any).second);
  }

 private:
  std::vector<std::pair<std::string, std::vector<std::size_t>>> list_;
};

/// What the page draws with; lengths are its pixels.
struct Page {
  const FigureParams& params;
  const FigureLayout& layout;
  std::span<const FigurePanel> panels;
  Theme theme;
  FrameDescription frame;
};

void add_lines(Page& page, const PixelRect& place, const std::string& text, Rgba8 colour) {
  const double em = page.theme.text_px;
  double y = place.y + 0.3 * em + 0.725 * em;
  for (const std::string& line : wrapped(text, place.width, em)) {
    page.frame.items.emplace_back(text_item({place.x, y}, line, em, colour));
    y += 1.45 * em;
  }
}

void add_heading(Page& page, std::size_t panel) {
  const PixelRect& place = page.layout.headings[panel];
  const double em = page.theme.text_px;
  if (!(place.height > 0.0)) return;
  PixelPoint at{place.x + 0.3 * em, place.y + 0.5 * place.height};
  if (page.params.letters) {
    TextItem letter = text_item(at, panel_letter(panel), em, page.theme.text);
    letter.bold = true;
    at.x += text_width_px(letter.text.c_str(), 1.1 * em) + 0.7 * em;
    page.frame.items.emplace_back(std::move(letter));
  }
  if (page.params.headings != FigureHeadings::names) return;
  const double room = place.x + place.width - at.x;
  page.frame.items.emplace_back(text_item(at, elided(page.panels[panel].name, em, room), em, page.theme.text));
}

void say_why_not(Page& page, std::size_t panel) {
  const PixelRect& place = page.layout.panels[panel];
  const double em = page.theme.text_px;
  page.frame.items.emplace_back(rectangle_item(place, {0, 0, 0, 0}, page.theme.grid, page.theme.line_px));
  const auto lines = wrapped(page.panels[panel].problem, place.width - 2.0 * em, em);
  double y = place.y + 0.5 * place.height - 0.725 * em * static_cast<double>(lines.size() - 1);
  for (const std::string& line : lines) {
    page.frame.items.emplace_back(
        text_item({place.x + 0.5 * place.width, y}, line, em, page.theme.muted, TextAnchor::centre));
    y += 1.45 * em;
  }
}

/// At its own scale, so that text is as large as in every other panel, in the middle of its place.
void add_panel(Page& page, std::size_t panel) {
  add_heading(page, panel);
  const FigurePanel& one = page.panels[panel];
  if (!one.frame) return say_why_not(page, panel);
  const PixelRect& place = page.layout.panels[panel];
  const double scale = panel_drawing(page.params).on_page * one.scale;
  const double width = one.frame->size.width * scale;
  const double height = one.frame->size.height * scale;
  place_frame(page.frame, *one.frame,
              {place.x + (place.width - width) / 2.0, place.y + (place.height - height) / 2.0, width, height});
}

/// Which panels a bar is of, where not all of them are.
std::string owners(const Page& page, const SharedBar& bar) {
  if (page.params.letters) return letters_text(bar.panels);
  std::vector<std::string> names;
  for (const std::size_t panel : bar.panels) names.push_back(page.panels[panel].name);
  return fmt::format("{}", fmt::join(names, ", "));
}

void add_owners(Page& page, const SharedBar& bar, PixelPoint at, double room, TextAnchor anchor) {
  const double em = page.theme.text_px;
  TextItem item = text_item(at, elided(owners(page, bar), 1.1 * em, room), em, page.theme.text, anchor);
  item.bold = page.params.letters;
  page.frame.items.emplace_back(std::move(item));
}

/// One above the other, at the right of the panels.
void add_upright_bars(Page& page, std::span<const SharedBar> bars) {
  const double em = page.theme.text_px;
  const PixelRect& place = page.layout.legend;
  const double share = place.height / static_cast<double>(bars.size());
  const double above = bars.size() > 1 ? 1.7 * em : 1.0 * em;
  for (std::size_t i = 0; i < bars.size(); ++i) {
    const double y = place.y + static_cast<double>(i) * share;
    const double below = bars[i].bar.threshold_db ? 4.2 * em : 1.2 * em;
    const double label = 1.1 * text_width_px(bars[i].bar.label.c_str(), em);
    const double height = std::clamp(std::max(label, 0.5 * share), em, std::max(em, share - above - below));
    const PixelRect bar{place.x + 2.0 * em, y + above, 1.3 * em, std::min(height, 24.0 * em)};
    if (bars.size() > 1) add_owners(page, bars[i], {bar.x, y + 0.6 * em}, place.width - 2.0 * em, TextAnchor::left);
    ColourBar shown = bars[i].bar;
    shown.label = elided(shown.label, em, share - 0.5 * em);
    add_colour_bar(page.frame, bar, std::move(shown), page.theme);
  }
}

/// Beside each other, below the panels.
void add_level_bars(Page& page, std::span<const SharedBar> bars) {
  const double em = page.theme.text_px;
  const PixelRect& place = page.layout.legend;
  const double share = place.width / static_cast<double>(bars.size());
  for (std::size_t i = 0; i < bars.size(); ++i) {
    const double middle = place.x + (static_cast<double>(i) + 0.5) * share;
    const double width = std::clamp(share - 4.0 * em, em, 26.0 * em);
    const PixelRect bar{middle - width / 2.0, place.y + 1.9 * em, width, 0.9 * em};
    if (bars.size() > 1) add_owners(page, bars[i], {middle, place.y + 0.7 * em}, share - em, TextAnchor::centre);
    ColourBar shown = bars[i].bar;
    shown.label = elided(shown.label, em, share - 0.5 * em);
    add_level_colour_bar(page.frame, bar, shown, page.theme);
  }
}

void add_legend(Page& page) {
  if (!(page.layout.legend.width > 0.0)) return;
  const std::vector<SharedBar> bars = shared_bars(page.panels, page.params.letters);
  if (bars.empty()) return;
  page.layout.legend_below ? add_level_bars(page, bars) : add_upright_bars(page, bars);
}

/// The first that has one tells of the program and the recipe; times are those of all.
PictureOrigin common_origin(std::span<const FigurePanel> panels) {
  PictureOrigin out;
  std::string first;
  std::string last;
  for (const FigurePanel& panel : panels) {
    if (!panel.frame) continue;
    const PictureOrigin& origin = panel.frame->origin;
    if (out.program.empty()) out = origin;
    const std::size_t slash = origin.data_time.find('/');
    if (slash == std::string::npos) continue;
    const std::string from = origin.data_time.substr(0, slash);
    const std::string to = origin.data_time.substr(slash + 1);
    if (first.empty() || from < first) first = from;
    if (to > last) last = to;
  }
  if (!first.empty()) out.data_time = first + "/" + last;
  return out;
}

}  // namespace

std::string panel_letter(std::size_t index) {
  std::string letters;
  for (std::size_t rest = index + 1; rest > 0; rest = (rest - 1) / 26) {
    letters.insert(letters.begin(), static_cast<char>('a' + (rest - 1) % 26));
  }
  return letters;
}

std::vector<SharedBar> shared_bars(std::span<const FigurePanel> panels, bool letters) {
  std::vector<SharedBar> out;
  std::vector<Quantities> quantities;
  for (std::size_t panel = 0; panel < panels.size(); ++panel) {
    if (!panels[panel].frame) continue;
    for (const ColourBar& bar : panels[panel].frame->bars) {
      auto found = std::find_if(out.begin(), out.end(), [&](const SharedBar& one) { return same_scale(one.bar, bar); });
      if (found == out.end()) {
        found = out.insert(out.end(), {bar, {}});
        quantities.emplace_back();
      }
      if (found->panels.empty() || found->panels.back() != panel) found->panels.push_back(panel);
      quantities[static_cast<std::size_t>(found - out.begin())].add(bar.label, panel);
    }
  }
  for (std::size_t i = 0; i < out.size(); ++i) out[i].bar.label = quantities[i].label(out[i].bar.label, letters);
  return out;
}

FrameDescription figure_page(const FigureParams& params, const FigureLayout& layout,
                             std::span<const FigurePanel> panels, const std::string& source) {
  const double em = params.text_pt * params.dpi / 72.0;
  Page page{params, layout, panels, panel_theme({em, 0.75 * params.dpi / 96.0, true}, params.dark), {}};
  page.theme.bars = true;
  page.frame.size = layout.page;
  page.frame.background = page.theme.background;
  page.frame.dots_per_inch = params.dpi;
  page.frame.title = params.title.empty() ? source : params.title;
  page.frame.origin = common_origin(panels);
  if (layout.title.height > 0.0) {
    TextItem title = text_item({layout.title.x, layout.title.y + 0.7 * em},
                               elided(params.title, 1.1 * 1.15 * em, layout.title.width), 1.15 * em, page.theme.text);
    title.bold = true;
    page.frame.items.emplace_back(std::move(title));
  }
  for (std::size_t i = 0; i < panels.size() && i < layout.panels.size(); ++i) add_panel(page, i);
  add_legend(page);
  if (layout.source.height > 0.0) add_lines(page, layout.source, source, page.theme.muted);
  if (layout.caption.height > 0.0) add_lines(page, layout.caption, params.caption, page.theme.text);
  return std::move(page.frame);
}

}  // namespace sonar
