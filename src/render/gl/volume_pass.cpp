// SPDX-License-Identifier: Apache-2.0
#include "render/gl/volume_pass.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "render/gl/grid_textures.h"
#include "render/gl/hull.h"
#include "render/gl/shader_source.h"
#include "render/ray_rules.h"

namespace sonar {
namespace {

constexpr GLuint kBlockBinding = 0;
/// Of every shader: the uniform block is the same in all of them.
const std::string kVersion = fmt::format("#version 410 core\n#define SKY_RAYS {}\n", kSkyRays);

/// files  of render/gl/shaders, one after the other; an empty name adds nothing
std::string shader_of(std::initializer_list<std::string_view> files, std::string_view defines = {}) {
  std::string out = kVersion;
  out += defines;
  for (const std::string_view file : files) {
    out += shader_source(file);
  }
  return out;
}

std::string defines(const RayVariant& v) {
  const auto flag = [](const char* name, auto value) { return fmt::format("#define {} {}\n", name, int{value}); };
  return flag("ACCUMULATES", accumulates(v.mode)) + flag("SURFACE", ends_at_surface(v.mode)) +
         flag("MAXIMUM", v.mode == RayMode::maximum) + flag("LIT", v.lit) + flag("CUED", v.cued) +
         flag("DATA", v.data) + flag("GAPPED", v.gapped) + flag("FOLDED", v.folded) + flag("OPAQUE", v.opaque) +
         flag("MASKS", v.mask_words > 0) + flag("MASK_WORDS", v.mask_words) + flag("INNER", v.inner) +
         flag("WIDE", v.wide) + flag("LOW_HOLE", v.low_hole) + flag("HIGH_HOLE", v.high_hole) +
         flag("EVEN_BEAMS", v.even_beams) + flag("EVEN_FANS", v.even_fans) + flag("ANGLE_ENTRIES", kAngleEntries) +
         flag("CELL_SAMPLES", kCellSamples) + flag("CELL_ROW", kCellRow) + flag("SKY_STEPS", kSkySteps) +
         flag("CLIMBS", kClimbs) + flag("MASK_HALVINGS", kMaskHalvings) +
         fmt::format("#define ALONG_BEAMS {:.3f}\n#define FACE_INDEX {:.4f}\n", kAlongBeams, kFaceIndex);
}

void set_slots(const Program& program) {
  glUseProgram(program.id());
  for (const TextureSlot& slot : kTextureSlots) {
    if (const GLint at = glGetUniformLocation(program.id(), slot.sampler); at >= 0) {
      glUniform1i(at, slot.unit);
    }
  }
  glUniformBlockBinding(program.id(), glGetUniformBlockIndex(program.id(), "Ray"), kBlockBinding);
}

GLenum target_of(int unit) {
  return unit == kSvUnit || unit == kKnownUnit || unit == kMaskUnit ? GL_TEXTURE_3D : GL_TEXTURE_2D;
}

}  // namespace

RayVariant sector_variant(const GridAxes& axes) {
  RayVariant out;
  out.inner = axes.nearest_m > 0.0;
  out.wide = axes.half_width_rad > 1.5707963267948966;
  out.low_hole = axes.first_elevation_rad < 0.0;
  out.high_hole = axes.last_elevation_rad >= 0.0;
  out.even_beams = axes.even_beams;
  out.even_fans = axes.even_fans;
  return out;
}

ShaderTexts hull_shaders() { return {shader_of({"block.glsl", "hull.vert"}), shader_of({"hull.frag"})}; }

ShaderTexts ray_shaders(const RayVariant& variant) {
  const bool masks = variant.mask_words > 0;
  return {shader_of({"whole.vert"}),
          shader_of({"block.glsl", "grid.glsl", "sector.glsl", "cells.glsl", "sum.glsl",
                     variant.lit || masks ? "light.glsl" : "", masks ? "masks.glsl" : "", "sky.glsl", "volume.frag"},
                    defines(variant))};
}

Result<void> VolumePass::prepare(const RayVariant& variant) {
  if (!hull_program_) {
    auto made = make_program("hull", hull_shaders());
    if (!made) {
      return pass_on(made);
    }
    hull_program_ = std::move(*made);
    set_slots(hull_program_);
    no_shape_ = VertexArray::make();
    block_ = Buffer::make();
  }
  if (programs_.contains(variant)) {
    return {};
  }
  auto made = make_program("volume", ray_shaders(variant));
  if (!made) {
    return pass_on(made);
  }
  set_slots(*made);
  programs_.emplace(variant, std::move(*made));
  return {};
}

void VolumePass::set_hull(const GridAxes& axes) {
  const auto corners = sector_hull(axes);
  hull_corners_ = static_cast<int>(corners.size());
  hull_shape_ = VertexArray::make();
  hull_ = Buffer::make();
  glBindVertexArray(hull_shape_.id());
  glBindBuffer(GL_ARRAY_BUFFER, hull_.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size() * sizeof(corners[0])), corners.data(),
               GL_STATIC_DRAW);
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  glBindVertexArray(0);
  hull_.label("sector hull");
}

/// Stencil 1 where the hull is seen.
void VolumePass::mark() const {
  glUseProgram(hull_program_.id());
  glEnable(GL_CLIP_DISTANCE0);
  glEnable(GL_STENCIL_TEST);
  glStencilFunc(GL_ALWAYS, 1, 0xFFU);
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glBindVertexArray(hull_shape_.id());
  glDrawArrays(GL_TRIANGLES, 0, hull_corners_);
  glDisable(GL_CLIP_DISTANCE0);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void VolumePass::draw(const RayVariant& variant, const RayBlock& block, std::span<const unsigned> textures) {
  glBindBuffer(GL_UNIFORM_BUFFER, block_.id());
  glBufferData(GL_UNIFORM_BUFFER, sizeof(block), &block, GL_STREAM_DRAW);
  glBindBufferBase(GL_UNIFORM_BUFFER, kBlockBinding, block_.id());
  glClearColor(0.0F, 0.0F, 0.0F, 0.0F);
  glClearStencil(0);
  glClear(GL_COLOR_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
  mark();
  glStencilFunc(GL_EQUAL, 1, 0xFFU);
  glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
  for (int unit = 0; unit < static_cast<int>(textures.size()); ++unit) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(target_of(unit), textures[static_cast<std::size_t>(unit)]);
  }
  glUseProgram(programs_.at(variant).id());
  glBindVertexArray(no_shape_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace sonar
