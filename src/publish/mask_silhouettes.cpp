// SPDX-License-Identifier: Apache-2.0
#include "publish/mask_silhouettes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "render/refinement.h"

namespace sonar {
namespace {

/// What is seen of a mask from a confidence on.
Result<std::vector<std::uint8_t>> seen_from(VolumeRenderer& renderer, VolumeView view, float confidence, Work& work,
                                            int divisor) {
  view.mode = RayMode::accumulate;
  view.lighting.on = false;
  view.masks = {.fuzzy_above = confidence,
                .core_at = 1.0F,
                .fuzzy_opacity = 1.0F,
                .core_extinction_per_m = 0.0F,
                .data_too = false};
  DrawQuality quality;
  quality.divisor = divisor;
  auto alone = renderer.draw(view, quality, work);
  if (!alone) return pass_on(alone);
  if (divisor > 1) alone = enlarged(*alone, view.size, divisor, work);
  std::vector<std::uint8_t> out(alone->rgba.size());
  std::transform(alone->rgba.begin(), alone->rgba.end(), out.begin(),
                 [](const auto& pixel) { return static_cast<std::uint8_t>(pixel[3] >= 0.5F); });
  return out;
}

class Drawing {
 public:
  Drawing(RayImage& rays, int line_px) : rays_(rays), line_px_(line_px) {}

  /// Pixels of a silhouette with one outside it nearer than the line's width.
  void line(const std::vector<std::uint8_t>& inside, std::array<float, 4> colour, bool broken) {
    const int dash = 4 * line_px_;
    for_each(inside, true, line_px_, [&](int x, int y, std::array<float, 4>& pixel) {
      if (!broken || ((x + y) / dash) % 2 == 0) pixel = colour;
    });
  }
  /// Pixels outside it that touch it.
  void rim(const std::vector<std::uint8_t>& inside, std::array<float, 4> colour) {
    for_each(inside, false, std::max(1, line_px_ / 2), [&](int, int, std::array<float, 4>& pixel) { pixel = colour; });
  }

 private:
  /// Of what is inside; first behind last where nothing is.
  struct Bounds {
    int first_x = 0;
    int last_x = -1;
    int first_y = 0;
    int last_y = -1;
  };
  [[nodiscard]] Bounds bounds(const std::vector<std::uint8_t>& inside) const {
    const auto [width, height] = rays_.size;
    Bounds b{width, -width, height, -height};
    for (int y = 0; y < height; ++y) {
      const auto row = inside.begin() + static_cast<std::ptrdiff_t>(y) * width;
      const auto first = std::find(row, row + width, 1);
      if (first == row + width) continue;
      b.first_y = std::min(b.first_y, y);
      b.last_y = y;
      b.first_x = std::min(b.first_x, static_cast<int>(first - row));
      for (int x = width - 1; x > b.last_x; --x) {
        if (row[x] != 0) b.last_x = x;
      }
    }
    return b;
  }

  template <class Act>
  void for_each(const std::vector<std::uint8_t>& inside, bool own, int reach, const Act& act) {
    const auto [width, height] = rays_.size;
    const auto at = [&](int x, int y) {
      return inside[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] != 0;
    };
    // Most of a picture is far from any school.
    const Bounds b = bounds(inside);
    for (int y = std::max(0, b.first_y - reach); y <= std::min(height - 1, b.last_y + reach); ++y) {
      for (int x = std::max(0, b.first_x - reach); x <= std::min(width - 1, b.last_x + reach); ++x) {
        if (at(x, y) != own) continue;
        bool met = false;
        for (int v = std::max(0, y - reach); v <= std::min(height - 1, y + reach) && !met; ++v) {
          for (int u = std::max(0, x - reach); u <= std::min(width - 1, x + reach) && !met; ++u) {
            met = (u - x) * (u - x) + (v - y) * (v - y) <= reach * reach && at(u, v) != own;
          }
        }
        if (!met) continue;
        act(x, y,
            rays_.rgba[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)]);
      }
    }
  }

  RayImage& rays_;
  int line_px_;
};

}  // namespace

Result<std::vector<MaskSilhouette>> mask_silhouettes(VolumeRenderer& renderer, std::span<const MaskLayer> masks,
                                                     const VolumeView& view, Work& work, int divisor) {
  std::vector<MaskSilhouette> out;
  for (const MaskLayer& mask : masks) {
    if (auto set = renderer.set_masks(std::span(&mask, 1)); !set) return pass_on(set);
    auto fuzzy = seen_from(renderer, view, view.masks.fuzzy_above, work, divisor);
    if (!fuzzy) return pass_on(fuzzy);
    auto core = seen_from(renderer, view, view.masks.core_at, work, divisor);
    if (!core) return pass_on(core);
    out.push_back({std::move(*fuzzy), std::move(*core)});
  }
  return out;
}

void lay_outlines(RayImage& rays, std::span<const MaskLayer> masks, std::span<const MaskSilhouette> silhouettes,
                  int line_px, Rgba8 rim) {
  Drawing drawing(rays, line_px);
  for (std::size_t i = 0; i < std::min(masks.size(), silhouettes.size()); ++i) {
    const auto& c = masks[i].rgb;
    const std::array<float, 4> colour{c[0], c[1], c[2], 1.0F};
    drawing.rim(silhouettes[i].fuzzy, {static_cast<float>(rim.r) / 255.0F, static_cast<float>(rim.g) / 255.0F,
                                       static_cast<float>(rim.b) / 255.0F, 1.0F});
    drawing.line(silhouettes[i].core, colour, true);
    drawing.line(silhouettes[i].fuzzy, colour, false);
  }
}

}  // namespace sonar
