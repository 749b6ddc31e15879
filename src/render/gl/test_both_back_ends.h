// SPDX-License-Identifier: Apache-2.0
// Pictures by either back-end, for tests of what both must draw alike. What fails throws.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "render/gl/context_egl.h"
#include "render/gl/gl_renderer.h"
#include "render/volume_renderer.h"

namespace sonar::gl_test {

inline void must(const Result<void>& done) {
  if (!done) throw std::runtime_error(to_line(done.error()));
}

struct BackEnd {
  ContextEgl context;
  std::unique_ptr<VolumeRenderer> renderer;
};
/// Of OpenGL, or of the processor. Empty where there is no OpenGL.
inline std::optional<BackEnd> back_end(bool gl) {
  if (!gl) return BackEnd{{}, make_cpu_renderer()};
  auto context = ContextEgl::make();
  if (!context) return std::nullopt;
  BackEnd out{std::move(*context), nullptr};
  must(out.context.make_current());
  out.renderer = make_gl_renderer().value();
  return out;
}

/// A test that both must pass: its parameter tells whether OpenGL draws.
class EitherBackEnd : public testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    back_end_ = back_end(GetParam());
    if (!back_end_) GTEST_SKIP() << "no OpenGL here";
  }
  VolumeRenderer& renderer() { return *back_end_->renderer; }

 private:
  std::optional<BackEnd> back_end_;
};
inline const char* name_of(const testing::TestParamInfo<bool>& gl) { return gl.param ? "OpenGl" : "Processor"; }

inline RayImage drawn(VolumeRenderer& r, const std::shared_ptr<const VolumeData>& volume, const OpticalTable& optics,
                      const VolumeView& view, const DrawQuality& quality = {}, std::span<const MaskLayer> masks = {}) {
  Work work(2);
  must(r.set_volume(volume));
  must(r.set_transfer(optics));
  must(r.set_masks(masks));
  return r.draw(view, quality, work).value();
}

/// The mean of frames 1..n.
inline RayImage mean_of(VolumeRenderer& r, const std::shared_ptr<const VolumeData>& volume, const OpticalTable& optics,
                        const VolumeView& view, int frames, std::span<const MaskLayer> masks = {}) {
  RayImage sum{view.size, std::vector<std::array<float, 4>>(view.size.count()), {}};
  for (int n = 1; n <= frames; ++n) {
    const RayImage one = drawn(r, volume, optics, view, {1, 1.0, 0.03, static_cast<std::uint32_t>(n)}, masks);
    for (std::size_t i = 0; i < sum.rgba.size(); ++i) {
      for (std::size_t c = 0; c < 4; ++c) sum.rgba[i][c] += one.rgba[i][c] / static_cast<float>(frames);
    }
  }
  return sum;
}

}  // namespace sonar::gl_test
