// SPDX-License-Identifier: Apache-2.0
#include "render/draw_frame.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <variant>

#include "render/cairo_values.h"
#include "render/frame_drawing.h"
#include "render/png_chunks.h"
#include "render/vector_files.h"

namespace sonar {
namespace {

constexpr int kMostPixels = 16384;        ///< a side
constexpr double kWebDotsPerInch = 96.0;  ///< of a pixel of SVG
constexpr double kPointsPerInch = 72.0;

Result<PixelSize> scaled_size(const FrameDescription& frame, double scale) {
  const double width = std::round(frame.size.width * scale);
  const double height = std::round(frame.size.height * scale);
  if (!std::isfinite(scale) || !(width >= 1.0) || !(height >= 1.0) || width > kMostPixels || height > kMostPixels) {
    return fail(ErrorCode::bad_parameter, fmt::format("a picture of {} x {} pixels times {}; expected 1 to {} a side",
                                                      frame.size.width, frame.size.height, scale, kMostPixels));
  }
  return PixelSize{static_cast<int>(width), static_cast<int>(height)};
}

Result<void> sound(cairo_status_t status) {
  if (status == CAIRO_STATUS_SUCCESS) return {};
  return fail(status == CAIRO_STATUS_NO_MEMORY ? ErrorCode::no_space : ErrorCode::io,
              fmt::format("the picture could not be drawn: {}", cairo_status_to_string(status)));
}

/// Appends to a std::string.
cairo_status_t append(void* text, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

Result<void> draw_page(cairo_surface_t* surface, const FrameDescription& frame, double units_per_pixel) {
  const CairoContext context(cairo_create(surface));
  cairo_scale(context.get(), units_per_pixel, units_per_pixel);
  draw_items(context.get(), frame, {units_per_pixel, true});
  cairo_show_page(context.get());
  return sound(cairo_status(context.get()));
}

/// Writes what is left; only then are the bytes all there.
Result<void> finish(cairo_surface_t* surface) {
  cairo_surface_finish(surface);
  return sound(cairo_surface_status(surface));
}

bool any_smooth(const FrameDescription& frame) {
  return std::any_of(frame.items.begin(), frame.items.end(), [](const auto& item) {
    const auto* image = std::get_if<ImageItem>(&item);
    return image != nullptr && image->smooth;
  });
}

/// For formats that have no fields of their own for it; empty without an origin.
std::string origin_sentence(const PictureOrigin& origin) {
  if (origin.program.empty()) return {};
  return fmt::format("Made by {}; recipe {}; data {}", origin.program, origin.recipe_hash, origin.data_time);
}

/// Of a file whose unit is so many to the inch: where the description has another, its size need not be whole.
struct VectorSize {
  double scale = 1.0;
  double width = 0.0;
  double height = 0.0;
};
VectorSize vector_size(const FrameDescription& frame, double units_per_inch, double scale) {
  const double times = scale * units_per_inch / frame.dots_per_inch;
  const auto pixels = [&](int side) { return std::round(side * scale) * units_per_inch / frame.dots_per_inch; };
  return {times, pixels(frame.size.width), pixels(frame.size.height)};
}

Result<std::string> svg_of(const FrameDescription& frame, double wanted_scale) {
  std::string bytes;
  const auto [scale, width, height] = vector_size(frame, kWebDotsPerInch, wanted_scale);
  CairoSurface surface(cairo_svg_surface_create_for_stream(append, &bytes, width, height));
  cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_PX);
  if (auto drawn = draw_page(surface.get(), frame, scale); !drawn) return pass_on(drawn);
  if (auto finished = finish(surface.get()); !finished) return pass_on(finished);
  const std::string named =
      searchable_svg(titled_svg(renumbered_svg(bytes), frame.title, origin_sentence(frame.origin)), frame, scale);
  return any_smooth(frame) ? named : pixelated_svg(named);
}

/// In small letters.
std::string picture_ending(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return ending;
}

}  // namespace

Result<Image> draw_frame(const FrameDescription& frame, double scale) {
  const auto size = scaled_size(frame, scale);
  if (!size) return pass_on(size);
  const CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, size->width, size->height));
  if (auto ok = sound(cairo_surface_status(surface.get())); !ok) return pass_on(ok);
  const CairoContext context(cairo_create(surface.get()));
  cairo_scale(context.get(), scale, scale);
  draw_items(context.get(), frame, {scale, false});
  if (auto ok = sound(cairo_status(context.get())); !ok) return pass_on(ok);
  return image_of(surface.get());
}

bool is_picture_file(const std::filesystem::path& file) {
  const std::string ending = picture_ending(file);
  return ending == ".png" || ending == ".svg" || ending == ".pdf";
}

Result<std::string> pdf_bytes(std::span<const FrameDescription> pages, double wanted_scale) {
  if (pages.empty()) return fail(ErrorCode::bad_parameter, "a PDF of no page; expected one at least");
  for (const FrameDescription& page : pages) {
    if (const auto size = scaled_size(page, wanted_scale); !size) return pass_on(size);
  }
  const FrameDescription& first = pages.front();
  std::string bytes;
  const CairoSurface surface(cairo_pdf_surface_create_for_stream(append, &bytes, 1.0, 1.0));
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, first.title.c_str());
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATOR, first.origin.program.c_str());
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_SUBJECT, origin_sentence(first.origin).c_str());
  for (const FrameDescription& page : pages) {
    const auto [scale, width, height] = vector_size(page, kPointsPerInch, wanted_scale);
    cairo_pdf_surface_set_size(surface.get(), width, height);
    if (auto drawn = draw_page(surface.get(), page, scale); !drawn) return pass_on(drawn);
  }
  if (auto finished = finish(surface.get()); !finished) return pass_on(finished);
  return undated_pdf(std::move(bytes));
}

Result<std::string> picture_bytes(const FrameDescription& frame, const std::filesystem::path& file, double scale) {
  const std::string ending = picture_ending(file);
  if (ending != ".png" && ending != ".svg" && ending != ".pdf") {
    return fail(ErrorCode::usage, fmt::format("'{}' is no kind of picture; expected .png, .svg or .pdf", ending),
                {file.string()});
  }
  const auto size = scaled_size(frame, scale);
  if (!size) return pass_on(size);
  if (ending == ".png") {
    const auto image = draw_frame(frame, scale);
    if (!image) return pass_on(image);
    auto png = png_bytes(*image);
    if (!png) return png;
    return described_png(*png, frame.dots_per_inch * scale,
                         {{"Title", frame.title},
                          {"Software", frame.origin.program},
                          {"Recipe", frame.origin.recipe_hash},
                          {"Data Time", frame.origin.data_time}});
  }
  return ending == ".svg" ? svg_of(frame, scale) : pdf_bytes({&frame, 1}, scale);
}

}  // namespace sonar
