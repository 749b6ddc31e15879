// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

#include "base/units.h"
#include "view/slice_picture.h"

namespace sonar {
namespace {

constexpr int kFade = 178;  ///< of 255: the water's share in a faded sample

int weight_of(double share) { return static_cast<int>(std::lround(255.0 * std::clamp(share, 0.0, 1.0))); }

/// `weight_of_b` of 255.
std::uint8_t mixed(std::uint8_t a, std::uint8_t b, int weight_of_b) {
  return static_cast<std::uint8_t>((a * (255 - weight_of_b) + b * weight_of_b + 127) / 255);
}

Rgba8 mixed(Rgba8 a, Rgba8 b, int weight_of_b) {
  return {mixed(a.r, b.r, weight_of_b), mixed(a.g, b.g, weight_of_b), mixed(a.b, b.b, weight_of_b), 255};
}

/// Opaque colours by count: what is not shown becomes water, translucent colours lie over it.
std::vector<Rgba8> over_water(const SvColours& colours, const Theme& theme) {
  std::vector<Rgba8> out(colours.by_count.size());
  std::transform(colours.by_count.begin(), colours.by_count.end(), out.begin(), [&](Rgba8 c) {
    return c.a == 255 ? c : c.a == 0 ? theme.water : mixed(theme.water, c, c.a);
  });
  if (colours.by_count[0].a == 0) out[0] = theme.no_data;
  return out;
}

/// [voxel]: 0 = in no mask, else (layer + 1) * 256 + confidence.
using Overlay = std::vector<std::uint32_t>;

Result<void> check_mask(const PingMask& mask, const Shape3& shape) {
  std::size_t voxels = 0;
  for (const Run& run : mask.runs) {
    if (run.row < 0 || static_cast<std::size_t>(run.row) >= shape.rows() || run.first_sample < 0 || run.count < 0 ||
        run.count > shape.samples - run.first_sample) {
      return fail(
          ErrorCode::mismatch,
          fmt::format("a mask has samples {} to {} of row {}; the grid has {} rows of {} samples", run.first_sample,
                      run.first_sample + std::int64_t{run.count}, run.row, shape.rows(), shape.samples));
    }
    voxels += static_cast<std::size_t>(run.count);
  }
  if (voxels == mask.confidence.size()) return {};
  return fail(ErrorCode::mismatch,
              fmt::format("a mask has {} voxels and {} confidences", voxels, mask.confidence.size()));
}

Result<Overlay> overlay_of(const std::vector<MaskLayer>& masks, const Shape3& shape) {
  Overlay out;
  for (std::size_t layer = 0; layer < masks.size(); ++layer) {
    if (masks[layer].mask == nullptr || masks[layer].mask->empty()) continue;
    const PingMask& mask = *masks[layer].mask;
    if (auto ok = check_mask(mask, shape); !ok) return pass_on(ok);
    out.resize(shape.size(), 0);
    std::size_t next = 0;
    for (const Run& run : mask.runs) {
      const std::size_t first = static_cast<std::size_t>(run.row) * static_cast<std::size_t>(shape.samples) +
                                static_cast<std::size_t>(run.first_sample);
      for (std::size_t i = 0; i < static_cast<std::size_t>(run.count); ++i, ++next) {
        if (mask.confidence[next] > 0)
          out[first + i] = static_cast<std::uint32_t>((layer + 1) * 256) + mask.confidence[next];
      }
    }
  }
  return out;
}

void colour_flags(Image& image, const SliceMap& map, const SliceData& data, const FlagStyle& style,
                  const Theme& theme) {
  if (!any(style.hidden | style.faded | style.hatched) || data.flags.shape() != data.sv.shape()) return;
  const auto flags = data.flags.all();
  const int stripe = std::max(1, static_cast<int>(std::lround(theme.line_px)));
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = 0; x < image.size.width; ++x) {
      const std::size_t i = image.index(x, y);
      const std::int32_t voxel = map.voxels()[i];
      if (voxel < 0) continue;
      const SampleFlags f = flags[static_cast<std::size_t>(voxel)];
      if (any(f & style.hidden)) {
        image.pixels[i] = theme.no_data;
        continue;
      }
      if (any(f & style.faded)) image.pixels[i] = mixed(image.pixels[i], theme.water, kFade);
      if (any(f & style.hatched) && ((x + y) / stripe) % 6 == 0) {
        image.pixels[i] = mixed(image.pixels[i], theme.hatch, theme.hatch.a);
      }
    }
  }
}

Rgba8 layer_colour(const MaskLayer& layer) {
  const auto channel = [](float v) {
    return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(v, 0.0F, 1.0F)));
  };
  return {channel(layer.rgb[0]), channel(layer.rgb[1]), channel(layer.rgb[2]), 255};
}

/// Reads a pixel's mask: 0 outside the picture's sector.
class MaskPixels {
 public:
  MaskPixels(const SliceMap& map, const Overlay& overlay) : map_(&map), overlay_(&overlay) {}
  [[nodiscard]] std::uint32_t at(std::size_t i) const {
    const std::int32_t voxel = map_->voxels()[i];
    return voxel < 0 ? 0 : (*overlay_)[static_cast<std::size_t>(voxel)];
  }
  /// Whether another layer, or none, lies within `width` pixels; beyond the picture's edge all is the same.
  [[nodiscard]] bool on_edge(int x, int y, int width) const {
    const PixelSize size = map_->size();
    const auto layer_at = [&](int px, int py) {
      const int cx = std::clamp(px, 0, size.width - 1);
      const int cy = std::clamp(py, 0, size.height - 1);
      return at(static_cast<std::size_t>(cy) * static_cast<std::size_t>(size.width) + static_cast<std::size_t>(cx)) /
             256;
    };
    const std::uint32_t own = layer_at(x, y);
    for (int d = 1; d <= width; ++d) {
      if (layer_at(x - d, y) != own || layer_at(x + d, y) != own || layer_at(x, y - d) != own ||
          layer_at(x, y + d) != own)
        return true;
    }
    return false;
  }

 private:
  const SliceMap* map_;
  const Overlay* overlay_;
};

/// Darkens (on a light theme) the unselected neighbours of an outline's pixel: a line in one colour would be lost over
/// data of the same colour.
void rim(Image& image, const MaskPixels& pixels, int x, int y, const Theme& theme) {
  for (const auto& [dx, dy] : {std::pair{-1, 0}, std::pair{1, 0}, std::pair{0, -1}, std::pair{0, 1}}) {
    const int nx = x + dx;
    const int ny = y + dy;
    if (nx < 0 || ny < 0 || nx >= image.size.width || ny >= image.size.height) continue;
    const std::size_t i = image.index(nx, ny);
    if (pixels.at(i) == 0) image.pixels[i] = with_alpha(theme.text, 255);
  }
}

void colour_masks(Image& image, const SliceMap& map, const std::vector<MaskLayer>& masks, const Overlay& overlay,
                  const SliceMaskStyle& style, const Theme& theme) {
  if (overlay.empty()) return;
  std::vector<Rgba8> colours(masks.size());
  std::transform(masks.begin(), masks.end(), colours.begin(), layer_colour);
  const int core = weight_of(style.core_strength);
  const int fuzzy = weight_of(style.fuzzy_strength);
  const MaskPixels pixels(map, overlay);
  const int edge = std::max(1, static_cast<int>(std::lround(theme.line_px)));
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = 0; x < image.size.width; ++x) {
      const std::size_t i = image.index(x, y);
      const std::uint32_t mask = pixels.at(i);
      if (mask == 0) continue;
      const Rgba8 colour = colours[mask / 256 - 1];
      const double confidence = (mask % 256) / 255.0;
      const bool edged = style.outline && pixels.on_edge(x, y, edge);
      const int strength = edged ? 255 : confidence >= style.core_at ? core : fuzzy;
      image.pixels[i] = mixed(image.pixels[i], colour, strength);
      if (edged) rim(image, pixels, x, y, theme);
    }
  }
}

}  // namespace

Result<Image> slice_image(const SliceMap& map, const SliceData& data, const SvColours& colours, const FlagStyle& flags,
                          const SliceMaskStyle& masks, const Theme& theme) {
  const Sector& sector = map.sector();
  const Shape3 shape{sector.fans(), sector.beams(), sector.range().count};
  if (data.sv.shape() != shape || colours.by_count.size() != 65536) {
    const Shape3 s = data.sv.shape();
    return fail(ErrorCode::mismatch, fmt::format("the ping has {} x {} x {} samples; the slice's grid has {} x {} x {}",
                                                 s.fans, s.beams, s.samples, shape.fans, shape.beams, shape.samples));
  }
  auto overlay = overlay_of(data.masks, shape);
  if (!overlay) return pass_on(overlay);
  const std::vector<Rgba8> table = over_water(colours, theme);
  Image image(map.size(), Rgba8{0, 0, 0, 0});
  const std::int16_t* sv = data.sv.data();
  const std::vector<std::int32_t>& voxels = map.voxels();
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    if (voxels[i] >= 0) image.pixels[i] = table[static_cast<std::size_t>(sv[voxels[i]] + 32768)];
  }
  colour_flags(image, map, data, flags, theme);
  colour_masks(image, map, data.masks, *overlay, masks, theme);
  return image;
}

std::string flag_text(SampleFlags flags) {
  static constexpr std::array<std::pair<SampleFlags, std::string_view>, 8> kNames = {
      {{SampleFlags::near_field, "near field"},
       {SampleFlags::surface, "surface"},
       {SampleFlags::hot_beam, "hot beam"},
       {SampleFlags::lost, "lost"},
       {SampleFlags::wall, "wall"},
       {SampleFlags::impulse, "impulse"},
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
