// SPDX-License-Identifier: Apache-2.0
#include "render/gl/upload.h"

#include <epoxy/gl.h>

#include <initializer_list>

namespace sonar {
namespace {

struct Format {
  GLint internal;
  GLenum format;
  GLenum type;
};

Format format_of(Texels texels) {
  switch (texels) {
    case Texels::r32f:
      return {GL_R32F, GL_RED, GL_FLOAT};
    case Texels::rg32f:
      return {GL_RG32F, GL_RG, GL_FLOAT};
    case Texels::rgba32f:
      return {GL_RGBA32F, GL_RGBA, GL_FLOAT};
    case Texels::rg8ui:
      return {GL_RG8UI, GL_RG_INTEGER, GL_UNSIGNED_BYTE};
    case Texels::r16i:
      return {GL_R16I, GL_RED_INTEGER, GL_SHORT};
  }
  return {};
}

Format format_of(Voxels voxels, int channels) {
  const std::size_t i = channels == 1 ? 0 : (channels == 2 ? 1 : (channels == 3 ? 2 : 3));
  constexpr std::array<GLenum, 4> kPlain = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
  constexpr std::array<GLenum, 4> kWhole = {GL_RED_INTEGER, GL_RG_INTEGER, GL_RGB_INTEGER, GL_RGBA_INTEGER};
  constexpr std::array<GLint, 4> kFloat = {GL_R32F, GL_RG32F, GL_RGBA32F, GL_RGBA32F};
  constexpr std::array<GLint, 4> kSnorm = {GL_R16_SNORM, GL_RG16_SNORM, GL_RGBA16_SNORM, GL_RGBA16_SNORM};
  constexpr std::array<GLint, 4> kUnorm = {GL_R8, GL_RG8, GL_RGBA8, GL_RGBA8};
  constexpr std::array<GLint, 4> kUint = {GL_R16UI, GL_RG16UI, GL_RGBA16UI, GL_RGBA16UI};
  switch (voxels) {
    case Voxels::float32:
      return {kFloat[i], kPlain[i], GL_FLOAT};
    case Voxels::snorm16:
      return {kSnorm[i], kPlain[i], GL_SHORT};
    case Voxels::unorm8:
      return {kUnorm[i], kPlain[i], GL_UNSIGNED_BYTE};
    case Voxels::uint16:
      return {kUint[i], kWhole[i], GL_UNSIGNED_SHORT};
  }
  return {};
}

void filter(GLenum target, GLint kind) {
  glTexParameteri(target, GL_TEXTURE_MIN_FILTER, kind);
  glTexParameteri(target, GL_TEXTURE_MAG_FILTER, kind);
  glTexParameteri(target, GL_TEXTURE_MAX_LEVEL, 0);
  for (const GLenum axis : std::initializer_list<GLenum>{GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
    glTexParameteri(target, axis, GL_CLAMP_TO_EDGE);
  }
}

Texture image_2d(std::string_view label, PixelSize size, const Format& f, const void* data) {
  Texture out = Texture::make();
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, out.id());
  glTexImage2D(GL_TEXTURE_2D, 0, f.internal, size.width, size.height, 0, f.format, f.type, data);
  filter(GL_TEXTURE_2D, GL_NEAREST);
  glBindTexture(GL_TEXTURE_2D, 0);
  out.label(label);
  return out;
}

}  // namespace

Texture texture_2d(std::string_view label, PixelSize size, Texels texels, const void* data) {
  return image_2d(label, size, format_of(texels), data);
}

Texture colour_target(PixelSize size) { return image_2d("rays", size, {GL_RGBA32F, GL_RGBA, GL_FLOAT}, nullptr); }

Texture stencil_target(PixelSize size) {
  return image_2d("covered pixels", size, {GL_DEPTH24_STENCIL8, GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8}, nullptr);
}

Texture texture_3d(std::string_view label, std::array<int, 3> size, Voxels voxels, int channels, const void* data) {
  const Format f = format_of(voxels, channels);
  Texture out = Texture::make();
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_3D, out.id());
  glTexImage3D(GL_TEXTURE_3D, 0, f.internal, size[0], size[1], size[2], 0, f.format, f.type, data);
  filter(GL_TEXTURE_3D, voxels == Voxels::uint16 ? GL_NEAREST : GL_LINEAR);
  glBindTexture(GL_TEXTURE_3D, 0);
  out.label(label);
  return out;
}

}  // namespace sonar
