// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "view/image.h"
#include "view/volume/volume_scene.h"

namespace sonar {

/// What the rays of a picture cost; the same on every machine.
struct RayCounts {
  std::int64_t rays = 0;      ///< those that met the sector
  std::int64_t samples = 0;   ///< interpolated values
  std::int64_t segments = 0;  ///< homogeneous cells integrated as one
  std::int64_t leaps = 0;     ///< empty blocks passed over
};

/// The rays' colours before anything else is drawn: premultiplied, 0..1, black where nothing was met.
struct RayImage {
  PixelSize size;
  std::vector<std::array<float, 4>> rgba;  ///< [height][width], alpha = 1 - transmittance
  RayCounts counts;                        ///< zero where a back-end cannot count
};

/// The one interface of both back-ends. State is what stays from picture to picture; all of it can be set anew from
/// plain data at any moment, in any order.
/// threads  one caller at a time
class VolumeRenderer {
 public:
  VolumeRenderer() = default;
  virtual ~VolumeRenderer() = default;
  VolumeRenderer(const VolumeRenderer&) = delete;
  VolumeRenderer& operator=(const VolumeRenderer&) = delete;

  /// "cpu (AVX3)", "OpenGL 4.5, llvmpipe ..."
  [[nodiscard]] virtual std::string name() const = 0;
  /// errors  bad_parameter: no sample, or fewer than 2 fans, beams or samples
  [[nodiscard]] virtual Result<void> set_volume(std::shared_ptr<const VolumeData> volume) = 0;
  /// errors  bad_parameter: fewer than 2 entries, more than kMostTableEntries, a value that is not finite or negative
  [[nodiscard]] virtual Result<void> set_transfer(const OpticalTable& table) = 0;
  /// Masks on the grid of the volume; set_volume() takes them away.
  /// errors  bad_parameter: a run outside the grid
  [[nodiscard]] virtual Result<void> set_masks(std::span<const MaskLayer> masks) = 0;
  /// Size of the result is view.size divided by quality.divisor, rounded up.
  /// errors  bad_parameter (no volume or table yet, empty size), unsupported (what the driver cannot), cancelled
  [[nodiscard]] virtual Result<RayImage> draw(const VolumeView& view, const DrawQuality& quality, Work& work) = 0;
};

/// C++ SIMD on the processor; works everywhere.
[[nodiscard]] std::unique_ptr<VolumeRenderer> make_cpu_renderer();

/// Ray images over a background; straight sRGB.
[[nodiscard]] Image over(const RayImage& rays, const Image& background);
[[nodiscard]] Image over(const RayImage& rays, Rgba8 background);

/// 10 log10(255^2 / mean squared difference of r, g, b), dB; 99 where equal. Sizes must agree.
[[nodiscard]] double psnr_db(const Image& a, const Image& b);
/// The smallest psnr_db of all tile x tile pieces.
[[nodiscard]] double worst_tile_psnr_db(const Image& a, const Image& b, int tile = 64);

}  // namespace sonar
