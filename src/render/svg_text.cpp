// SPDX-License-Identifier: Apache-2.0
#include "render/svg_text.h"

#include <fmt/format.h>
#include <pango/pangocairo.h>

#include <cmath>
#include <optional>
#include <variant>

#include "render/svg_names.h"

namespace sonar {
namespace {

/// Half of a capital's height in em, as letters are drawn: SVG places text by its base line.
constexpr double kHalfCapital = 0.3645;

bool drawable(const TextItem& t) {
  return std::isfinite(t.at.x) && std::isfinite(t.at.y) && std::isfinite(t.turned_deg) && t.size_px > 0.0 &&
         t.size_px < 4096.0 && !t.text.empty();
}

std::string element(const TextItem& t) {
  const char* anchor = t.anchor == TextAnchor::left ? "start" : t.anchor == TextAnchor::centre ? "middle" : "end";
  const std::string turned =
      t.turned_deg != 0.0 ? fmt::format(" transform=\"rotate({:.6g} {:.6g} {:.6g})\"", t.turned_deg, t.at.x, t.at.y)
                          : "";
  return fmt::format("<text x=\"{:.6g}\" y=\"{:.6g}\" font-size=\"{:.6g}\" text-anchor=\"{}\"{}>{}</text>\n", t.at.x,
                     t.at.y + kHalfCapital * t.size_px, t.size_px, anchor, turned, escaped_xml(t.text));
}

}  // namespace

std::string searchable_svg(const std::string& svg, const FrameDescription& frame, double scale) {
  const std::size_t end = svg.rfind("</svg>");
  if (end == std::string::npos) return svg;
  std::string words;
  std::optional<PixelRect> clip;
  for (const auto& item : frame.items) {
    if (const auto* cut = std::get_if<ClipItem>(&item)) {
      clip.reset();
      if (cut->place.width > 0.0 && cut->place.height > 0.0) clip = cut->place;
    }
    const auto* text = std::get_if<TextItem>(&item);
    if (text != nullptr && drawable(*text) && (!clip || inside(*clip, text->at))) words += element(*text);
  }
  if (words.empty()) return svg;
  return svg.substr(0, end) +
         fmt::format("<g transform=\"scale({:.6g})\" fill-opacity=\"0\" font-family=\"DejaVu Sans, sans-serif\">\n",
                     scale) +
         words + "</g>\n" + svg.substr(end);
}

}  // namespace sonar
