// SPDX-License-Identifier: Apache-2.0
#include "view/theme.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace sonar {
namespace {

/// Text grows slower than the picture: 10.5 px at 640 x 480, 17 at 1920 x 1080, 26 at 3840 x 2160.
void size_for(Theme& theme, PixelSize size) {
  const double growth = std::min(size.width / 640.0, size.height / 480.0);
  const double factor = std::pow(std::max(growth, 0.6), 0.6);
  theme.text_px = std::round(2.0 * 10.5 * factor) / 2.0;
  theme.title_px = std::round(2.0 * 12.5 * factor) / 2.0;
  theme.line_px = std::max(1.0, std::round(factor));
}

/// Advance of one character in em, DejaVu Sans, rounded up by class.
double advance(unsigned char c) {
  if (c >= '0' && c <= '9') return 0.636;
  if (c == ' ' || c == '.' || c == ',' || c == ':' || c == 'i' || c == 'l' || c == 'j' || c == '-') return 0.36;
  if (c == 'm' || c == 'w' || c == 'M' || c == 'W' || c == '@') return 0.98;
  if (c >= 'A' && c <= 'Z') return 0.70;
  return 0.62;
}

}  // namespace

Theme light_theme(PixelSize size) {
  Theme t;
  t.background = {255, 255, 255, 255};
  t.plot = {238, 241, 244, 255};
  t.water = {255, 255, 255, 255};
  t.no_data = {214, 219, 224, 255};
  t.text = {28, 33, 40, 255};
  t.muted = {92, 101, 112, 255};
  t.axis = {70, 78, 88, 255};
  t.grid = {60, 70, 80, 46};
  t.ring = {60, 72, 86, 110};
  t.outline = {60, 72, 86, 190};
  t.ship = {40, 52, 70, 255};
  t.hatch = {60, 60, 60, 170};
  t.halo = {255, 255, 255, 205};
  t.land = {222, 214, 196, 255};
  t.track = {45, 70, 110, 255};
  t.accent = {213, 94, 0, 255};
  size_for(t, size);
  return t;
}

Theme dark_theme(PixelSize size) {
  Theme t;
  t.background = {22, 26, 32, 255};
  t.plot = {32, 38, 46, 255};
  t.water = {8, 12, 20, 255};
  t.no_data = {58, 64, 72, 255};
  t.text = {226, 231, 237, 255};
  t.muted = {152, 162, 174, 255};
  t.axis = {140, 150, 162, 255};
  t.grid = {200, 210, 220, 40};
  t.ring = {190, 202, 216, 105};
  t.outline = {190, 202, 216, 190};
  t.ship = {222, 229, 238, 255};
  t.hatch = {205, 205, 205, 170};
  t.halo = {12, 16, 22, 205};
  t.land = {74, 70, 58, 255};
  t.track = {140, 175, 225, 255};
  t.accent = {255, 153, 51, 255};
  size_for(t, size);
  return t;
}

Theme panel_theme(const PanelLook& look, bool dark) {
  Theme theme = dark ? dark_theme({640, 480}) : light_theme({640, 480});
  theme.text_px = theme.title_px = look.text_px;
  theme.line_px = look.line_px;
  theme.titles = look.titles;
  theme.bars = false;
  return theme;
}

Theme with_text(Theme theme, double least_px) {
  constexpr double kTitle = 1.15;
  theme.text_px = std::max(theme.text_px, least_px);
  theme.title_px = std::max(theme.title_px, kTitle * least_px);
  theme.least_text_px = static_cast<float>(least_px);
  return theme;
}

Rgba8 school_colour(int number) {
  // Each as far as may be from the others as all kinds of eyes see them, from the backgrounds, from the grey of rejected
  // schools and from every colour of every palette; in the order that sets numbers one and two apart, and twelve
  // apart, farthest from each other, the dull ones last. A number alone tells its colour: chosen for
  // what happens to be in a picture, it would change from ping to ping and from view to view.
  static constexpr std::array<Rgba8, kSchoolColours> kColours = {
      {{42, 157, 211, 255},  {206, 64, 124, 255},  {45, 215, 0, 255},    {134, 12, 255, 255},  {248, 189, 185, 255},
       {106, 0, 44, 255},    {126, 129, 0, 255},   {163, 45, 143, 255},  {230, 104, 158, 255}, {154, 158, 47, 255},
       {88, 29, 201, 255},   {42, 250, 18, 255},   {143, 4, 4, 255},     {8, 115, 195, 255},   {82, 0, 150, 255},
       {177, 174, 255, 255}, {81, 110, 71, 255},   {229, 155, 141, 255}, {177, 255, 162, 255}, {144, 112, 255, 255},
       {112, 59, 88, 255},   {214, 204, 255, 255}, {41, 0, 82, 255},     {71, 0, 0, 255}}};
  const int n = static_cast<int>(kColours.size());
  return kColours[static_cast<std::size_t>(((number % n) + n) % n)];
}

namespace {
constexpr const char* kEllipsis = "\u2026";
}  // namespace

std::string elided_line(const std::string& text, double size_px, double width_px) {
  if (text_width_px(text.c_str(), size_px) <= width_px) return text;
  for (const bool parts : {true, false}) {
    for (std::size_t end = text.size(); end-- > 1;) {
      if (text[end] != ' ' || (parts && text[end - 1] != ',' && text[end - 1] != ';')) continue;
      std::string begin = text.substr(0, end);
      begin.erase(begin.find_last_not_of(" ,;:") + 1);
      begin += kEllipsis;
      if (begin != kEllipsis && text_width_px(begin.c_str(), size_px) <= width_px) return begin;
    }
  }
  return {};
}

std::string elided(std::string text, double size_px, double width_px) {
  if (text_width_px(text.c_str(), size_px) <= width_px) return text;
  const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
  while (!text.empty()) {
    while (continues(text.back()) && text.size() > 1) text.pop_back();
    text.pop_back();
    while (text.ends_with(' ')) text.pop_back();
    if (text.empty()) break;
    if (text_width_px((text + kEllipsis).c_str(), size_px) <= width_px) return text + kEllipsis;
  }
  return {};
}

double text_width_px(const char* utf8, double size_px) {
  double width = 0.0;
  for (; utf8 != nullptr && *utf8 != '\0'; ++utf8) {
    const auto c = static_cast<unsigned char>(*utf8);
    if ((c & 0xC0U) != 0x80U) width += advance(c);
  }
  return width * size_px;
}

}  // namespace sonar
