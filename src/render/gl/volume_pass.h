// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>

#include "render/gl/gl_object.h"
#include "render/gl/ray_block.h"
#include "render/grid_axes.h"

namespace sonar {

/// What a variant of the ray shader is compiled for: whatever a picture does not need costs it nothing.
struct RayVariant {
  RayMode mode = RayMode::accumulate;
  bool lit = false;
  bool data = true;
  bool cued = false;  ///< colours fade with their depth
  bool gapped = false;
  bool folded = false;
  bool opaque = false;
  int mask_words = 0;  ///< 32 layers each; 0 = no masks
  // The sector's shape
  bool inner = false;      ///< begins at a distance
  bool wide = false;       ///< over 180 degrees
  bool low_hole = false;   ///< the lower cone is left out (it opens downwards), not kept
  bool high_hole = false;  ///< likewise the upper one
  bool even_beams = false;
  bool even_fans = false;
  friend auto operator<=>(const RayVariant&, const RayVariant&) = default;
};

[[nodiscard]] RayVariant sector_variant(const GridAxes& axes);
/// Texts of whole shaders: version, defines of the variant, the files they are made of.
[[nodiscard]] ShaderTexts hull_shaders();
[[nodiscard]] ShaderTexts ray_shaders(const RayVariant& variant);

/// Rays through the volume into a framebuffer with colour and stencil: the hull marks the pixels, then each of them is
/// traced once.
class VolumePass {
 public:
  /// errors  unsupported: the driver does not take a shader
  [[nodiscard]] Result<void> prepare(const RayVariant& variant);
  void set_hull(const GridAxes& axes);
  /// textures  [unit]; 0 = none. Needs PlainState. `prepare` came first.
  void draw(const RayVariant& variant, const RayBlock& block, std::span<const unsigned> textures);

 private:
  void mark() const;
  Program hull_program_;
  std::map<RayVariant, Program> programs_;
  Buffer hull_;
  Buffer block_;
  VertexArray hull_shape_;
  VertexArray no_shape_;
  int hull_corners_ = 0;
};

}  // namespace sonar
