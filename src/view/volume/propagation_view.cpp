// SPDX-License-Identifier: Apache-2.0
#include "view/volume/propagation_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "view/axes.h"
#include "view/maps/map_items.h"
#include "view/shapes.h"
#include "view/volume/propagation_labels.h"
#include "view/volume/propagation_layout.h"

namespace sonar {
namespace {

std::shared_ptr<const Image> mask_image(const Sector& sector, const PropagationPanel& panel,
                                        const PropagationStyle& style, const PanelLayout& layout,
                                        const PixelRect& place) {
  PlanRaster raster;
  raster.width = std::max(1, static_cast<int>(std::ceil(place.width)));
  raster.height = std::max(1, static_cast<int>(std::ceil(place.height)));
  const double metres = 1.0 / layout.px_per_m;
  const double right = layout.middle.x + (0.5 - place.width / 2.0) * metres;
  const double up = layout.middle.y - (0.5 - place.height / 2.0) * metres;
  const bool above = style.aspect == MaskAspect::above;
  raster.origin_u = above ? up : right;
  raster.origin_v = above ? right : up;
  raster.x_step_u = above ? 0.0 : metres;
  raster.x_step_v = above ? metres : 0.0;
  raster.y_step_u = above ? -metres : 0.0;
  raster.y_step_v = above ? 0.0 : -metres;
  auto image = std::make_shared<Image>(PixelSize{raster.width, raster.height}, Rgba8{0, 0, 0, 0});
  std::vector<std::uint8_t> best(image->pixels.size(), 0);
  for (const MosaicMask& m : panel.masks) {
    if (m.mask == nullptr || m.mask->empty()) continue;
    const MaskPatch patch = patch_of(plan_seen(sector, *m.mask, style.aspect), raster);
    for (int j = 0; j < patch.height; ++j) {
      for (int i = 0; i < patch.width; ++i) {
        const std::uint8_t q = patch.confidence[static_cast<std::size_t>(j) * static_cast<std::size_t>(patch.width) +
                                                static_cast<std::size_t>(i)];
        const std::size_t at = image->index(patch.first_x + i, patch.first_y + j);
        if (q <= best[at]) continue;
        best[at] = q;
        image->pixels[at] = mask_colour(style.palette, m.school, q);
      }
    }
  }
  return image;
}

std::string state_of(const PropagationPanel& panel) {
  if (panel.absent) return panel.ping_index < 0 ? "before the first ping" : "after the last ping";
  if (panel.bad) return "bad ping";
  const bool empty = std::all_of(panel.masks.begin(), panel.masks.end(),
                                 [](const MosaicMask& m) { return m.mask == nullptr || m.mask->empty(); });
  if (!empty) return {};
  if (panel.left_out) return "schools not shown";
  return panel.searched ? "no school" : "schools not detected";
}

/// Schools' numbers beside their masks.
void add_numbers(FrameDescription& frame, const Sector& sector, const PropagationPanel& panel,
                 const PropagationStyle& style, const PanelLayout& layout, const PixelRect& place, const Theme& theme) {
  std::vector<PanelNumber> numbers;
  for (std::size_t i = 0; i < std::min(panel.masks.size(), panel.school_ids.size()); ++i) {
    const PingMask* mask = panel.masks[i].mask;
    if (mask == nullptr || mask->empty()) continue;
    const PlanBox box = box_of(plan_seen(sector, *mask, style.aspect), style.aspect);
    if (box.empty()) continue;
    const PixelPoint corner = layout.at({box.left, box.high}, place);
    const PixelPoint other = layout.at({box.right, box.low}, place);
    numbers.push_back(
        {fmt::format("{}", panel.school_ids[i]), {corner.x, corner.y, other.x - corner.x, other.y - corner.y}});
  }
  add_panel_numbers(frame, numbers, place, theme);
}

/// In the middle of a panel, in as many lines as it takes.
void add_state(FrameDescription& frame, const std::string& state, const PixelRect& place, const Theme& theme) {
  const double em = theme.text_px;
  const auto lines = wrapped(state, place.width - 0.5 * em, em);
  double y = place.y + place.height / 2.0 - 0.65 * em * (static_cast<double>(lines.size()) - 1.0);
  for (const std::string& line : lines) {
    TextItem text = text_item({place.x + place.width / 2.0, y}, line, em, theme.muted, TextAnchor::centre);
    text.halo = theme.halo;
    frame.items.emplace_back(std::move(text));
    y += 1.3 * em;
  }
}

void add_panel(FrameDescription& frame, const Sector& sector, const PropagationPanel& panel,
               const PropagationStyle& style, const PanelLayout& layout, const PixelRect& place, const Theme& theme) {
  const std::string state = state_of(panel);
  frame.items.emplace_back(rectangle_item(place, !panel.bad ? theme.plot : theme.no_data));
  if (panel.absent) {
    frame.items.emplace_back(rectangle_item(place, {0, 0, 0, 0}, theme.grid, theme.line_px));
    add_state(frame, state, place, theme);
    return;
  }
  frame.items.emplace_back(ClipItem{place});
  std::vector<PixelPoint> outline;
  for (const PlanePoint& p : plan_outline(sector, style.aspect)) outline.push_back(layout.at(p, place));
  if (!outline.empty()) {
    frame.items.emplace_back(polyline_item(std::move(outline), true, theme.outline, theme.line_px,
                                           panel.bad ? Rgba8{0, 0, 0, 0} : theme.water));
  }
  if (state.empty()) {
    frame.items.emplace_back(ImageItem{{place.x, place.y, std::ceil(place.width), std::ceil(place.height)},
                                       mask_image(sector, panel, style, layout, place),
                                       false});
    add_numbers(frame, sector, panel, style, layout, place, theme);
  }
  if (style.aspect == MaskAspect::side && std::isfinite(panel.transducer_depth_m)) {
    add_depth_scale(frame, panel.transducer_depth_m - layout.middle.y, layout.px_per_m, place, theme);
  }
  frame.items.emplace_back(ClipItem{});
  frame.items.emplace_back(rectangle_item(place, {0, 0, 0, 0}, panel.current ? theme.accent : theme.axis,
                                          (panel.current ? 2.5 : 1.0) * theme.line_px));
  if (!state.empty()) add_state(frame, state, place, theme);
  add_panel_note(frame, panel.note, place, theme);
  if (layout.words.pings) add_ping_label(frame, panel, style, layout.words.times, place, theme);
}

void add_footer(FrameDescription& frame, const PanelLayout& layout, const PropagationStyle& style, const Theme& theme) {
  const double em = theme.text_px;
  const double y = frame.size.height - 1.3 * em;
  const double most_m = std::min(12.0 * em, layout.width) / layout.px_per_m;
  const double length_m = round_below(most_m, theme.units.length());
  const double x = layout.area.x;
  const double end = x + length_m * layout.px_per_m;
  frame.items.emplace_back(polyline_item({{x, y - 0.3 * em}, {x, y}, {end, y}, {end, y - 0.3 * em}}, false, theme.text,
                                         1.5 * theme.line_px));
  double right = layout.area.x + layout.area.width;
  if (style.palette.colouring == MaskColouring::core_fuzzy) {
    for (const auto& [q, label] : {std::pair<std::uint8_t, const char*>{1, "fuzzy"}, {255, "core"}}) {
      frame.items.emplace_back(text_item({right, y}, label, em, theme.text, TextAnchor::right));
      right -= text_width_px(label, em) + 0.5 * em;
      frame.items.emplace_back(rectangle_item({right - 1.2 * em, y - 0.5 * em, 1.2 * em, em},
                                              mask_colour(style.palette, 0, q), theme.axis, 0.5 * theme.line_px));
      right -= 2.2 * em;
    }
  }
  // The most that there is room for.
  const auto words_of = [&]() -> std::string {
    const bool above = style.aspect == MaskAspect::above;
    std::string scale_words = round_text(length_m, theme.units.length());
    for (const char* more :
         {above ? " · from above, bow up" : " · from the side, ship to the left; depths below the surface",
          above ? " · from above" : " · from the side, ship to the left", above ? " · above" : " · from the side"}) {
      if (text_width_px((scale_words + more).c_str(), em) < right - end - 0.6 * em) return scale_words + more;
    }
    return scale_words;
  };
  const std::string words = words_of();
  frame.items.emplace_back(text_item({end + 0.6 * em, y}, elided(words, em, right - end - 0.6 * em), em, theme.muted));
}

}  // namespace

std::vector<PropagationPanel> propagation_panels(const ObservationProduct& product, std::int64_t current,
                                                 const PropagationStyle& style, bool searched) {
  std::vector<PropagationPanel> panels;
  const auto count = static_cast<std::int64_t>(product.pings.size());
  const bool all_shown = current - style.before <= 0 && current + style.after >= count - 1;
  for (std::int64_t i = current - style.before; i <= current + style.after; ++i) {
    const bool absent = i < 0 || i >= count;
    if (absent && all_shown) continue;
    PropagationPanel& panel = panels.emplace_back();
    panel.ping_index = i;
    panel.current = i == current;
    panel.absent = absent;
    panel.searched = searched;
    if (absent) continue;
    const PingNavigation& n = product.pings[static_cast<std::size_t>(i)];
    panel.time = n.time;
    panel.transducer_depth_m = n.transducer_depth_m;
    panel.bad = n.bad;
    for (const SchoolMask& m : product.masks) {
      if (m.ping_index != i) continue;
      panel.masks.push_back({static_cast<int>(m.school_id), &m.mask});
      panel.school_ids.push_back(m.school_id);
    }
  }
  return panels;
}

Result<FrameDescription> propagation_view(const Sector& sector, std::span<const PropagationPanel> panels,
                                          const PropagationStyle& style, PixelSize size, const Theme& theme,
                                          const std::string& title) {
  const auto layout = panel_layout(sector, panels, style, size, theme);
  if (!layout) return pass_on(layout);
  FrameDescription frame;
  frame.size = size;
  frame.background = theme.background;
  frame.title = title;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    add_panel(frame, sector, panels[i], style, *layout, layout->place(i), theme);
  }
  if (layout->words.scale) add_footer(frame, *layout, style, theme);
  Layout top;
  top.title = {layout->area.x, 0.9 * theme.text_px, layout->area.width, layout->area.y};
  if (!title.empty() && layout->words.title) add_title(frame, top, theme, {title});
  return frame;
}

}  // namespace sonar
