// SPDX-License-Identifier: Apache-2.0
#include "view/volume/propagation_layout.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace sonar {
namespace {

constexpr double kMargin = 0.18;   ///< of the masks' size
constexpr double kLeast_m = 40.0;  ///< of what is seen
constexpr double kLeastPanel_em = 6.0;

/// (u, v) of a plan in picture directions.
PlanePoint seen(MaskAspect aspect, double angle, double distance) {
  const double u = distance * std::cos(angle);
  const double v = distance * std::sin(angle);
  return aspect == MaskAspect::above ? PlanePoint{v, u} : PlanePoint{u, v};
}

/// Widens a box over what a plan lights.
void include(PlanBox& box, const MaskPlan& plan, MaskAspect aspect) {
  for (const MaskWedge& wedge : plan.wedges) {
    const double near_m = wedge.first_bin * plan.bin_m;
    const double far_m = (wedge.first_bin + static_cast<double>(wedge.bins.size())) * plan.bin_m;
    for (const double a : {wedge.first_rad, (wedge.first_rad + wedge.last_rad) / 2.0, wedge.last_rad}) {
      for (const double d : {near_m, far_m}) {
        const PlanePoint p = seen(aspect, a, d);
        box.add(p.x, p.y);
      }
    }
  }
}

PlanBox shown_of(const Sector& sector, std::span<const PropagationPanel> panels, const PropagationStyle& style) {
  PlanBox box;
  const auto fit_to = [&](int school) {
    for (const PropagationPanel& panel : panels) {
      for (const MosaicMask& m : panel.masks) {
        if (m.mask == nullptr || (school >= 0 && m.school != school)) continue;
        include(box, plan_seen(sector, *m.mask, style.aspect), style.aspect);
      }
    }
  };
  if (!style.whole_sector && style.focus >= 0) fit_to(style.focus);
  if (!style.whole_sector && box.empty()) fit_to(-1);
  if (box.empty()) {
    for (const PlanePoint& p : plan_outline(sector, style.aspect)) box.add(p.x, p.y);
  }
  if (box.empty()) box.add(0.0, 0.0);
  const double size = std::max(box.right - box.left, box.high - box.low);
  const double more = std::max(kMargin * size, (kLeast_m - size) / 2.0);
  return {box.left - more, box.right + more, box.low - more, box.high + more};
}

/// Each says less than the one before: a low view has fewer words, not smaller ones.
constexpr std::array<PanelWords, 5> kWords{
    {{}, {.title = false}, {false, false}, {false, false, false}, {false, false, false, false}}};

/// As many columns as make the panels largest for what they show.
PanelLayout laid_out(PixelSize size, const Theme& theme, std::size_t count, const PlanBox& shown,
                     const PropagationStyle& style, const PanelWords& words) {
  const double em = theme.text_px;
  PanelLayout p;
  p.words = words;
  p.gap_px = 0.7 * em;
  p.label_px = (!words.pings ? 0.0 : !words.times ? 1.7 : style.dates ? 4.2 : 3.0) * em;
  const double top = theme.titles && words.title ? 1.6 * em + 1.5 * theme.title_px : 0.6 * em;
  p.area = {em, top, size.width - 2.0 * em, size.height - top - (words.scale ? 3.2 : 0.6) * em};
  const double shape = (shown.right - shown.left) / (shown.high - shown.low);
  double best = 0.0;
  const int n = static_cast<int>(count);
  for (int columns = style.one_row ? n : 1; columns <= n; ++columns) {
    const int rows = (n + columns - 1) / columns;
    const double width = (p.area.width - (columns - 1) * p.gap_px) / columns;
    const double height = (p.area.height - (rows - 1) * p.gap_px) / rows - p.label_px;
    const double scale = std::min(width / shape, height);
    if (scale > best) {
      best = scale;
      p.columns = columns;
      p.width = width;
      p.height = height;
    }
  }
  return p;
}

}  // namespace

MaskPlan plan_seen(const Sector& sector, const PingMask& mask, MaskAspect aspect) {
  const double bin_m = sector.range().spacing_m;
  return aspect == MaskAspect::above ? plan_from_above(sector, mask, bin_m) : plan_from_side(sector, mask, bin_m);
}

PlanBox box_of(const MaskPlan& plan, MaskAspect aspect) {
  PlanBox box;
  include(box, plan, aspect);
  return box;
}

std::vector<PlanePoint> plan_outline(const Sector& sector, MaskAspect aspect) {
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

PixelRect PanelLayout::place(std::size_t panel) const {
  const int row = static_cast<int>(panel) / columns;
  const int column = static_cast<int>(panel) % columns;
  return {area.x + column * (width + gap_px), area.y + row * (height + label_px + gap_px) + label_px, width, height};
}

PixelPoint PanelLayout::at(const PlanePoint& point, const PixelRect& place) const {
  return {place.x + place.width / 2.0 + (point.x - middle.x) * px_per_m,
          place.y + place.height / 2.0 - (point.y - middle.y) * px_per_m};
}

Result<PanelLayout> panel_layout(const Sector& sector, std::span<const PropagationPanel> panels,
                                 const PropagationStyle& style, PixelSize size, const Theme& theme) {
  if (auto ok = validate(style); !ok) return pass_on(ok);
  if (panels.empty()) return fail(ErrorCode::bad_parameter, "a propagation view needs at least one ping");
  const PlanBox shown = shown_of(sector, panels, style);
  PanelLayout out;
  const double least_px = kLeastPanel_em * theme.text_px;
  for (const PanelWords& words : kWords) {
    out = laid_out(size, theme, panels.size(), shown, style, words);
    if (out.height >= least_px / 2.0) break;
  }
  if (out.width < least_px || out.height < least_px / 2.0) {
    return fail(ErrorCode::bad_parameter, fmt::format("a picture of {} x {} pixels is too small for {} pings",
                                                      size.width, size.height, panels.size()));
  }
  out.middle = {(shown.left + shown.right) / 2.0, (shown.low + shown.high) / 2.0};
  out.px_per_m = std::min(out.width / (shown.right - shown.left), out.height / (shown.high - shown.low));
  return out;
}

Result<std::vector<PixelRect>> propagation_places(const Sector& sector, std::span<const PropagationPanel> panels,
                                                  const PropagationStyle& style, PixelSize size, const Theme& theme) {
  const auto layout = panel_layout(sector, panels, style, size, theme);
  if (!layout) return pass_on(layout);
  std::vector<PixelRect> out;
  for (std::size_t i = 0; i < panels.size(); ++i) out.push_back(layout->place(i));
  return out;
}

}  // namespace sonar
