// SPDX-License-Identifier: Apache-2.0
#include "view/slice_key.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

#include "view/school_look.h"
#include "view/shapes.h"
#include "view/slice_masks.h"

namespace sonar {
namespace {

constexpr int kFade = 178;        ///< of 255: the water's share in a faded sample
constexpr double kText_em = 0.9;  ///< of the theme's text
constexpr double kSwatch_em = 1.7;
constexpr double kBeside_em = 0.5;  ///< between a swatch and its words
constexpr double kBetween_em = 1.5;

SampleFlags without(SampleFlags flags, SampleFlags some) {
  return static_cast<SampleFlags>(static_cast<unsigned>(flags) & ~static_cast<unsigned>(some));
}

double width_of(const SliceKeyEntry& entry, const Theme& theme) {
  return (kSwatch_em + kBeside_em) * theme.text_px + text_width_px(entry.text.c_str(), kText_em * theme.text_px);
}

/// Where each entry begins: line and x, px.
std::vector<std::pair<int, double>> places(const std::vector<SliceKeyEntry>& entries, double width_px,
                                           const Theme& theme) {
  std::vector<std::pair<int, double>> out;
  int line = 0;
  double x = 0.0;
  for (const SliceKeyEntry& entry : entries) {
    const double width = width_of(entry, theme);
    if (x > 0.0 && x + width > width_px) {
      ++line;
      x = 0.0;
    }
    out.emplace_back(line, x);
    x += width + kBetween_em * theme.text_px;
  }
  return out;
}

/// As such samples look: a patch of the colour bar's middle and its neighbours.
ImageItem patch(const PixelRect& place, SliceKeyEntry::Look look, const SvColours& colours, const Theme& theme) {
  const PixelSize size{std::max(1, static_cast<int>(place.width)), std::max(1, static_cast<int>(place.height))};
  auto image = std::make_shared<Image>(size, theme.no_data);
  for (int y = 0; y < size.height && look != SliceKeyEntry::Look::hidden; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const auto at =
          colours.bar.size() * static_cast<std::size_t>(size.width + x) / static_cast<std::size_t>(3 * size.width);
      Rgba8 colour = colours.bar.empty() ? theme.water : colours.bar[at];
      if (look == SliceKeyEntry::Look::faded) colour = faded_colour(colour, theme);
      if (look == SliceKeyEntry::Look::hatched && on_hatch(x, y, theme)) {
        colour = mixed(colour, theme.hatch, theme.hatch.a);
      }
      image->pixels[image->index(x, y)] = colour;
    }
  }
  return {
      {place.x, place.y, static_cast<double>(size.width), static_cast<double>(size.height)}, std::move(image), false};
}

}  // namespace

Rgba8 faded_colour(Rgba8 colour, const Theme& theme) { return mixed(colour, theme.water, kFade); }

bool on_hatch(int x, int y, const Theme& theme) {
  const int stripe = std::max(1, static_cast<int>(std::lround(theme.line_px)));
  return ((x + y) / stripe) % 6 == 0;
}

std::vector<SliceKeyEntry> slice_key(const SliceStyle& style) {
  std::vector<SliceKeyEntry> out;
  if (!style.key) return out;
  using Look = SliceKeyEntry::Look;
  // A flag in several sets is hidden, else faded and hatched; weak samples have words of their own.
  const SampleFlags hidden = style.flags.hidden;
  struct Looking {
    Look look;
    const char* word;
    SampleFlags flags;
  };
  const std::array<Looking, 3> looks{{{Look::hatched, "hatched", without(style.flags.hatched, hidden)},
                                      {Look::faded, "faded", without(style.flags.faded, hidden)},
                                      {Look::hidden, "not drawn", hidden}}};
  for (const auto& [look, word, flags] : looks) {
    const SampleFlags named = without(flags, SampleFlags::low_snr);
    if (any(named)) out.push_back({look, fmt::format("{}: {}", word, flag_text(named)), {}});
    if (style.key->weak_below_db && any(flags & SampleFlags::low_snr)) {
      out.push_back({look, fmt::format("{}: below {:g} dB signal-to-noise", word, *style.key->weak_below_db), {}});
    }
  }
  if (style.key->filtered) out.push_back({Look::hidden, "taken out: noise removed", {}});
  for (const SliceKey::School& school : style.key->schools) {
    out.push_back({Look::outline, school.name, school.colour, school.line});
  }
  return out;
}

int slice_key_lines(const std::vector<SliceKeyEntry>& entries, double width_px, const Theme& theme) {
  return entries.empty() ? 0 : places(entries, width_px, theme).back().first + 1;
}

void add_slice_key(FrameDescription& frame, const PixelRect& place, const std::vector<SliceKeyEntry>& entries,
                   const SvColours& colours, const Theme& theme) {
  const double em = theme.text_px;
  const auto at = places(entries, place.width, theme);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const SliceKeyEntry& entry = entries[i];
    const double x = place.x + at[i].second;
    const double middle = place.y + (at[i].first + 0.5) * kFootLine_em * em;
    const PixelRect swatch{std::round(x), std::round(middle - 0.5 * em), std::round(kSwatch_em * em), std::round(em)};
    if (entry.look == SliceKeyEntry::Look::outline) {
      PathItem line =
          line_item({swatch.x, middle}, {swatch.x + swatch.width, middle}, entry.colour, 2.0 * theme.line_px);
      line.stroke.dashes_px = line_dashes(entry.line, theme);
      frame.items.emplace_back(std::move(line));
    } else {
      frame.items.emplace_back(patch(swatch, entry.look, colours, theme));
      frame.items.emplace_back(rectangle_item(swatch, {0, 0, 0, 0}, theme.axis, 0.5 * theme.line_px));
    }
    const double words = swatch.x + (kSwatch_em + kBeside_em) * em;
    frame.items.emplace_back(text_item(
        {words, middle}, elided(entry.text, kText_em * em, place.x + place.width - words), kText_em * em, theme.text));
  }
}

}  // namespace sonar
