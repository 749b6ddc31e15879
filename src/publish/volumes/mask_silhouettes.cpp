// SPDX-License-Identifier: Apache-2.0
#include "publish/volumes/mask_silhouettes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace sonar {
namespace {

/// A mask's place in the list as a colour that comes back from the rays as it went in.
std::array<float, 3> colour_of(std::size_t number) {
  return {static_cast<float>(number) / 255.0F, 0.0F, 0.0F};  // back-ends take no more than 255 masks
}

std::uint8_t number_of(const std::array<float, 4>& pixel) {
  return pixel[3] < 0.5F ? std::uint8_t{0} : static_cast<std::uint8_t>(std::lround(255.0F * pixel[0] / pixel[3]));
}

std::array<float, 4> opaque(Rgba8 c) {
  return {static_cast<float>(c.r) / 255.0F, static_cast<float>(c.g) / 255.0F, static_cast<float>(c.b) / 255.0F, 1.0F};
}

/// Whose mask is seen from a confidence on. Rays of a smaller picture stand for those beside them.
Result<std::vector<std::uint8_t>> seen_from(VolumeRenderer& renderer, VolumeView view, float confidence, Work& work,
                                            int divisor) {
  view.mode = RayMode::accumulate;
  view.lighting.on = false;
  view.cue = {};
  view.masks = {.fuzzy_above = confidence,
                .core_at = 1.0F,
                .fuzzy_opacity = 1.0F,
                .core_extinction_per_m = 0.0F,
                .data_too = false};
  DrawQuality quality;
  quality.divisor = divisor;
  const auto rays = renderer.draw(view, quality, work);
  if (!rays) return pass_on(rays);
  std::vector<std::uint8_t> out(view.size.count());
  auto pixel = out.begin();
  for (int y = 0; y < view.size.height; ++y) {
    for (int x = 0; x < view.size.width; ++x) {
      const int u = std::min(x / divisor, rays->size.width - 1);
      const int v = std::min(y / divisor, rays->size.height - 1);
      *pixel++ = number_of(rays->rgba[static_cast<std::size_t>(v) * static_cast<std::size_t>(rays->size.width) +
                                      static_cast<std::size_t>(u)]);
    }
  }
  return out;
}

class Drawing {
 public:
  Drawing(RayImage& rays, std::span<const MaskLayer> masks, int line_px)
      : rays_(rays), masks_(masks), line_px_(line_px) {}

  /// Pixels of a silhouette with another's or none's nearer than the line's width.
  void lines(const std::vector<std::uint8_t>& of, bool broken) {
    for_each_near_edge(of, widest_px(), [&](int x, int y, std::uint8_t own, int distance2) {
      if (!on_line(own, distance2) || (broken && in_gap(x, y))) return;
      const auto& c = masks_[own - 1U].rgb;
      pixel(x, y) = {c[0], c[1], c[2], 1.0F};
    });
  }
  /// Pixels of none that touch a silhouette.
  void rim(const std::vector<std::uint8_t>& of, std::array<float, 4> colour) {
    const int width = rim_px();
    for_each_near_edge(of, width, [&](int x, int y, std::uint8_t own, int distance2) {
      if (own == 0 && distance2 <= width * width) pixel(x, y) = colour;
    });
  }
  /// Pixels straight across from each dash of a silhouette's broken line, on both sides: its ends too have both.
  void rims_of_broken(const std::vector<std::uint8_t>& of, std::array<float, 4> outside, std::array<float, 4> inside) {
    enum Part : std::uint8_t { elsewhere, gap, dash };
    std::vector<Part> line(of.size(), elsewhere);
    for_each_near_edge(of, widest_px(), [&](int x, int y, std::uint8_t own, int distance2) {
      if (on_line(own, distance2)) line[place(x, y)] = in_gap(x, y) ? gap : dash;
    });
    const auto put = [&](int x, int y) {
      if (x < 0 || y < 0 || x >= rays_.size.width || y >= rays_.size.height) return;
      const std::size_t at = place(x, y);
      if (line[at] == elsewhere) rays_.rgba[at] = of[at] == 0 ? outside : inside;
    };
    for (int y = 0; y < rays_.size.height; ++y) {
      for (int x = 0; x < rays_.size.width; ++x) {
        if (line[place(x, y)] != dash) continue;
        for (int d = -rim_px(); d <= rim_px(); ++d) {
          put(x + d, y);
          put(x, y + d);
        }
      }
    }
  }

 private:
  [[nodiscard]] bool on_line(std::uint8_t own, int distance2) const {
    const int width = width_of(own);
    return own != 0 && own <= masks_.size() && distance2 <= width * width;
  }
  [[nodiscard]] bool in_gap(int x, int y) const { return (x + y) / (4 * line_px_) % 2 != 0; }
  [[nodiscard]] int rim_px() const { return std::max(1, line_px_ / 2); }
  [[nodiscard]] int widest_px() const {
    return std::ranges::any_of(masks_, &MaskLayer::selected) ? selected_px() : line_px_;
  }
  /// Half as wide again: twice would hide a small school.
  [[nodiscard]] int selected_px() const { return line_px_ + (line_px_ + 1) / 2; }
  [[nodiscard]] int width_of(std::uint8_t number) const {
    return number > 0 && number <= masks_.size() && masks_[number - 1U].selected ? selected_px() : line_px_;
  }
  [[nodiscard]] std::size_t place(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(rays_.size.width) + static_cast<std::size_t>(x);
  }
  [[nodiscard]] std::array<float, 4>& pixel(int x, int y) { return rays_.rgba[place(x, y)]; }

  /// act  (x, y, number there, square of the distance to the nearest pixel of another number) of pixels that have one
  ///      within reach, pixels
  template <class Act>
  void for_each_near_edge(const std::vector<std::uint8_t>& of, int reach, const Act& act) {
    const auto [width, height] = rays_.size;
    std::vector<int> nearest2(of.size(), reach * reach + 1);
    // The nearest pixel of another number has a neighbour that is nearer still, and so lies on an edge itself.
    const auto on_edge = [&](int x, int y) {
      const std::uint8_t own = of[place(x, y)];
      return (x > 0 && of[place(x - 1, y)] != own) || (x + 1 < width && of[place(x + 1, y)] != own) ||
             (y > 0 && of[place(x, y - 1)] != own) || (y + 1 < height && of[place(x, y + 1)] != own);
    };
    const auto spread = [&](int x, int y) {
      for (int v = std::max(0, y - reach); v <= std::min(height - 1, y + reach); ++v) {
        for (int u = std::max(0, x - reach); u <= std::min(width - 1, x + reach); ++u) {
          if (of[place(u, v)] == of[place(x, y)]) continue;
          int& nearest = nearest2[place(u, v)];
          nearest = std::min(nearest, (u - x) * (u - x) + (v - y) * (v - y));
        }
      }
    };
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        if (on_edge(x, y)) spread(x, y);
      }
    }
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        if (const int distance2 = nearest2[place(x, y)]; distance2 <= reach * reach)
          act(x, y, of[place(x, y)], distance2);
      }
    }
  }

  RayImage& rays_;
  std::span<const MaskLayer> masks_;
  int line_px_;
};

}  // namespace

Result<MaskSilhouettes> mask_silhouettes(VolumeRenderer& renderer, std::span<const MaskLayer> masks,
                                         const VolumeView& view, Work& work, int divisor) {
  std::vector<MaskLayer> numbered(masks.begin(), masks.end());
  for (std::size_t i = 0; i < numbered.size(); ++i) numbered[i].rgb = colour_of(i + 1);
  if (auto set = renderer.set_masks(numbered); !set) return pass_on(set);
  auto fuzzy = seen_from(renderer, view, view.masks.fuzzy_above, work, divisor);
  if (!fuzzy) return pass_on(fuzzy);
  auto core = seen_from(renderer, view, view.masks.core_at, work, divisor);
  if (!core) return pass_on(core);
  return MaskSilhouettes{std::move(*fuzzy), std::move(*core)};
}

void lay_outlines(RayImage& rays, std::span<const MaskLayer> masks, const MaskSilhouettes& silhouettes, int line_px,
                  const Theme& theme) {
  Drawing drawing(rays, masks, line_px);
  drawing.rim(silhouettes.fuzzy, opaque(theme.text));
  drawing.rims_of_broken(silhouettes.core, opaque(theme.text), opaque(theme.background));
  drawing.lines(silhouettes.core, true);
  drawing.lines(silhouettes.fuzzy, false);
}

}  // namespace sonar
