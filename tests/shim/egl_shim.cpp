// SPDX-License-Identifier: Apache-2.0
// Stands in for libEGL.so.1 (LD_LIBRARY_PATH): three devices, of which the second draws by software, and Mesa's platform
// without surfaces; none can be started. For tests.
//   SONAR_EGL_LOG  a line for each display that is asked for: "device 0", "surfaceless"
//   SONAR_EGL_OLD  set: an EGL that does not know devices
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

constexpr const char* kDevices =
    "EGL_EXT_platform_device EGL_EXT_device_base EGL_EXT_device_enumeration EGL_EXT_device_query ";
constexpr const char* kAlways = "EGL_EXT_client_extensions EGL_EXT_platform_base EGL_MESA_platform_surfaceless";

EGLDeviceEXT device(std::intptr_t index) { return reinterpret_cast<EGLDeviceEXT>(index + 1); }

void log(const std::string& line) {
  const char* to = std::getenv("SONAR_EGL_LOG");
  std::FILE* file = to == nullptr ? nullptr : std::fopen(to, "a");
  if (file == nullptr) return;
  std::fprintf(file, "%s\n", line.c_str());
  std::fclose(file);
}

EGLBoolean query_devices(EGLint most, EGLDeviceEXT* devices, EGLint* count) {
  *count = most < 3 ? most : 3;
  for (EGLint i = 0; devices != nullptr && i < *count; ++i) devices[i] = device(i);
  return EGL_TRUE;
}

const char* query_device_string(EGLDeviceEXT of, EGLint) {
  return of == device(1) ? "EGL_MESA_device_software" : "EGL_EXT_device_drm";
}

EGLDisplay platform_display(EGLenum platform, void* native, const EGLint*) {
  if (platform == EGL_PLATFORM_DEVICE_EXT) {
    log("device " + std::to_string(reinterpret_cast<std::intptr_t>(native) - 1));
    return reinterpret_cast<EGLDisplay>(native);
  }
  log(platform == EGL_PLATFORM_SURFACELESS_MESA ? "surfaceless" : "another platform");
  return reinterpret_cast<EGLDisplay>(std::intptr_t{100});
}

}  // namespace

extern "C" {

const char* eglQueryString(EGLDisplay display, EGLint name) {
  static const std::string extensions = std::string(std::getenv("SONAR_EGL_OLD") != nullptr ? "" : kDevices) + kAlways;
  if (name == EGL_EXTENSIONS && display == EGL_NO_DISPLAY) return extensions.c_str();
  return name == EGL_VERSION ? "1.5" : "";
}

__eglMustCastToProperFunctionPointerType eglGetProcAddress(const char* name) {
  using Any = __eglMustCastToProperFunctionPointerType;
  if (std::strcmp(name, "eglQueryDevicesEXT") == 0) return reinterpret_cast<Any>(&query_devices);
  if (std::strcmp(name, "eglQueryDeviceStringEXT") == 0) return reinterpret_cast<Any>(&query_device_string);
  if (std::strcmp(name, "eglGetPlatformDisplayEXT") == 0) return reinterpret_cast<Any>(&platform_display);
  return nullptr;
}

EGLBoolean eglInitialize(EGLDisplay, EGLint*, EGLint*) { return EGL_FALSE; }
EGLDisplay eglGetCurrentDisplay() { return EGL_NO_DISPLAY; }
EGLContext eglGetCurrentContext() { return EGL_NO_CONTEXT; }
EGLenum eglQueryAPI() { return EGL_OPENGL_API; }
EGLint eglGetError() { return EGL_SUCCESS; }
}
