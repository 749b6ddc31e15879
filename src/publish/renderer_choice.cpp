// SPDX-License-Identifier: Apache-2.0
#include "publish/renderer_choice.h"

#include <string_view>
#include <utility>

#include "render/gl/context_egl.h"
#include "render/gl/gl_renderer.h"
#include "render/gl/gl_version.h"

namespace sonar {
namespace {

bool is_software(std::string_view driver) {
  for (const std::string_view name : {"llvmpipe", "softpipe", "swrast", "SwiftShader"}) {
    if (driver.find(name) != std::string_view::npos) return true;
  }
  return false;
}

struct GlTried {
  OffscreenRenderer offscreen;
  bool software = false;
};

Result<GlTried> try_gl() {
  auto made = ContextEgl::make();
  if (!made) return pass_on(made);
  auto context = std::make_shared<ContextEgl>(std::move(*made));
  if (auto current = context->make_current(); !current) return pass_on(current);
  const bool software = is_software(current_driver());
  auto renderer = make_gl_renderer();
  if (!renderer) return pass_on(renderer);
  return GlTried{{std::move(context), std::move(*renderer)}, software};
}

}  // namespace

Result<OffscreenRenderer> offscreen_renderer(RendererChoice choice) {
  if (choice != RendererChoice::cpu) {
    auto tried = try_gl();
    if (choice == RendererChoice::gl && !tried) return pass_on(tried);
    if (tried && (choice == RendererChoice::gl || !tried->software)) return std::move(tried->offscreen);
  }
  return OffscreenRenderer{nullptr, make_cpu_renderer()};
}

}  // namespace sonar
