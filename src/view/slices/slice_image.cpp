// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

#include "base/units.h"
#include "view/slices/slice_key.h"
#include "view/slices/slice_masks.h"
#include "view/slices/slice_picture.h"

namespace sonar {
namespace {

constexpr std::size_t kCounts = 65536;

/// Opaque colours by count: what is not shown becomes water, translucent colours lie over it. A second table for faded
/// samples follows where there are any.
std::vector<Rgba8> colour_table(const SvColours& colours, bool faded, const Theme& theme) {
  std::vector<Rgba8> out((faded ? 2 : 1) * kCounts);
  std::transform(colours.by_count.begin(), colours.by_count.end(), out.begin(), [&](Rgba8 c) {
    return c.a == 255 ? c : c.a == 0 ? theme.water : mixed(theme.water, c, c.a);
  });
  if (colours.by_count[0].a == 0) out[0] = theme.no_data;
  if (!faded) return out;
  // Neighbouring counts mostly share a colour.
  for (std::size_t i = 0; i < kCounts; ++i) {
    const bool same = i > 0 && out[i] == out[i - 1];
    out[kCounts + i] = same ? out[kCounts + i - 1] : faded_colour(out[i], theme);
  }
  return out;
}

void colour_samples(Image& image, const SliceMap& map, const SliceData& data, const std::vector<Rgba8>& table) {
  const std::vector<std::int32_t>& voxels = map.voxels();
  const std::int16_t* sv = data.sv.data();
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    if (voxels[i] >= 0) image.pixels[i] = table[static_cast<std::size_t>(sv[voxels[i]] + 32768)];
  }
}

/// What is done with a sample that has some flags.
struct FlagActs {
  std::size_t table = 0;  ///< where its colours begin
  bool hidden = false;
  bool hatched = false;
};

void colour_flagged_samples(Image& image, const SliceMap& map, const SliceData& data, const FlagStyle& style,
                            const std::vector<Rgba8>& table, const Theme& theme) {
  std::array<FlagActs, 256> acts;
  for (std::size_t i = 0; i < acts.size(); ++i) {
    const auto f = static_cast<SampleFlags>(i);
    acts[i] = {any(f & style.faded) ? kCounts : 0, any(f & style.hidden), any(f & style.hatched)};
  }
  const std::vector<std::int32_t>& voxels = map.voxels();
  const std::int16_t* sv = data.sv.data();
  const SampleFlags* flags = data.flags.data();
  std::size_t i = 0;
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = 0; x < image.size.width; ++x, ++i) {
      const std::int32_t voxel = voxels[i];
      if (voxel < 0) continue;
      const FlagActs& act = acts[static_cast<std::size_t>(flags[voxel])];
      Rgba8 colour = table[act.table + static_cast<std::size_t>(sv[voxel] + 32768)];
      if (act.hidden) {
        colour = theme.no_data;
      } else if (act.hatched && on_hatch(x, y, theme)) {
        colour = mixed(colour, theme.hatch, theme.hatch.a);
      }
      image.pixels[i] = colour;
    }
  }
}

/// Stripes that rise to the other side than those of faulty samples.
void hatch_shadow(Image& image, const SliceMap& map, const std::vector<int>& from, const Theme& theme) {
  const std::vector<std::int32_t>& voxels = map.voxels();
  const int samples = map.sector().range().count;
  std::size_t i = 0;
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = 0; x < image.size.width; ++x, ++i) {
      if (voxels[i] < 0 || !on_hatch(x, image.size.height - 1 - y, theme)) continue;
      if (voxels[i] % samples < from[static_cast<std::size_t>(voxels[i] / samples)]) continue;
      image.pixels[i] = mixed(image.pixels[i], theme.hatch, theme.hatch.a);
    }
  }
}

}  // namespace

Result<Image> slice_image(const SliceMap& map, const SliceData& data, const SvColours& colours, const FlagStyle& flags,
                          const SliceMaskStyle& masks, const Theme& theme) {
  const Sector& sector = map.sector();
  const Shape3 shape{sector.fans(), sector.beams(), sector.range().count};
  if (data.sv.shape() != shape || colours.by_count.size() != kCounts) {
    const Shape3 s = data.sv.shape();
    return fail(ErrorCode::mismatch, fmt::format("the ping has {} x {} x {} samples; the slice's grid has {} x {} x {}",
                                                 s.fans, s.beams, s.samples, shape.fans, shape.beams, shape.samples));
  }
  const bool flagged = any(flags.hidden | flags.faded | flags.hatched) && data.flags.shape() == shape;
  const std::vector<Rgba8> table = colour_table(colours, flagged && any(flags.faded), theme);
  Image image(map.size(), Rgba8{0, 0, 0, 0});
  if (flagged) {
    colour_flagged_samples(image, map, data, flags, table, theme);
  } else {
    colour_samples(image, map, data, table);
  }
  if (data.shadow_from.size() == shape.rows()) hatch_shadow(image, map, data.shadow_from, theme);
  if (!masks.shown) return image;
  if (auto ok = blend_masks(image, map, data.masks, masks, theme); !ok) return pass_on(ok);
  return image;
}

std::string flag_text(SampleFlags flags) {
  static constexpr std::array<std::pair<SampleFlags, std::string_view>, 8> kNames = {
      {{SampleFlags::near_field, "near field"},
       {SampleFlags::surface, "surface"},
       {SampleFlags::corrupted, "corrupted packets"},
       {SampleFlags::dropout, "dropout"},
       {SampleFlags::interference, "interference"},
       {SampleFlags::impulse, "impulse noise"},
       {SampleFlags::seabed, "seabed"},
       {SampleFlags::low_snr, "low signal"}}};
  std::string out;
  for (const auto& [flag, text] : kNames) {
    if (!any(flags & flag)) continue;
    if (!out.empty()) out += ", ";
    out += text;
  }
  return out;
}

}  // namespace sonar
