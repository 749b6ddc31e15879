// SPDX-License-Identifier: Apache-2.0
#include "view/slices/slice_key.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

#include "view/school_look.h"
#include "view/shapes.h"
#include "view/slices/slice_masks.h"

namespace sonar {
namespace {

constexpr int kFade = 178;  ///< of 255: the water's share in a faded sample

SampleFlags without(SampleFlags flags, SampleFlags some) {
  return static_cast<SampleFlags>(static_cast<unsigned>(flags) & ~static_cast<unsigned>(some));
}

enum class Look : std::uint8_t { hatched, faded, hidden };

/// As such samples look: a patch of the colour bar's middle and its neighbours.
void add_patch(FrameDescription& frame, const PixelRect& place, Look look, const SvColours& colours,
               const Theme& theme) {
  const PixelSize size{std::max(1, static_cast<int>(place.width)), std::max(1, static_cast<int>(place.height))};
  auto image = std::make_shared<Image>(size, theme.no_data);
  for (int y = 0; y < size.height && look != Look::hidden; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const auto at =
          colours.bar.size() * static_cast<std::size_t>(size.width + x) / static_cast<std::size_t>(3 * size.width);
      Rgba8 colour = colours.bar.empty() ? theme.water : colours.bar[at];
      if (look == Look::faded) colour = faded_colour(colour, theme);
      if (look == Look::hatched && on_hatch(x, y, theme)) colour = mixed(colour, theme.hatch, theme.hatch.a);
      image->at(x, y) = colour;
    }
  }
  const PixelRect drawn{place.x, place.y, static_cast<double>(size.width), static_cast<double>(size.height)};
  frame.items.emplace_back(ImageItem{drawn, std::move(image), false});
  frame.items.emplace_back(rectangle_item(drawn, {0, 0, 0, 0}, theme.axis, 0.5 * theme.line_px));
}

/// What a slice hides beside what noise removal takes out, which has words of its own.
SampleFlags unfiltered_hidden(const SliceStyle& style) {
  return style.key->filtered ? without(style.flags.hidden, kNotFiltered) : style.flags.hidden;
}

/// The schools that the slice cuts, and what core and fuzzy area are.
void add_schools(std::vector<KeyEntry>& out, const SliceStyle& style, const std::vector<bool>& cut,
                 const Theme& theme) {
  bool areas = false;
  for (const SliceKey::School& school : style.key->schools) {
    if (school.mask && (*school.mask >= cut.size() || !cut[*school.mask])) continue;
    areas = true;
    out.push_back(
        {school.name, [school, theme](FrameDescription& frame, const PixelRect& at) {
           const double middle = at.y + 0.5 * at.height;
           PathItem line = line_item({at.x, middle}, {at.x + at.width, middle}, school.colour, 2.0 * theme.line_px);
           line.stroke.dashes_px = line_dashes(school.line, theme);
           frame.items.emplace_back(std::move(line));
         }});
  }
  if (!areas) return;
  const std::string core = fmt::format("core, confidence {:g} and more", style.masks.core_at);
  if (!style.masks.tint) {
    out.push_back({core, [theme](FrameDescription& frame, const PixelRect& at) {
                     const double middle = at.y + 0.5 * at.height;
                     PathItem line = line_item({at.x, middle}, {at.x + at.width, middle}, theme.text, theme.line_px);
                     line.stroke.dashes_px = {theme.line_px, 3.0 * theme.line_px};
                     frame.items.emplace_back(std::move(line));
                   }});
    return;
  }
  // Any colour may be a school's: the key shows how much of it covers the data.
  const auto area = [&](double strength, std::string text) {
    const Rgba8 colour = mixed(theme.water, theme.text, static_cast<int>(std::lround(255.0 * strength)));
    out.push_back({std::move(text), [colour, theme](FrameDescription& frame, const PixelRect& at) {
                     frame.items.emplace_back(rectangle_item(at, colour, theme.axis, 0.5 * theme.line_px));
                   }});
  };
  area(style.masks.core_strength, core);
  area(style.masks.fuzzy_strength, "fuzzy area, below that");
}

}  // namespace

Rgba8 faded_colour(Rgba8 colour, const Theme& theme) { return mixed(colour, theme.water, kFade); }

bool on_hatch(int x, int y, const Theme& theme) {
  const int stripe = std::max(1, static_cast<int>(std::lround(theme.line_px)));
  return ((x + y) / stripe) % 6 == 0;
}

std::vector<bool> cut_masks(const SliceMap& map, const std::vector<MaskLayer>& masks) {
  std::vector<bool> out(masks.size(), false);
  if (masks.empty()) return out;
  const Sector& sector = map.sector();
  const auto samples = static_cast<std::size_t>(sector.range().count);
  std::vector<bool> shown(static_cast<std::size_t>(sector.fans()) * static_cast<std::size_t>(sector.beams()) * samples);
  for (const std::int32_t voxel : map.voxels()) {
    if (voxel >= 0) shown[static_cast<std::size_t>(voxel)] = true;
  }
  for (std::size_t i = 0; i < masks.size(); ++i) {
    if (masks[i].mask == nullptr) continue;
    out[i] = std::any_of(masks[i].mask->runs.begin(), masks[i].mask->runs.end(), [&](const Run& run) {
      const std::size_t row = static_cast<std::size_t>(run.row) * samples;
      for (int s = std::max(0, run.first_sample); s < run.end(); ++s) {
        const std::size_t voxel = row + static_cast<std::size_t>(s);
        if (voxel < shown.size() && shown[voxel]) return true;
      }
      return false;
    });
  }
  return out;
}

std::vector<KeyEntry> slice_key(const SliceStyle& style, const std::vector<bool>& cut, const Theme& theme) {
  std::vector<KeyEntry> out;
  if (!style.key) return out;
  const auto explain = [&](Look look, std::string text) {
    out.push_back(
        {std::move(text), [look, colours = style.colours, theme](FrameDescription& frame, const PixelRect& at) {
           add_patch(frame, at, look, colours, theme);
         }});
  };
  // A flag in several sets is hidden, else faded and hatched; weak samples have words of their own.
  struct Looking {
    Look look;
    const char* word;
    SampleFlags flags;
  };
  const SampleFlags hidden = style.flags.hidden;
  const std::array<Looking, 3> looks{{{Look::hatched, "hatched", without(style.flags.hatched, hidden)},
                                      {Look::faded, "faded", without(style.flags.faded, hidden)},
                                      {Look::hidden, "not drawn", unfiltered_hidden(style)}}};
  for (const auto& [look, word, flags] : looks) {
    const SampleFlags named = without(flags, SampleFlags::low_snr);
    if (any(named)) explain(look, fmt::format("{}: {}", word, flag_text(named)));
    if (style.key->weak_below_db && any(flags & SampleFlags::low_snr)) {
      explain(look, fmt::format("{}: below {:g} dB signal-to-noise", word, *style.key->weak_below_db));
    }
  }
  if (style.key->filtered) {
    const SampleFlags bounds = hidden & kNeverMember;
    explain(Look::hidden, any(bounds) ? "taken out: noise, " + flag_text(bounds) : "taken out: noise removed");
  }
  const std::size_t schools = out.size();
  add_schools(out, style, cut, theme);
  if (!style.masks.shown) {
    // The slice lies where it does with its schools.
    for (std::size_t k = schools; k < out.size(); ++k) out[k].draw = nullptr;
  }
  return out;
}

KeyEntry shadow_key(const Theme& theme) {
  return {"in the shadow of schools", [theme](FrameDescription& frame, const PixelRect& at) {
            const PixelSize size{std::max(1, static_cast<int>(at.width)), std::max(1, static_cast<int>(at.height))};
            auto image = std::make_shared<Image>(size, theme.water);
            for (int y = 0; y < size.height; ++y) {
              for (int x = 0; x < size.width; ++x) {
                if (on_hatch(x, size.height - 1 - y, theme))
                  image->at(x, y) = mixed(theme.water, theme.hatch, theme.hatch.a);
              }
            }
            frame.items.emplace_back(ImageItem{at, std::move(image), false});
          }};
}

}  // namespace sonar
