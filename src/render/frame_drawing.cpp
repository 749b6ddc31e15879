// SPDX-License-Identifier: Apache-2.0
#include "render/frame_drawing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "render/cairo_values.h"

namespace sonar {
namespace {

constexpr double kFar = 1e5;              ///< beyond it coordinates are cut: Cairo's are 24 bits
constexpr double kReduced = 0.75;         ///< of an image's own size
constexpr std::size_t kFewPixels = 1024;  ///< drawn as rectangles in vector formats

void set_source(cairo_t* context, Rgba8 c) {
  cairo_set_source_rgba(context, c.r / 255.0, c.g / 255.0, c.b / 255.0, c.a / 255.0);
}

bool finite(const PixelRect& r) {
  return std::isfinite(r.x) && std::isfinite(r.y) && std::isfinite(r.width) && std::isfinite(r.height);
}

bool finite(const PathItem::Part& part) {
  return std::all_of(part.points.begin(), part.points.end(),
                     [](PixelPoint p) { return std::isfinite(p.x) && std::isfinite(p.y); });
}

/// Whether every piece of a part runs along a row or a column of pixels.
bool upright(const PathItem::Part& part) {
  const std::size_t n = part.points.size();
  for (std::size_t i = 0; i + (part.closed ? 0 : 1) < n; ++i) {
    const PixelPoint a = part.points[i];
    const PixelPoint b = part.points[(i + 1) % n];
    if (a.x != b.x && a.y != b.y) return false;
  }
  return n > 1;
}

/// The nearest place where a line of this width covers whole pixels.
double snapped(double value, double width, double scale) {
  const double pixels = std::max(1.0, std::round(width * scale));
  const double half = std::fmod(pixels, 2.0) == 1.0 ? 0.5 : 0.0;
  return (std::round(value * scale - half) + half) / scale;
}

void add_path(cairo_t* context, const PathItem& item, const FrameTarget& target) {
  cairo_new_path(context);
  for (const PathItem::Part& part : item.parts) {
    if (part.points.empty() || !finite(part)) continue;
    const bool snap = !target.vector && item.stroke.colour.a > 0 && upright(part);
    for (std::size_t i = 0; i < part.points.size(); ++i) {
      PixelPoint p = part.points[i];
      if (snap) {
        p = {snapped(p.x, item.stroke.width_px, target.scale), snapped(p.y, item.stroke.width_px, target.scale)};
      }
      p = {std::clamp(p.x, -kFar, kFar), std::clamp(p.y, -kFar, kFar)};
      i == 0 ? cairo_move_to(context, p.x, p.y) : cairo_line_to(context, p.x, p.y);
    }
    if (part.closed) cairo_close_path(context);
  }
}

bool sound(const std::vector<double>& dashes) {
  double sum = 0.0;
  for (const double d : dashes) {
    if (!(d >= 0.0) || !std::isfinite(d)) return false;
    sum += d;
  }
  return sum > 0.0;
}

void draw(cairo_t* context, const PathItem& item, const FrameTarget& target) {
  add_path(context, item, target);
  if (item.fill.a > 0) {
    set_source(context, item.fill);
    cairo_set_fill_rule(context, CAIRO_FILL_RULE_EVEN_ODD);
    cairo_fill_preserve(context);
  }
  if (item.stroke.colour.a > 0 && item.stroke.width_px > 0.0 && std::isfinite(item.stroke.width_px)) {
    set_source(context, item.stroke.colour);
    cairo_set_line_width(context, item.stroke.width_px);
    cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(context, CAIRO_LINE_CAP_BUTT);
    const bool dashed = sound(item.stroke.dashes_px);
    cairo_set_dash(context, dashed ? item.stroke.dashes_px.data() : nullptr,
                   dashed ? static_cast<int>(item.stroke.dashes_px.size()) : 0, 0.0);
    cairo_stroke_preserve(context);
  }
  cairo_new_path(context);
}

/// Viewers of SVG blur enlarged images whatever they are told; a few pixels are better drawn as what they are.
void draw_blocks(cairo_t* context, const ImageItem& item) {
  const Image& image = *item.image;
  const double w = item.place.width / image.size.width;
  const double h = item.place.height / image.size.height;
  cairo_set_antialias(context, CAIRO_ANTIALIAS_NONE);
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = 0; x < image.size.width; ++x) {
      const Rgba8 c = image.at(x, y);
      if (c.a == 0) continue;
      set_source(context, c);
      cairo_rectangle(context, item.place.x + x * w, item.place.y + y * h, w, h);
      cairo_fill(context);
    }
  }
  cairo_set_antialias(context, CAIRO_ANTIALIAS_DEFAULT);
}

void draw(cairo_t* context, const ImageItem& item, const FrameTarget& target) {
  if (item.image == nullptr || item.image->size.width <= 0 || item.image->size.height <= 0 ||
      item.image->pixels.size() != item.image->size.count() || !finite(item.place) || !(item.place.width > 0.0) ||
      !(item.place.height > 0.0)) {
    return;
  }
  if (target.vector && !item.smooth && item.image->size.count() <= kFewPixels) return draw_blocks(context, item);
  const CairoSurface surface = surface_of(*item.image);
  if (surface == nullptr) return;
  cairo_save(context);
  cairo_rectangle(context, item.place.x, item.place.y, item.place.width, item.place.height);
  cairo_clip(context);
  cairo_translate(context, item.place.x, item.place.y);
  cairo_scale(context, item.place.width / item.image->size.width, item.place.height / item.image->size.height);
  const CairoPattern pattern(cairo_pattern_create_for_surface(surface.get()));
  // Drawn much smaller than it is, each pixel is the mean of those that it stands for, not one of them.
  const bool reduced = !target.vector && target.scale * item.place.width < kReduced * item.image->size.width &&
                       target.scale * item.place.height < kReduced * item.image->size.height;
  cairo_pattern_set_filter(pattern.get(), item.smooth || reduced ? CAIRO_FILTER_GOOD : CAIRO_FILTER_NEAREST);
  // Without it a smooth image fades to nothing at its rim.
  cairo_pattern_set_extend(pattern.get(), target.vector ? CAIRO_EXTEND_NONE : CAIRO_EXTEND_PAD);
  cairo_set_source(context, pattern.get());
  cairo_paint(context);
  cairo_restore(context);
}

void draw(cairo_t* context, const TextItem& item, const FrameTarget&) { draw_text(context, item); }

void draw(cairo_t* context, const ClipItem& item, const FrameTarget&) {
  cairo_reset_clip(context);
  if (!(item.place.width > 0.0) || !(item.place.height > 0.0) || !finite(item.place)) return;
  cairo_rectangle(context, item.place.x, item.place.y, item.place.width, item.place.height);
  cairo_clip(context);
}

}  // namespace

void draw_items(cairo_t* context, const FrameDescription& frame, const FrameTarget& target) {
  set_source(context, frame.background);
  cairo_set_operator(context, CAIRO_OPERATOR_SOURCE);
  cairo_rectangle(context, 0.0, 0.0, frame.size.width, frame.size.height);
  cairo_fill(context);
  cairo_set_operator(context, CAIRO_OPERATOR_OVER);
  for (const auto& item : frame.items) {
    std::visit([&](const auto& i) { draw(context, i, target); }, item);
  }
  cairo_reset_clip(context);
}

}  // namespace sonar
