// SPDX-License-Identifier: Apache-2.0
#include "render/vector_files.h"

#include <fmt/format.h>
#include <pango/pango.h>

#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string_view>
#include <variant>

namespace sonar {
namespace {

bool name_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_'; }

/// The name that starts at `i`.
std::string_view name_at(const std::string& text, std::size_t i) {
  std::size_t end = i;
  while (end < text.size() && name_character(text[end])) ++end;
  return std::string_view(text).substr(i, end - i);
}

std::map<std::string, std::string, std::less<>> new_names(const std::string& svg) {
  constexpr std::string_view kId = " id=\"";
  std::map<std::string, std::string, std::less<>> names;
  for (std::size_t i = svg.find(kId); i != std::string::npos; i = svg.find(kId, i + 1)) {
    const std::string_view old = name_at(svg, i + kId.size());
    if (!old.empty()) names.try_emplace(std::string(old), fmt::format("n{}", names.size() + 1));
  }
  return names;
}

std::string valid_utf8(const std::string& text) {
  char* valid = g_utf8_make_valid(text.data(), static_cast<gssize>(text.size()));
  std::string out(valid);
  g_free(valid);
  return out;
}

/// A text as XML holds it.
std::string escaped_xml(const std::string& text) {
  constexpr std::array<std::string_view, 2> kNoCharacter{"\xEF\xBF\xBE", "\xEF\xBF\xBF"};  // U+FFFE, U+FFFF
  std::string valid = valid_utf8(text);
  for (const std::string_view none : kNoCharacter) {
    for (auto at = valid.find(none); at != std::string::npos; at = valid.find(none, at)) {
      valid.replace(at, none.size(), "\xEF\xBF\xBD");
    }
  }
  std::string out;
  for (const char c : valid) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (static_cast<unsigned char>(c) >= 0x20U) {
      out += c;
    }
  }
  return out;
}

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

std::string renumbered_svg(const std::string& svg) {
  const auto names = new_names(svg);
  std::string out;
  out.reserve(svg.size());
  constexpr std::string_view kId = " id=\"";
  for (std::size_t i = 0; i < svg.size();) {
    const bool is_id = svg.compare(i, kId.size(), kId) == 0;
    const bool is_reference = svg[i] == '#' && i > 0 && (svg[i - 1] == '(' || svg[i - 1] == '"');
    if (!is_id && !is_reference) {
      out += svg[i++];
      continue;
    }
    const std::size_t skipped = is_id ? kId.size() : 1;
    const std::string_view old = name_at(svg, i + skipped);
    out.append(svg, i, skipped);
    const auto found = names.find(old);
    out += found != names.end() ? found->second : std::string(old);
    i += skipped + old.size();
  }
  return out;
}

std::string titled_svg(const std::string& svg, const std::string& title, const std::string& description) {
  const std::size_t root = svg.find("<svg");
  const std::size_t end = root == std::string::npos ? root : svg.find('>', root);
  if (title.empty() || end == std::string::npos) return svg;
  const std::string desc = description.empty() ? "" : "\n<desc>" + escaped_xml(description) + "</desc>";
  return svg.substr(0, end + 1) + "\n<title>" + escaped_xml(title) + "</title>" + desc + svg.substr(end + 1);
}

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

std::string pixelated_svg(const std::string& svg) {
  constexpr std::string_view kImage = "<image ";
  std::string out;
  std::size_t from = 0;
  for (std::size_t i = svg.find(kImage); i != std::string::npos; i = svg.find(kImage, from)) {
    out.append(svg, from, i + kImage.size() - from);
    out += "style=\"image-rendering:pixelated\" ";
    from = i + kImage.size();
  }
  return out.append(svg, from, std::string::npos);
}

std::string undated_pdf(std::string pdf) {
  constexpr std::string_view kDate = "/CreationDate (D:";
  const std::size_t at = pdf.rfind(kDate);
  if (at == std::string::npos) return pdf;
  constexpr std::string_view kFixed = "19700101000000";
  for (std::size_t i = 0; i < kFixed.size() && at + kDate.size() + i < pdf.size(); ++i) {
    char& c = pdf[at + kDate.size() + i];
    if (std::isdigit(static_cast<unsigned char>(c)) == 0) break;
    c = kFixed[i];
  }
  return pdf;
}

}  // namespace sonar
