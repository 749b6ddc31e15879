// SPDX-License-Identifier: Apache-2.0
#include "view/volume/propagation_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "view/axes.h"
#include "view/maps/map_items.h"
#include "view/shapes.h"
#include "view/volume/propagation_labels.h"

namespace sonar {
namespace {

constexpr double kMargin = 0.18;   ///< of the masks' size
constexpr double kLeast_m = 40.0;  ///< of what is seen
constexpr double kLeastPanel_em = 6.0;

/// What all panels show: a box in picture directions (right, up), m.
struct Window {
  double left = 1e300;
  double right = -1e300;
  double low = 1e300;
  double high = -1e300;
  void add(double x, double y) {
    left = std::min(left, x);
    right = std::max(right, x);
    low = std::min(low, y);
    high = std::max(high, y);
  }
  [[nodiscard]] bool empty() const { return right < left; }
};

/// (u, v) of a plan in picture directions.
PlanePoint seen(MaskAspect aspect, double angle, double distance) {
  const double u = distance * std::cos(angle);
  const double v = distance * std::sin(angle);
  return aspect == MaskAspect::above ? PlanePoint{v, u} : PlanePoint{u, v};
}

MaskPlan plan_of(const Sector& sector, const PingMask& mask, MaskAspect aspect) {
  const double bin_m = sector.range().spacing_m;
  return aspect == MaskAspect::above ? plan_from_above(sector, mask, bin_m) : plan_from_side(sector, mask, bin_m);
}

/// The sector's outline, m.
std::vector<PlanePoint> sector_outline(const Sector& sector, MaskAspect aspect) {
  constexpr int kSteps = 48;
  std::vector<PlanePoint> out;
  if (sector.fans() < 1 || sector.beams() < 1 || sector.range().count < 1) return out;
  const bool above = aspect == MaskAspect::above;
  const double first = above ? sector.azimuth_bounds(0).lower : sector.elevation_bounds(0).lower;
  const double last =
      above ? sector.azimuth_bounds(sector.beams() - 1).upper : sector.elevation_bounds(sector.fans() - 1).upper;
  double far_m = sector.range().range_m(sector.range().count - 0.5);
  if (above) {
    const double lowest = sector.elevation_bounds(0).lower;
    const double highest = sector.elevation_bounds(sector.fans() - 1).upper;
    far_m *= lowest < 0.0 && highest > 0.0 ? 1.0 : std::max({0.0, std::cos(lowest), std::cos(highest)});
  }
  out.push_back({0.0, 0.0});
  for (int i = 0; i <= kSteps; ++i) out.push_back(seen(aspect, first + (last - first) * i / kSteps, far_m));
  return out;
}

/// Widens a window over what a plan lights.
void include(Window& w, const MaskPlan& plan, MaskAspect aspect) {
  for (const MaskWedge& wedge : plan.wedges) {
    const double near_m = wedge.first_bin * plan.bin_m;
    const double far_m = (wedge.first_bin + static_cast<double>(wedge.bins.size())) * plan.bin_m;
    for (const double a : {wedge.first_rad, (wedge.first_rad + wedge.last_rad) / 2.0, wedge.last_rad}) {
      for (const double d : {near_m, far_m}) {
        const PlanePoint p = seen(aspect, a, d);
        w.add(p.x, p.y);
      }
    }
  }
}

Window window_of(const Sector& sector, std::span<const PropagationPanel> panels, const PropagationStyle& style) {
  Window w;
  const auto fit_to = [&](int school) {
    for (const PropagationPanel& panel : panels) {
      for (const MosaicMask& m : panel.masks) {
        if (m.mask == nullptr || (school >= 0 && m.school != school)) continue;
        include(w, plan_of(sector, *m.mask, style.aspect), style.aspect);
      }
    }
  };
  if (!style.whole_sector && style.focus >= 0) fit_to(style.focus);
  if (!style.whole_sector && w.empty()) fit_to(-1);
  if (w.empty()) {
    for (const PlanePoint& p : sector_outline(sector, style.aspect)) w.add(p.x, p.y);
  }
  if (w.empty()) w.add(0.0, 0.0);
  const double size = std::max(w.right - w.left, w.high - w.low);
  const double more = std::max(kMargin * size, (kLeast_m - size) / 2.0);
  return {w.left - more, w.right + more, w.low - more, w.high + more};
}

/// Rows and columns of panels, and each one's place.
struct Grid {
  int columns = 1;
  double width = 0.0;
  double height = 0.0;
};

/// What stands round the panels.
struct Words {
  bool title = true;
  bool times = true;
  bool scale = true;
  bool pings = true;
};
/// Each says less than the one before: a low view has fewer words, not smaller ones.
constexpr std::array<Words, 5> kWords{
    {{}, {.title = false}, {false, false}, {false, false, false}, {false, false, false, false}}};

struct Panels {
  PixelRect area;
  Words words;
  Grid grid;
  double label_px = 0.0;
  double gap_px = 0.0;
  [[nodiscard]] PixelRect place(std::size_t i) const {
    const int row = static_cast<int>(i) / grid.columns;
    const int column = static_cast<int>(i) % grid.columns;
    return {area.x + column * (grid.width + gap_px), area.y + row * (grid.height + label_px + gap_px) + label_px,
            grid.width, grid.height};
  }
};

/// As many columns as make the panels largest for what they show.
Panels laid_out(PixelSize size, const Theme& theme, std::size_t count, const Window& window,
                const PropagationStyle& style, const Words& words) {
  const double em = theme.text_px;
  Panels p;
  p.words = words;
  p.gap_px = 0.7 * em;
  p.label_px = (!words.pings ? 0.0 : !words.times ? 1.7 : style.dates ? 4.2 : 3.0) * em;
  const double top = theme.titles && words.title ? 1.6 * em + 1.5 * theme.title_px : 0.6 * em;
  p.area = {em, top, size.width - 2.0 * em, size.height - top - (words.scale ? 3.2 : 0.6) * em};
  const double shape = (window.right - window.left) / (window.high - window.low);
  double best = 0.0;
  const int n = static_cast<int>(count);
  for (int columns = style.one_row ? n : 1; columns <= n; ++columns) {
    const int rows = (n + columns - 1) / columns;
    const double width = (p.area.width - (columns - 1) * p.gap_px) / columns;
    const double height = (p.area.height - (rows - 1) * p.gap_px) / rows - p.label_px;
    const double scale = std::min(width / shape, height);
    if (scale > best) {
      best = scale;
      p.grid = {columns, width, height};
    }
  }
  return p;
}

struct Scale {
  double px_per_m = 1.0;
  double middle_x = 0.0;
  double middle_y = 0.0;
  [[nodiscard]] PixelPoint at(const PlanePoint& p, const PixelRect& place) const {
    return {place.x + place.width / 2.0 + (p.x - middle_x) * px_per_m,
            place.y + place.height / 2.0 - (p.y - middle_y) * px_per_m};
  }
};

std::shared_ptr<const Image> mask_image(const Sector& sector, const PropagationPanel& panel,
                                        const PropagationStyle& style, const Scale& scale, const PixelRect& place) {
  PlanRaster raster;
  raster.width = std::max(1, static_cast<int>(std::ceil(place.width)));
  raster.height = std::max(1, static_cast<int>(std::ceil(place.height)));
  const double metres = 1.0 / scale.px_per_m;
  const double right = scale.middle_x + (0.5 - place.width / 2.0) * metres;
  const double up = scale.middle_y - (0.5 - place.height / 2.0) * metres;
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
    const MaskPatch patch = patch_of(plan_of(sector, *m.mask, style.aspect), raster);
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
                 const PropagationStyle& style, const Scale& scale, const PixelRect& place, const Theme& theme) {
  std::vector<PanelNumber> numbers;
  for (std::size_t i = 0; i < std::min(panel.masks.size(), panel.school_ids.size()); ++i) {
    const PingMask* mask = panel.masks[i].mask;
    if (mask == nullptr || mask->empty()) continue;
    Window w;
    include(w, plan_of(sector, *mask, style.aspect), style.aspect);
    if (w.empty()) continue;
    const PixelPoint corner = scale.at({w.left, w.high}, place);
    const PixelPoint other = scale.at({w.right, w.low}, place);
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
               const PropagationStyle& style, const Scale& scale, const PixelRect& place, const Words& words,
               const Theme& theme) {
  const std::string state = state_of(panel);
  frame.items.emplace_back(rectangle_item(place, !panel.bad ? theme.plot : theme.no_data));
  if (panel.absent) {
    frame.items.emplace_back(rectangle_item(place, {0, 0, 0, 0}, theme.grid, theme.line_px));
    add_state(frame, state, place, theme);
    return;
  }
  frame.items.emplace_back(ClipItem{place});
  std::vector<PixelPoint> outline;
  for (const PlanePoint& p : sector_outline(sector, style.aspect)) outline.push_back(scale.at(p, place));
  if (!outline.empty()) {
    frame.items.emplace_back(polyline_item(std::move(outline), true, theme.outline, theme.line_px,
                                           panel.bad ? Rgba8{0, 0, 0, 0} : theme.water));
  }
  if (state.empty()) {
    frame.items.emplace_back(ImageItem{{place.x, place.y, std::ceil(place.width), std::ceil(place.height)},
                                       mask_image(sector, panel, style, scale, place),
                                       false});
    add_numbers(frame, sector, panel, style, scale, place, theme);
  }
  if (style.aspect == MaskAspect::side && std::isfinite(panel.transducer_depth_m)) {
    add_depth_scale(frame, panel.transducer_depth_m - scale.middle_y, scale.px_per_m, place, theme);
  }
  frame.items.emplace_back(ClipItem{});
  frame.items.emplace_back(rectangle_item(place, {0, 0, 0, 0}, panel.current ? theme.accent : theme.axis,
                                          (panel.current ? 2.5 : 1.0) * theme.line_px));
  if (!state.empty()) add_state(frame, state, place, theme);
  add_panel_note(frame, panel.note, place, theme);
  if (words.pings) add_ping_label(frame, panel, style, words.times, place, theme);
}

void add_footer(FrameDescription& frame, const Panels& panels, const PropagationStyle& style, const Scale& scale,
                const Theme& theme) {
  const double em = theme.text_px;
  const double y = frame.size.height - 1.3 * em;
  const double most_m = std::min(12.0 * em, panels.grid.width) / scale.px_per_m;
  const double length_m = round_below(most_m, theme.units.length());
  const double x = panels.area.x;
  const double end = x + length_m * scale.px_per_m;
  frame.items.emplace_back(polyline_item({{x, y - 0.3 * em}, {x, y}, {end, y}, {end, y - 0.3 * em}}, false, theme.text,
                                         1.5 * theme.line_px));
  double right = panels.area.x + panels.area.width;
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

namespace {

struct LaidOut {
  Panels places;
  Scale scale;
};

Result<LaidOut> laid_out(const Sector& sector, std::span<const PropagationPanel> panels, const PropagationStyle& style,
                         PixelSize size, const Theme& theme) {
  if (auto ok = validate(style); !ok) return pass_on(ok);
  if (panels.empty()) return fail(ErrorCode::bad_parameter, "a propagation view needs at least one ping");
  const Window window = window_of(sector, panels, style);
  LaidOut out;
  const Grid& grid = out.places.grid;
  const double least_px = kLeastPanel_em * theme.text_px;
  for (const Words& words : kWords) {
    out.places = laid_out(size, theme, panels.size(), window, style, words);
    if (grid.height >= least_px / 2.0) break;
  }
  if (grid.width < least_px || grid.height < least_px / 2.0) {
    return fail(ErrorCode::bad_parameter, fmt::format("a picture of {} x {} pixels is too small for {} pings",
                                                      size.width, size.height, panels.size()));
  }
  out.scale.middle_x = (window.left + window.right) / 2.0;
  out.scale.middle_y = (window.low + window.high) / 2.0;
  out.scale.px_per_m = std::min(grid.width / (window.right - window.left), grid.height / (window.high - window.low));
  return out;
}

}  // namespace

Result<std::vector<PixelRect>> propagation_places(const Sector& sector, std::span<const PropagationPanel> panels,
                                                  const PropagationStyle& style, PixelSize size, const Theme& theme) {
  const auto laid = laid_out(sector, panels, style, size, theme);
  if (!laid) return pass_on(laid);
  std::vector<PixelRect> out;
  for (std::size_t i = 0; i < panels.size(); ++i) out.push_back(laid->places.place(i));
  return out;
}

Result<FrameDescription> propagation_view(const Sector& sector, std::span<const PropagationPanel> panels,
                                          const PropagationStyle& style, PixelSize size, const Theme& theme,
                                          const std::string& title) {
  const auto laid = laid_out(sector, panels, style, size, theme);
  if (!laid) return pass_on(laid);
  const Panels& places = laid->places;
  const Scale& scale = laid->scale;
  FrameDescription frame;
  frame.size = size;
  frame.background = theme.background;
  frame.title = title;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    add_panel(frame, sector, panels[i], style, scale, places.place(i), places.words, theme);
  }
  if (places.words.scale) add_footer(frame, places, style, scale, theme);
  Layout layout;
  layout.title = {places.area.x, 0.9 * theme.text_px, places.area.width, places.area.y};
  if (!title.empty() && places.words.title) add_title(frame, layout, theme, {title});
  return frame;
}

}  // namespace sonar
