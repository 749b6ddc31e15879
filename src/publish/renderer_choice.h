// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "base/result.h"
#include "publish/picture_options.h"
#include "render/volume_renderer.h"

namespace sonar {

/// A back-end without a window, with the context that it draws in where it needs one.
struct OffscreenRenderer {
  std::shared_ptr<void> context;  ///< outlives the renderer
  std::unique_ptr<VolumeRenderer> renderer;
};

/// automatic  OpenGL on a real GPU, else the processor: a software driver is slower than our own
/// errors     unsupported: OpenGL was asked for and is not to be had
[[nodiscard]] Result<OffscreenRenderer> offscreen_renderer(RendererChoice choice);

}  // namespace sonar
