// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include "render/gl/context_egl.h"
#include "render/gl/gl_renderer.h"
#include "render/gl/gl_test_scene.h"
#include "render/reference/brute_force.h"
#include "render/test_scenes.h"

namespace sonar::gl_test {

/// A context of its own for each test; skipped where none can be had.
class VolumeGl : public testing::Test {
 protected:
  void SetUp() override {
    auto made = ContextEgl::make();
    if (!made) GTEST_SKIP() << "no OpenGL here: " << made.error().text;
    context_ = std::move(*made);
    ASSERT_TRUE(context_.make_current());
  }
  ContextEgl context_;
  Work work_{2};

  std::unique_ptr<VolumeRenderer> renderer(const GlRendererOptions& options = {}) {
    auto made = make_gl_renderer(options);
    EXPECT_TRUE(made) << (made ? "" : made.error().text);
    return made ? std::move(*made) : nullptr;
  }

  RayImage drawn(VolumeRenderer& gl, const VolumeView& view, const DrawQuality& quality = {}) {
    auto image = gl.draw(view, quality, work_);
    EXPECT_TRUE(image) << (image ? "" : image.error().text);
    return image ? std::move(*image) : RayImage{};
  }

  RayImage drawn(const std::shared_ptr<const VolumeData>& volume, const OpticalTable& table, const VolumeView& view,
                 const DrawQuality& quality = {}, std::span<const MaskLayer> masks = {},
                 const GlRendererOptions& options = {}) {
    const auto gl = renderer(options);
    EXPECT_TRUE(gl->set_volume(volume));
    EXPECT_TRUE(gl->set_transfer(table));
    EXPECT_TRUE(gl->set_masks(masks));
    return drawn(*gl, view, quality);
  }

  double against_truth(const std::shared_ptr<const VolumeData>& volume, const OpticalTable& table,
                       const VolumeView& view, const DrawQuality& quality = {}, std::span<const MaskLayer> masks = {}) {
    const RayImage truth = brute_force(*volume, table, masks, view, 0.25, work_);
    EXPECT_GT(std::count_if(truth.rgba.begin(), truth.rgba.end(), [](const auto& p) { return p[3] > 0.1F; }),
              static_cast<std::ptrdiff_t>(truth.rgba.size() / 300))
        << "nothing to be seen";
    return psnr_db(on_black(truth), on_black(drawn(volume, table, view, quality, masks)));
  }
};

inline const Grid& grid_named(std::string_view name) {
  const auto& all = grids();
  return *std::find_if(all.begin(), all.end(), [&](const Grid& g) { return g.name == name; });
}

/// Largest difference of any channel, in steps of 8 bits.
inline double largest_step(const RayImage& a, const RayImage& b) {
  double largest = a.size == b.size ? 0.0 : 1e9;
  for (std::size_t i = 0; largest < 1e9 && i < a.rgba.size(); ++i) {
    for (std::size_t c = 0; c < 4; ++c) {
      largest =
          std::max(largest, 255.0 * std::abs(static_cast<double>(a.rgba[i][c]) - static_cast<double>(b.rgba[i][c])));
    }
  }
  return largest;
}

/// Every 7th beam's far half and a block of samples are missing.
inline std::shared_ptr<VolumeData> with_gaps(const Grid& grid) {
  auto out = volume_of(grid);
  const Shape3 n = out->sv.shape();
  for (int f = 0; f < n.fans; ++f) {
    for (int b = 0; b < n.beams; ++b) {
      for (int s = 0; s < n.samples; ++s) {
        const bool lost =
            (b % 7 == 3 && 2 * s > n.samples) || (f > n.fans / 2 && s > n.samples / 2 && s < n.samples * 2 / 3);
        if (lost) out->sv(f, b, s) = kNoData;
      }
    }
  }
  return out;
}

}  // namespace sonar::gl_test
