// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/result.h"
#include "render/gl/gl_version.h"

namespace sonar {

/// A context without display, window or surface (EGL, of a graphics card or surfaceless): pictures are drawn into framebuffer
/// objects. Not current until asked; destroyed with its owner.
/// threads  current on one thread at a time
class ContextEgl {
 public:
  /// Core profile of the version asked for, or the highest from kLeastGl upwards that the driver gives.
  /// errors  unsupported: no EGL, none without a surface, or OpenGL below kLeastGl; the line names what was found
  [[nodiscard]] static Result<ContextEgl> make(GlVersion wanted = {4, 5});

  ContextEgl() = default;
  ~ContextEgl();
  ContextEgl(ContextEgl&& other) noexcept;
  ContextEgl& operator=(ContextEgl&& other) noexcept;
  ContextEgl(const ContextEgl&) = delete;
  ContextEgl& operator=(const ContextEgl&) = delete;

  /// errors  unsupported: the driver refuses
  [[nodiscard]] Result<void> make_current() const;
  /// Nothing is current on this thread afterwards.
  void release() const;
  [[nodiscard]] explicit operator bool() const { return context_ != nullptr; }

 private:
  ContextEgl(void* display, void* context) : display_(display), context_(context) {}
  void destroy();
  void* display_ = nullptr;
  void* context_ = nullptr;
};

}  // namespace sonar
