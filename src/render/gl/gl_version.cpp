// SPDX-License-Identifier: Apache-2.0
#include "render/gl/gl_version.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#if __has_include(<epoxy/glx.h>)
#include <epoxy/glx.h>
#define SONAR_WITH_GLX 1
#else
#define SONAR_WITH_GLX 0
#endif
#include <fmt/format.h>

namespace sonar {
namespace {

/// The loader ends the program when it is asked for OpenGL while no context is current; so it is asked first.
bool any_current() {
  if (eglGetCurrentContext() != EGL_NO_CONTEXT) {
    return true;
  }
#if SONAR_WITH_GLX
  return glXGetCurrentContext() != nullptr;
#else
  return false;
#endif
}

}  // namespace

Result<void> check_version(GlVersion found, const std::string& driver) {
  if (found >= kLeastGl) {
    return {};
  }
  if (found == GlVersion{}) {
    return fail(ErrorCode::unsupported, "no OpenGL context is current; expected OpenGL 4.1 or higher");
  }
  return fail(ErrorCode::unsupported, fmt::format("OpenGL {}.{} ({}) is too old; expected {}.{} or higher", found.major,
                                                  found.minor, driver, kLeastGl.major, kLeastGl.minor));
}

GlVersion current_version() {
  if (!any_current()) {
    return {};
  }
  const int version = epoxy_gl_version();
  return {version / 10, version % 10};
}

bool draws_by_software(std::string_view driver) {
  // Mesa's three (swrast calls itself a Software Rasterizer) and ANGLE's.
  for (const std::string_view name : {"llvmpipe", "softpipe", "swrast", "Software Rasterizer", "SwiftShader"}) {
    if (driver.find(name) != std::string_view::npos) return true;
  }
  return false;
}

std::string current_driver() {
  const auto* text = any_current() ? reinterpret_cast<const char*>(glGetString(GL_RENDERER)) : nullptr;
  return text != nullptr ? text : "unknown driver";
}

}  // namespace sonar
