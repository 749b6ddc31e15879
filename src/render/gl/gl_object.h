// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "base/result.h"

namespace sonar {

/// The kinds of thing that a context owns for us.
enum class GlKind : std::uint8_t { buffer, texture, program, framebuffer, vertex_array, query };

namespace gl_detail {
[[nodiscard]] unsigned create(GlKind kind);
void destroy(GlKind kind, unsigned id);
/// A name for debuggers, where KHR_debug exists. The object must have been bound once.
void label(GlKind kind, unsigned id, std::string_view text);
}  // namespace gl_detail

/// One object of the current context, deleted with its owner; default = empty (id 0). The context that it was made in
/// must be current when it is made and when it goes.
template <GlKind kind>
class GlObject {
 public:
  GlObject() = default;
  ~GlObject() { reset(); }
  GlObject(GlObject&& other) noexcept : id_(std::exchange(other.id_, 0U)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    if (this != &other) {
      reset();
      id_ = std::exchange(other.id_, 0U);
    }
    return *this;
  }
  GlObject(const GlObject&) = delete;
  GlObject& operator=(const GlObject&) = delete;

  [[nodiscard]] static GlObject make() { return GlObject(gl_detail::create(kind)); }
  void label(std::string_view text) const { gl_detail::label(kind, id_, text); }

  [[nodiscard]] unsigned id() const { return id_; }
  [[nodiscard]] explicit operator bool() const { return id_ != 0; }
  void reset() {
    if (id_ != 0) {
      gl_detail::destroy(kind, std::exchange(id_, 0U));
    }
  }

 private:
  explicit GlObject(unsigned id) : id_(id) {}
  unsigned id_ = 0;
};

using Buffer = GlObject<GlKind::buffer>;
using Texture = GlObject<GlKind::texture>;
using Program = GlObject<GlKind::program>;
using Framebuffer = GlObject<GlKind::framebuffer>;
using VertexArray = GlObject<GlKind::vertex_array>;
using Query = GlObject<GlKind::query>;

struct ShaderTexts {
  std::string vertex;
  std::string fragment;
};

/// Compiles and links.
/// errors  unsupported: the driver's own words, after `name`
[[nodiscard]] Result<Program> make_program(std::string_view name, const ShaderTexts& shaders);

}  // namespace sonar
