// SPDX-License-Identifier: Apache-2.0
#include "render/gl/gl_object.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>

namespace sonar {
namespace {

GLenum identifier(GlKind kind) {
  switch (kind) {
    case GlKind::buffer:
      return GL_BUFFER;
    case GlKind::texture:
      return GL_TEXTURE;
    case GlKind::program:
      return GL_PROGRAM;
    case GlKind::framebuffer:
      return GL_FRAMEBUFFER;
    case GlKind::vertex_array:
      return GL_VERTEX_ARRAY;
    case GlKind::query:
      return GL_QUERY;
  }
  return GL_NONE;
}

std::string one_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\0' || text.back() == ' ')) {
    text.pop_back();
  }
  std::replace(text.begin(), text.end(), '\n', ';');
  return text;
}

/// A shader for as long as it takes to link it.
class Shader {
 public:
  explicit Shader(GLenum stage) : id_(glCreateShader(stage)) {}
  ~Shader() { glDeleteShader(id_); }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
  [[nodiscard]] GLuint id() const { return id_; }

  /// Empty, or what the driver complains of.
  [[nodiscard]] std::string compile(const std::string& source) const {
    const GLchar* text = source.c_str();
    const auto length = static_cast<GLint>(source.size());
    glShaderSource(id_, 1, &text, &length);
    glCompileShader(id_);
    GLint good = 0;
    glGetShaderiv(id_, GL_COMPILE_STATUS, &good);
    if (good != 0) {
      return {};
    }
    GLint size = 0;
    glGetShaderiv(id_, GL_INFO_LOG_LENGTH, &size);
    std::string log(static_cast<std::size_t>(std::max(size, 1)), '\0');
    glGetShaderInfoLog(id_, static_cast<GLsizei>(log.size()), nullptr, log.data());
    log = one_line(log);
    return log.empty() ? "no reason given" : log;
  }

 private:
  GLuint id_;
};

std::string link(GLuint program) {
  glLinkProgram(program);
  GLint good = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  if (good != 0) {
    return {};
  }
  GLint size = 0;
  glGetProgramiv(program, GL_INFO_LOG_LENGTH, &size);
  std::string log(static_cast<std::size_t>(std::max(size, 1)), '\0');
  glGetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
  return one_line(log);
}

}  // namespace

unsigned gl_detail::create(GlKind kind) {
  GLuint id = 0;
  switch (kind) {
    case GlKind::buffer:
      glGenBuffers(1, &id);
      break;
    case GlKind::texture:
      glGenTextures(1, &id);
      break;
    case GlKind::program:
      id = glCreateProgram();
      break;
    case GlKind::framebuffer:
      glGenFramebuffers(1, &id);
      break;
    case GlKind::vertex_array:
      glGenVertexArrays(1, &id);
      break;
    case GlKind::query:
      glGenQueries(1, &id);
      break;
  }
  return id;
}

void gl_detail::destroy(GlKind kind, unsigned id) {
  switch (kind) {
    case GlKind::buffer:
      glDeleteBuffers(1, &id);
      break;
    case GlKind::texture:
      glDeleteTextures(1, &id);
      break;
    case GlKind::program:
      glDeleteProgram(id);
      break;
    case GlKind::framebuffer:
      glDeleteFramebuffers(1, &id);
      break;
    case GlKind::vertex_array:
      glDeleteVertexArrays(1, &id);
      break;
    case GlKind::query:
      glDeleteQueries(1, &id);
      break;
  }
}

void gl_detail::label(GlKind kind, unsigned id, std::string_view text) {
  // Drivers need not take more than 256 characters.
  if (id != 0 && (epoxy_gl_version() >= 43 || epoxy_has_gl_extension("GL_KHR_debug"))) {
    glObjectLabel(identifier(kind), id, static_cast<GLsizei>(std::min<std::size_t>(text.size(), 200)), text.data());
  }
}

Result<Program> make_program(std::string_view name, const ShaderTexts& shaders) {
  const Shader first(GL_VERTEX_SHADER);
  const Shader second(GL_FRAGMENT_SHADER);
  for (const auto& [shader, source, stage] :
       {std::tuple{&first, &shaders.vertex, "vertex"}, std::tuple{&second, &shaders.fragment, "fragment"}}) {
    if (const std::string complaint = shader->compile(*source); !complaint.empty()) {
      return fail(ErrorCode::unsupported,
                  fmt::format("the driver does not take the {} shader '{}': {}", stage, name, complaint));
    }
  }
  Program program = Program::make();
  glAttachShader(program.id(), first.id());
  glAttachShader(program.id(), second.id());
  const std::string complaint = link(program.id());
  glDetachShader(program.id(), first.id());
  glDetachShader(program.id(), second.id());
  if (!complaint.empty()) {
    return fail(ErrorCode::unsupported, fmt::format("the driver does not link the shader '{}': {}", name, complaint));
  }
  program.label(name);
  return program;
}

}  // namespace sonar
