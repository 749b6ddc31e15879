// SPDX-License-Identifier: Apache-2.0
#include <pango/pangocairo.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/units.h"
#include "render/cairo_values.h"
#include "render/frame_drawing.h"

namespace sonar {
namespace {

/// Half of a capital's height in em: text is centred on its capitals, so that labels of one row share a base line.
constexpr double kHalfCapital = 0.3645;
constexpr double kHalo = 0.26;  ///< its line's width in em

struct PangoDelete {
  void operator()(PangoLayout* p) const { g_object_unref(p); }
  void operator()(PangoFontDescription* p) const { pango_font_description_free(p); }
};
using Layout = std::unique_ptr<PangoLayout, PangoDelete>;
using FontDescription = std::unique_ptr<PangoFontDescription, PangoDelete>;

void set_source(cairo_t* context, Rgba8 c) {
  cairo_set_source_rgba(context, c.r / 255.0, c.g / 255.0, c.b / 255.0, c.a / 255.0);
}

/// Shapes without hints: the same at every scale and in every format.
Layout layout_of(cairo_t* context, const TextItem& item) {
  const CairoFontOptions options(cairo_font_options_create());
  cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  Layout layout(pango_cairo_create_layout(context));
  pango_cairo_context_set_font_options(pango_layout_get_context(layout.get()), options.get());
  pango_cairo_context_set_resolution(pango_layout_get_context(layout.get()), 96.0);
  const FontDescription font(pango_font_description_new());
  pango_font_description_set_family(font.get(), "DejaVu Sans, Noto Sans, sans-serif");
  pango_font_description_set_weight(font.get(), item.bold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
  pango_font_description_set_absolute_size(font.get(), item.size_px * PANGO_SCALE);
  pango_layout_set_font_description(layout.get(), font.get());
  pango_layout_set_single_paragraph_mode(layout.get(), TRUE);
  char* valid = g_utf8_make_valid(item.text.data(), static_cast<gssize>(item.text.size()));
  pango_layout_set_text(layout.get(), valid, -1);
  g_free(valid);
  return layout;
}

}  // namespace

void draw_text(cairo_t* context, const TextItem& item) {
  const bool drawable = std::isfinite(item.at.x) && std::isfinite(item.at.y) && std::isfinite(item.turned_deg) &&
                        item.size_px > 0.0 && item.size_px < 4096.0 && !item.text.empty();
  if (!drawable) return;
  cairo_save(context);
  cairo_translate(context, std::clamp(item.at.x, -1e5, 1e5), std::clamp(item.at.y, -1e5, 1e5));
  cairo_rotate(context, rad_from_deg(item.turned_deg));
  const Layout layout = layout_of(context, item);
  int width = 0;
  pango_layout_get_size(layout.get(), &width, nullptr);
  const double share = item.anchor == TextAnchor::left ? 0.0 : item.anchor == TextAnchor::centre ? 0.5 : 1.0;
  const double baseline = static_cast<double>(pango_layout_get_baseline(layout.get())) / PANGO_SCALE;
  cairo_move_to(context, -share * width / PANGO_SCALE, kHalfCapital * item.size_px - baseline);
  if (item.halo.a > 0) {
    double x = 0.0;
    double y = 0.0;
    cairo_get_current_point(context, &x, &y);
    pango_cairo_layout_path(context, layout.get());
    set_source(context, item.halo);
    cairo_set_line_width(context, kHalo * item.size_px);
    cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
    cairo_set_dash(context, nullptr, 0, 0.0);
    cairo_stroke(context);
    cairo_move_to(context, x, y);
  }
  set_source(context, item.colour);
  pango_cairo_show_layout(context, layout.get());
  cairo_new_path(context);
  cairo_restore(context);
}

}  // namespace sonar
