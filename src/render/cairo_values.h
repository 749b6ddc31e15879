// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cairo.h>

#include <memory>

#include "view/image.h"

namespace sonar {

struct CairoDelete {
  void operator()(cairo_surface_t* p) const { cairo_surface_destroy(p); }
  void operator()(cairo_t* p) const { cairo_destroy(p); }
  void operator()(cairo_pattern_t* p) const { cairo_pattern_destroy(p); }
  void operator()(cairo_font_options_t* p) const { cairo_font_options_destroy(p); }
};
using CairoSurface = std::unique_ptr<cairo_surface_t, CairoDelete>;
using CairoContext = std::unique_ptr<cairo_t, CairoDelete>;
using CairoPattern = std::unique_ptr<cairo_pattern_t, CairoDelete>;
using CairoFontOptions = std::unique_ptr<cairo_font_options_t, CairoDelete>;

/// A copy with premultiplied alpha; ARGB32, or RGB24 where every pixel is opaque. Null where memory is short.
[[nodiscard]] CairoSurface surface_of(const Image& image);
/// A copy with straight alpha, of an ARGB32 or RGB24 surface.
[[nodiscard]] Image image_of(cairo_surface_t* surface);

}  // namespace sonar
