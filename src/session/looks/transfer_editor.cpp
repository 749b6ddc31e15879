// SPDX-License-Identifier: Apache-2.0
#include "session/looks/transfer_editor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/units.h"
#include "view/theme.h"

namespace sonar {
namespace {

constexpr double kFirst_db = -100.0;  // of the plot
constexpr double kLast_db = -10.0;
constexpr double kBar_px = 14.0;
constexpr double kGrab_px = 8.0;
constexpr double kLeastSpan_db = 1.0;
constexpr double kApart_db = 0.1;  // corners keep their order

double distance_px(PixelPoint a, PixelPoint b) { return std::hypot(a.x - b.x, a.y - b.y); }

PathItem polyline(const std::vector<PixelPoint>& points, const Stroke& stroke) {
  PathItem item;
  item.parts.push_back({points, false});
  item.stroke = stroke;
  return item;
}

void add_histogram(FrameDescription& frame, const PlotFrame& plot, const std::vector<double>& bins,
                   const Theme& theme) {
  PathItem bars;
  bars.fill = with_alpha(theme.muted, 90);
  for (std::size_t i = 0; i < bins.size(); ++i) {
    if (bins[i] <= 0.0) continue;
    const double left = kFirst_db + static_cast<double>(i);
    const PixelPoint a = plot.at(left, bins[i]);
    const PixelPoint b = plot.at(left + 1.0, 0.0);
    bars.parts.push_back({{a, {b.x, a.y}, b, {a.x, b.y}}, true});
  }
  frame.items.emplace_back(std::move(bars));
}

void add_curve(FrameDescription& frame, const PlotFrame& plot, const std::vector<OpacityPoint>& points, Rgba8 colour,
               bool edited, const Theme& theme) {
  if (points.empty()) return;
  std::vector<PixelPoint> line{plot.at(kFirst_db, points.front().opacity)};
  for (const OpacityPoint& point : points) line.push_back(plot.at(point.sv_db, point.opacity));
  line.push_back(plot.at(kLast_db, points.back().opacity));
  frame.items.emplace_back(
      polyline(line, {colour, edited ? 2.0 : 1.0, edited ? std::vector<double>{} : std::vector{4.0, 3.0}}));
  if (!edited) return;
  PathItem corners;
  corners.fill = theme.plot;
  corners.stroke = {colour, 2.0, {}};
  for (const OpacityPoint& point : points) {
    const auto [x, y] = plot.at(point.sv_db, point.opacity);
    corners.parts.push_back({{{x - 4, y - 4}, {x + 4, y - 4}, {x + 4, y + 4}, {x - 4, y + 4}}, true});
  }
  frame.items.emplace_back(std::move(corners));
}

void add_bar(FrameDescription& frame, const PlotFrame& plot, const PixelRect& bar, const SvScale& scale,
             const Theme& theme) {
  const SvColours colours = sv_colours(scale);
  const int width = std::max(1, static_cast<int>(bar.width));
  Image image({width, 1});
  for (int x = 0; x < width; ++x) {
    const double sv_db = plot.x_at(bar.x + x + 0.5);
    const double count = std::clamp(std::round(counts_from_db(sv_db)), -32000.0, 32000.0);
    const Rgba8 colour = colours[static_cast<std::int16_t>(count)];
    image.at(x, 0) = colour.a == 0 ? theme.water : colour;
  }
  frame.items.emplace_back(ImageItem{bar, std::make_shared<const Image>(std::move(image)), false});
  PathItem limits;
  limits.fill = theme.text;
  for (const double limit : {scale.low_db, scale.high_db()}) {
    const double x = plot.at(limit, 0.0).x;
    limits.parts.push_back({{{x, bar.y - 1}, {x - 5, bar.y + bar.height + 5}, {x + 5, bar.y + bar.height + 5}}, true});
  }
  frame.items.emplace_back(std::move(limits));
}

struct Drawn {
  PlotFrame plot;
  PixelRect bar;
  SvScale scale;
  std::vector<OpacityPoint> view;
  std::vector<OpacityPoint> growth;
  bool growth_edited = false;
  bool dark = false;
};

FrameDescription drawn(const Drawn& what, const std::vector<double>& bins, PixelSize size) {
  const Theme theme = what.dark ? dark_theme({640, 480}) : light_theme({640, 480});
  FrameDescription frame;
  frame.size = size;
  frame.background = theme.background;
  frame.title = "Transfer function";
  add_histogram(frame, what.plot, bins, theme);
  add_axes(frame, what.plot, theme);
  add_bar(frame, what.plot, what.bar, what.scale, theme);
  const auto& front = what.growth_edited ? what.growth : what.view;
  const auto& back = what.growth_edited ? what.view : what.growth;
  add_curve(frame, what.plot, back, theme.muted, false, theme);
  add_curve(frame, what.plot, front, theme.accent, true, theme);
  return frame;
}

}  // namespace

std::vector<double> sv_histogram(const Volume& volume, double first_db, int bins) {
  std::vector<double> counted(static_cast<std::size_t>(bins), 0.0);
  for (const std::int16_t count : volume.counts.all()) {
    if (count == kNoData) continue;
    const double at = std::floor(db_from_counts(count) - first_db);
    if (at >= 0.0 && at < bins) counted[static_cast<std::size_t>(at)] += 1.0;
  }
  const double most = std::log1p(*std::max_element(counted.begin(), counted.end()));
  for (double& bin : counted) bin = most > 0.0 ? std::log1p(bin) / most : 0.0;
  return counted;
}

TransferEditor::TransferEditor(Workspace& workspace) : LivePicture(workspace), workspace_(workspace) {
  const auto again = [this] { update(); };
  listening_.to(workspace.view_curve.changed(), again);
  listening_.to(workspace.growth_curve.changed(), again);
  listening_.to(workspace.dark.changed(), again);
  listening_.to(growth_shown_.changed(), again);
  listening_.to(workspace.display, again);
  listening_.to(workspace.document.changes(), [again](DocumentChange change) {
    if (change == DocumentChange::ping || change == DocumentChange::survey) again();
  });
}

std::vector<OpacityPoint> TransferEditor::points() const {
  return corners_of(growth_shown_() ? workspace_.growth_curve() : workspace_.view_curve());
}

PlotFrame TransferEditor::plot() const {
  PlotFrame plot;
  const double text_px = light_theme({640, 480}).text_px;
  plot.place = {4.6 * text_px, 8.0, std::max(20.0, units().width - 5.8 * text_px),
                std::max(20.0, units().height - 8.0 - 2 * kBar_px - 4.6 * text_px)};
  plot.x = {kFirst_db, kLast_db, "Sv (dB)", false};
  plot.y = {1.0, 0.0, "opacity", false};
  return plot;
}

PixelRect TransferEditor::bar() const {
  const PlotFrame frame = plot();
  return {frame.place.x, units().height - kBar_px - 8.0, frame.place.width, kBar_px};
}

PixelPoint TransferEditor::place_of(const OpacityPoint& point) const { return plot().at(point.sv_db, point.opacity); }

OpacityPoint TransferEditor::point_at(PixelPoint at) const {
  const PlotFrame frame = plot();
  return {std::clamp(frame.x_at(at.x), kFirst_db, kLast_db), std::clamp(frame.y_at(at.y), 0.0, 1.0)};
}

LivePicture::Build TransferEditor::build(const PictureLook& /*look*/) {
  Drawn what{plot(),
             bar(),
             workspace_.display.values().scale,
             corners_of(workspace_.view_curve()),
             corners_of(workspace_.growth_curve()),
             growth_shown_(),
             workspace_.dark()};
  const StagedPingPtr staged = workspace_.document.staged();
  return [what = std::move(what), staged, units = units(), scale = scale()](PixelSize, const CancelToken&,
                                                                            const Show& show) -> Result<void> {
    const auto bins = staged ? sv_histogram(*staged->filtered, kFirst_db, static_cast<int>(kLast_db - kFirst_db))
                             : std::vector<double>{};
    show({drawn(what, bins, units), std::nullopt, nullptr, scale});
    return {};
  };
}

void TransferEditor::set_points(const std::vector<OpacityPoint>& points) {
  if (growth_shown_()) {
    if (auto curve = growth_curve_of(points)) workspace_.growth_curve.set(std::move(*curve));
    return;
  }
  if (auto curve = curve_of(workspace_.display.values().scale, points)) {
    workspace_.curve_follows_scale.set(false);
    workspace_.view_curve.set(std::move(*curve));
  }
}

void TransferEditor::take_preset(std::string_view name) {
  set_points(preset_points(name, workspace_.display.values().scale));
}

std::optional<std::size_t> TransferEditor::corner_at(PixelPoint at) const {
  const auto all = points();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (distance_px(place_of(all[i]), at) <= kGrab_px) return i;
  }
  return std::nullopt;
}

void TransferEditor::press(const PointerEvent& event) {
  const PixelRect colour_bar = bar();
  const auto corner = corner_at(event.at);
  auto all = points();
  if (event.button == PointerButton::right) {
    if (!corner || all.size() <= 2) return;
    all.erase(all.begin() + static_cast<std::ptrdiff_t>(*corner));
    return set_points(all);
  }
  if (event.at.y >= colour_bar.y - 2) {
    const SvScale& scale = workspace_.display.values().scale;
    const double low_px = plot().at(scale.low_db, 0.0).x;
    const double high_px = plot().at(scale.high_db(), 0.0).x;
    grip_ = std::abs(event.at.x - low_px) < std::abs(event.at.x - high_px) ? Grip::low_limit : Grip::high_limit;
    return;
  }
  if (corner) {
    grip_ = Grip::corner;
    held_ = *corner;
  } else if (event.action == PointerAction::double_press) {
    all.push_back(point_at(event.at));
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.sv_db < b.sv_db; });
    set_points(all);
  }
}

void TransferEditor::drag(PixelPoint to) {
  OpacityPoint moved = point_at(to);
  if (grip_ == Grip::corner) {
    auto all = points();
    if (held_ >= all.size()) return;
    const double from = held_ == 0 ? kFirst_db : all[held_ - 1].sv_db + kApart_db;
    const double until = held_ + 1 == all.size() ? kLast_db : all[held_ + 1].sv_db - kApart_db;
    if (from < until) moved.sv_db = std::clamp(moved.sv_db, from, until);
    all[held_] = moved;
    return set_points(all);
  }
  DisplayParams params = workspace_.display.values();
  const double at_db = std::round(moved.sv_db);
  if (grip_ == Grip::low_limit) {
    const double high_db = params.scale.high_db();
    params.scale.low_db = std::min(at_db, high_db - kLeastSpan_db);
    params.scale.span_db = high_db - params.scale.low_db;
  } else {
    params.scale.span_db = std::max(kLeastSpan_db, at_db - params.scale.low_db);
  }
  if (validate(params)) workspace_.display.assign(params);
}

void TransferEditor::pointer(const PointerEvent& pointed) {
  PointerEvent event = pointed;
  event.at = in_frame(pointed.at);
  switch (event.action) {
    case PointerAction::press:
    case PointerAction::double_press:
      return press(event);
    case PointerAction::move:
      if (grip_ != Grip::none) drag(event.at);
      return;
    case PointerAction::release:
      grip_ = Grip::none;
      return;
    case PointerAction::wheel:
    case PointerAction::pan:
    case PointerAction::zoom:
    case PointerAction::leave:
      return;
  }
}

std::string TransferEditor::hint(PixelPoint pixel) const {
  const PixelPoint at = in_frame(pixel);
  if (at.y >= bar().y - 2) return "Display limits: drag the two marks";
  const OpacityPoint there = point_at(at);
  return fmt::format("{:.1f} dB, opacity {:.2f}\nDouble-click adds a corner, a right click takes one away", there.sv_db,
                     there.opacity);
}

}  // namespace sonar
