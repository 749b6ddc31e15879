// SPDX-License-Identifier: Apache-2.0
#include "render/gl/context_egl.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <array>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace sonar {
namespace {

/// libepoxy ends the whole program where it looks for these and finds none.
bool libraries_are_installed() {
  const auto opens = [](const char* library) { return dlopen(library, RTLD_LAZY | RTLD_LOCAL) != nullptr; };
  return opens("libEGL.so.1") && (opens("libOpenGL.so.0") || opens("libGL.so.1"));
}

/// What version a driver without `kLeastGl` has, for the message.
std::string best_found(EGLDisplay display) {
  const EGLContext any = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, nullptr);
  if (any == EGL_NO_CONTEXT) {
    return "none";
  }
  std::string out = "none";
  if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, any) == EGL_TRUE) {
    const GlVersion found = current_version();
    out = fmt::format("{}.{} ({})", found.major, found.minor, current_driver());
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
  eglDestroyContext(display, any);
  return out;
}

EGLContext create(EGLDisplay display, GlVersion version) {
  const std::array<EGLint, 7> wanted = {EGL_CONTEXT_MAJOR_VERSION,
                                        version.major,
                                        EGL_CONTEXT_MINOR_VERSION,
                                        version.minor,
                                        EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                        EGL_NONE};
  return eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted.data());
}

bool is_software(EGLDeviceEXT device) {
  const char* extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
  return extensions != nullptr &&
         std::string_view(extensions).find("EGL_MESA_device_software") != std::string_view::npos;
}

/// Where a context without a surface may come from, best first: each graphics card by itself, for not every driver knows
/// Mesa's platform; then that.
std::vector<EGLDisplay> displays() {
  std::vector<EGLDisplay> out;
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") &&
      (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_base") ||
       epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration"))) {
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count) != EGL_TRUE) count = 0;
    for (EGLDeviceEXT device : std::span(devices).first(static_cast<std::size_t>(count))) {
      if (!is_software(device)) out.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
    }
  }
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    out.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  }
  return out;
}

}  // namespace

Result<ContextEgl> ContextEgl::make(GlVersion wanted) {
  if (!libraries_are_installed()) {
    return fail(ErrorCode::unsupported, "OpenGL is not installed; expected libEGL.so.1 and libOpenGL.so.0");
  }
  auto problem = Result<ContextEgl>(
      fail(ErrorCode::unsupported,
           "EGL draws only into windows; expected EGL_EXT_platform_device or EGL_MESA_platform_surfaceless"));
  for (EGLDisplay display : displays()) {
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE ||
        eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) {
      problem = fail(ErrorCode::unsupported, "EGL cannot be started with desktop OpenGL; is a driver installed?");
      continue;
    }
    for (GlVersion version = wanted; version >= kLeastGl; --version.minor) {
      EGLContext context = create(display, version);
      if (context != EGL_NO_CONTEXT) return ContextEgl(display, context);
    }
    problem = fail(ErrorCode::unsupported, fmt::format("OpenGL {}.{} core or higher is needed; the driver's best is {}",
                                                       kLeastGl.major, kLeastGl.minor, best_found(display)));
  }
  return problem;
}

ContextEgl::~ContextEgl() { destroy(); }

ContextEgl::ContextEgl(ContextEgl&& other) noexcept
    : display_(std::exchange(other.display_, nullptr)), context_(std::exchange(other.context_, nullptr)) {}

ContextEgl& ContextEgl::operator=(ContextEgl&& other) noexcept {
  if (this != &other) {
    destroy();
    display_ = std::exchange(other.display_, nullptr);
    context_ = std::exchange(other.context_, nullptr);
  }
  return *this;
}

Result<void> ContextEgl::make_current() const {
  if (context_ == nullptr || eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
    return fail(ErrorCode::unsupported, "the OpenGL context cannot be made current without a surface");
  }
  return {};
}

void ContextEgl::release() const {
  if (display_ != nullptr) {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
}

void ContextEgl::destroy() {
  if (context_ != nullptr) {
    if (eglGetCurrentContext() == context_) {
      release();
    }
    // The display is shared by the whole process and stays initialised: ending it would end others' contexts too.
    eglDestroyContext(display_, std::exchange(context_, nullptr));
  }
}

}  // namespace sonar
