// SPDX-License-Identifier: Apache-2.0
#include "publish/renderer_choice.h"

#include <string>
#include <utility>

#include "render/gl/context_egl.h"
#include "render/gl/gl_renderer.h"
#include "render/gl/gl_version.h"

namespace sonar {
namespace {

/// Without `software_too` a software driver is refused before it compiles anything.
Result<OffscreenRenderer> try_gl(bool software_too) {
  auto made = ContextEgl::make();
  if (!made) return pass_on(made);
  auto context = std::make_shared<ContextEgl>(std::move(*made));
  if (auto current = context->make_current(); !current) return pass_on(current);
  if (const std::string driver = current_driver(); !software_too && draws_by_software(driver)) {
    return fail(ErrorCode::unsupported, driver + " draws by software");
  }
  auto renderer = make_gl_renderer();
  if (!renderer) return pass_on(renderer);
  return OffscreenRenderer{std::move(context), std::move(*renderer)};
}

}  // namespace

Result<OffscreenRenderer> offscreen_renderer(RendererChoice choice) {
  if (choice != RendererChoice::cpu) {
    auto tried = try_gl(choice == RendererChoice::gl);
    if (tried || choice == RendererChoice::gl) return tried;
  }
  return OffscreenRenderer{nullptr, make_cpu_renderer()};
}

}  // namespace sonar
