// SPDX-License-Identifier: Apache-2.0
#include "view/slices/slice_context.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <utility>

#include "base/units.h"
#include "geo/refraction.h"
#include "view/label_room.h"
#include "view/shapes.h"
#include "view/slices/plane_outline.h"
#include "view/slices/slice_geometry.h"

namespace sonar {
namespace {

constexpr int kArcSteps = 96;

/// A slice whose voxels lie on rings round the sonar: top, side and horizontal planes.
struct Fan {
  double first_rad = 0.0;  ///< of the sector, in the angle that runs along a ring
  double last_rad = 0.0;
  double far_m = 0.0;                                             ///< slant (top, side) or horizontal (planes)
  double shown = 1.0;                                             ///< slice coordinates per metre of range
  std::function<PixelPoint(double angle_rad, double length)> at;  ///< slice coordinates
};

/// Draws into a frame what is given in slice coordinates.
class Context {
 public:
  Context(FrameDescription& frame, const SliceMap& map, PixelPoint corner, const Theme& theme)
      : frame_(&frame), map_(&map), corner_(corner), theme_(&theme) {}

  /// The labels of all that was drawn before; none on another, none cut by the map's edge.
  void words() {
    LabelRoom room(
        {corner_.x, corner_.y, static_cast<double>(map_->size().width), static_cast<double>(map_->size().height)});
    for (TextItem& label : labels_) {
      const PixelPoint at = label.at;
      if (auto placed = room.place(std::move(label), std::span(&at, 1))) frame_->items.emplace_back(std::move(*placed));
    }
    labels_.clear();
  }

  [[nodiscard]] PixelPoint pixel(PixelPoint slice) const {
    const PixelPoint p = map_->pixel_of(slice.x, slice.y);
    return {p.x + corner_.x, p.y + corner_.y};
  }
  [[nodiscard]] double pixels_per_unit() const { return map_->size().width / (map_->extent().x1 - map_->extent().x0); }

  void outline(const Fan& fan) {
    std::vector<PixelPoint> points;
    for (int i = 0; i <= kArcSteps; ++i) points.push_back(arc_point(fan, i, fan.far_m));
    points.push_back(pixel({0.0, 0.0}));
    frame_->items.emplace_back(polyline_item(std::move(points), true, theme_->outline, theme_->line_px));
  }

  /// Lines in pixels of the map.
  void outline(const std::vector<ContourLine>& lines) {
    PathItem path;
    path.stroke = {theme_->outline, theme_->line_px, {}};
    for (const ContourLine& line : lines) {
      PathItem::Part part{line.points, line.closed};
      for (PixelPoint& p : part.points) p = {p.x + corner_.x, p.y + corner_.y};
      path.parts.push_back(std::move(part));
    }
    frame_->items.emplace_back(std::move(path));
  }

  void rings(const Fan& fan) {
    const double length_px = fan.far_m * fan.shown * pixels_per_unit();
    const Unit unit = theme_->units.length();
    const Ticks ticks =
        nice_ticks(0.0, unit.of(fan.far_m), std::clamp(static_cast<int>(length_px / (6.0 * em())), 1, 6));
    PathItem arcs;
    arcs.stroke = {theme_->ring, theme_->line_px, {2.0 * theme_->line_px, 3.0 * theme_->line_px}};
    for (const double tick : ticks.major) {
      if (!(tick > 0.0)) continue;
      const double range = tick * unit.si;
      PathItem::Part arc;
      for (int i = 0; i <= kArcSteps; ++i) arc.points.push_back(arc_point(fan, i, range));
      arcs.parts.push_back(std::move(arc));
      const double beside = 1.9 * em() / std::max(1.0, range * fan.shown * pixels_per_unit());
      label(pixel(fan.at(fan.last_rad + beside, range * fan.shown)),
            fmt::format("{} {}", tick_text(tick, ticks.decimals), unit.name));
    }
    frame_->items.emplace_back(std::move(arcs));
  }

  /// Rays at whole degrees of angle + offset, labelled beyond the far end.
  void rays(const Fan& fan, double offset_rad, bool bearings) {
    const double offset = deg_from_rad(offset_rad);
    const Ticks ticks = degree_ticks(deg_from_rad(fan.first_rad) + offset, deg_from_rad(fan.last_rad) + offset, 7);
    PathItem lines;
    lines.stroke = {theme_->ring, theme_->line_px, {2.0 * theme_->line_px, 3.0 * theme_->line_px}};
    const double beyond = fan.far_m * fan.shown + 1.3 * em() / pixels_per_unit();
    for (const double degrees : ticks.major) {
      const double angle = rad_from_deg(degrees - offset);
      lines.parts.push_back({{pixel(fan.at(angle, 0.0)), pixel(fan.at(angle, fan.far_m * fan.shown))}, false});
      label(pixel(fan.at(angle, beyond)), tick_text(bearings ? wrap_360(degrees) : degrees, ticks.decimals) + "\u00B0");
    }
    frame_->items.emplace_back(std::move(lines));
  }

  /// Along which way sound comes at these elevations, to where it is when straight paths end.
  void bent_rays(const Fan& fan, const Refraction& refraction) {
    const Ticks ticks = degree_ticks(deg_from_rad(fan.first_rad), deg_from_rad(fan.last_rad), 7);
    PathItem lines;
    lines.stroke = {theme_->track, theme_->line_px, {}};
    for (const double degrees : ticks.major) {
      PathItem::Part ray;
      for (int i = 0; i <= kArcSteps; ++i) {
        const double range_m = fan.far_m * i / kArcSteps;
        const Point<Sonar> at = refraction.bent(Sector::direction(rad_from_deg(degrees), 0.0) * range_m);
        ray.points.push_back(pixel({at.x, at.z}));
      }
      lines.parts.push_back(std::move(ray));
    }
    frame_->items.emplace_back(std::move(lines));
  }

  void surface(double y) {
    const SliceExtent& e = map_->extent();
    if (y < e.y0 || y > e.y1) return;
    frame_->items.emplace_back(line_item(pixel({e.x0, y}), pixel({e.x1, y}), theme_->track, 1.5 * theme_->line_px));
  }

  void ship(PixelPoint slice, double turned_rad) {
    frame_->items.emplace_back(
        ship_item(pixel(slice), 2.4 * em(), turned_rad, theme_->ship, theme_->halo, theme_->line_px));
  }

  void transducer(PixelPoint slice) {
    const PixelPoint p = pixel(slice);
    const double r = 0.35 * em();
    frame_->items.emplace_back(polyline_item({{p.x - r, p.y - r}, {p.x + r, p.y - r}, {p.x, p.y + r}}, true,
                                             theme_->halo, theme_->line_px, theme_->ship));
  }

  void north(double turned_rad) {
    const double x = corner_.x + map_->size().width - 2.2 * em();
    add_north_arrow(*frame_, {x, corner_.y + 2.6 * em()}, 1.9 * em(), turned_rad, theme_->ship, theme_->halo, em());
  }

 private:
  [[nodiscard]] double em() const { return theme_->text_px; }
  [[nodiscard]] PixelPoint arc_point(const Fan& fan, int step, double range) const {
    return pixel(fan.at(fan.first_rad + (fan.last_rad - fan.first_rad) * step / kArcSteps, range * fan.shown));
  }
  void label(PixelPoint at, std::string text) {
    TextItem item = text_item(at, std::move(text), small_text_px(*theme_, 0.9), theme_->muted, TextAnchor::centre);
    item.halo = theme_->halo;
    labels_.push_back(std::move(item));
  }

  FrameDescription* frame_;
  const SliceMap* map_;
  PixelPoint corner_;
  const Theme* theme_;
  std::vector<TextItem> labels_;  ///< drawn over all lines
};

double far_m(const Sector& sector) { return sector.range().range_m(sector.range().count - 0.5); }

Fan azimuth_fan(const Sector& sector, double up_rad, double far, double shown) {
  return {sector.azimuth_bounds(0).lower, sector.azimuth_bounds(sector.beams() - 1).upper, far, shown,
          [up_rad](double a, double length) {
            return PixelPoint{length * std::sin(a - up_rad), -length * std::cos(a - up_rad)};
          }};
}

Fan elevation_fan(const Sector& sector) {
  return {sector.elevation_bounds(0).lower, sector.elevation_bounds(sector.fans() - 1).upper, far_m(sector), 1.0,
          [](double e, double length) {
            return PixelPoint{length * std::cos(e), -length * std::sin(e)};
          }};
}

/// Else they start from the bow, which then points up.
bool true_bearings(const SlicePing& ping, const SliceStyle& style) {
  return style.north_up && std::isfinite(ping.heading_rad);
}

void add_seen_from_above(Context& context, const Fan& fan, const SliceView& view, const SlicePing& ping,
                         const SliceStyle& style, bool outlined) {
  if (style.rings) {
    context.rays(fan, true_bearings(ping, style) ? ping.heading_rad : 0.0, true);
    context.rings(fan);
    if (outlined) context.outline(fan);
    context.words();
  }
  context.ship({0.0, 0.0}, -view.up_rad);
  if (std::isfinite(ping.heading_rad)) context.north(-ping.heading_rad - view.up_rad);
}

void add_plane_context(Context& context, const SliceMap& map, const PlaneSlice& plane, const SlicePing& ping,
                       const SliceStyle& style) {
  if (style.rings) context.outline(plane_outline(map));
  if (plane.kind == PlaneSlice::Kind::vertical) {
    context.surface(-ping.transducer_depth_m - plane.origin.z);
    const double along = -(plane.origin.x * plane.right.x + plane.origin.y * plane.right.y);
    const double aside = plane.origin.x * plane.right.y - plane.origin.y * plane.right.x;
    if (std::abs(aside) < 1.0) context.transducer({along, -plane.origin.z});
  }
  if (plane.kind == PlaneSlice::Kind::horizontal) {
    const double r = far_m(map.sector());
    const double z = plane.origin.z;
    const Fan fan = azimuth_fan(map.sector(), map.view().up_rad, std::sqrt(std::max(0.0, r * r - z * z)), 1.0);
    add_seen_from_above(context, fan, map.view(), ping, style, false);
  }
}

std::string degrees(double rad, int decimals = 1) { return tick_text(deg_from_rad(rad), decimals) + "\u00B0"; }

/// What the bearings beside rings seen from above start from.
std::string bearings_text(const SlicePing& ping, const SliceStyle& style) {
  if (!style.rings) return {};
  return true_bearings(ping, style) ? "; true bearings" : "; bearings from the bow";
}

std::string plane_text(const PlaneSlice& plane, const SlicePing& ping, const SliceStyle& style, const Unit& unit) {
  const auto length = [&unit](double m) { return fmt::format("{} {}", tick_text(unit.of(m), 1), unit.name); };
  std::string depth = "depth " + length(plane.origin.z + ping.transducer_depth_m);
  if (ping.moved) depth += fmt::format(", {}", kStraightAndLevel);
  if (plane.kind == PlaneSlice::Kind::horizontal)
    return fmt::format("Horizontal plane, {}{}", depth, bearings_text(ping, style));
  if (plane.kind == PlaneSlice::Kind::vertical) {
    const double azimuth = std::atan2(plane.right.y, plane.right.x);
    if (!std::isfinite(ping.heading_rad)) {
      return fmt::format("Vertical plane, {:.1f}\u00B0 from the bow to the right", wrap_360(deg_from_rad(azimuth)));
    }
    return fmt::format("Vertical plane, true bearing {:.1f}\u00B0 to the right",
                       wrap_360(deg_from_rad(azimuth + ping.heading_rad)));
  }
  return fmt::format("Oblique plane through {} {}, {} to {}, {}", length(std::abs(plane.origin.x)),
                     plane.origin.x < 0.0 ? "astern" : "ahead", length(std::abs(plane.origin.y)),
                     plane.origin.y < 0.0 ? "port" : "starboard", depth);
}

}  // namespace

void add_slice_context(FrameDescription& frame, const SliceMap& map, PixelPoint corner, const SlicePing& ping,
                       const SliceStyle& style, const Theme& theme) {
  Context context(frame, map, corner, theme);
  const Sector& sector = map.sector();
  const SliceView& view = map.view();
  if (const auto* top = std::get_if<TopSlice>(&view.slice)) {
    const Fan fan = azimuth_fan(sector, view.up_rad, far_m(sector), std::cos(sector.elevation_rad(top->fan)));
    add_seen_from_above(context, fan, view, ping, style, true);
  } else if (std::holds_alternative<SideSlice>(view.slice)) {
    context.surface(-ping.transducer_depth_m);
    if (style.rings) {
      const Fan fan = elevation_fan(sector);
      context.rays(fan, 0.0, false);
      if (ping.rays) context.bent_rays(fan, *ping.rays);
      context.rings(fan);
      context.outline(fan);
      context.words();
    }
    context.transducer({0.0, 0.0});
  } else if (const auto* plane = std::get_if<PlaneSlice>(&view.slice)) {
    add_plane_context(context, map, *plane, ping, style);
  }
}

std::string slice_text(const Sector& sector, const SliceView& view, const SlicePing& ping, const SliceStyle& style,
                       const Units& units) {
  if (const auto* top = std::get_if<TopSlice>(&view.slice)) {
    std::string out = fmt::format("Top: fan {}, elevation {}", top->fan, degrees(sector.elevation_rad(top->fan)));
    if (ping.frequency_hz.size() == static_cast<std::size_t>(sector.fans())) {
      out += fmt::format(", {:.1f} kHz", ping.frequency_hz[static_cast<std::size_t>(top->fan)] / 1000.0);
    }
    return out + bearings_text(ping, style);
  }
  if (const auto* side = std::get_if<SideSlice>(&view.slice)) {
    const double azimuth = sector.azimuth_rad(side->beam);
    std::string out =
        fmt::format("Side: beam {}, {:.1f}\u00B0 from the bow", side->beam, wrap_360(deg_from_rad(azimuth)));
    if (std::isfinite(ping.heading_rad))
      out += fmt::format(", true bearing {:.1f}\u00B0", wrap_360(deg_from_rad(azimuth + ping.heading_rad)));
    return out;
  }
  if (const auto* range = std::get_if<RangeSlice>(&view.slice)) {
    return fmt::format("Constant range {}, sample {}",
                       quantity_text(sector.range().range_m(range->sample), 1, units.length()), range->sample);
  }
  return plane_text(std::get<PlaneSlice>(view.slice), ping, style, units.length());
}

}  // namespace sonar
