// SPDX-License-Identifier: Apache-2.0
// The schools' masks: layer << 8 | confidence of each voxel. A layer is interpolated over its own voxels.
uniform usampler3D mask_texture;
uniform sampler2D mask_colours;  // [layer - 1]
uint surface_met[MASK_WORDS];
const uint NO_LAYER = 256u;

uint mask_texel(ivec3 i, ivec3 corner) {
#if FOLDED
  Fold fold = fold_of(vec3(i));
  return texelFetch(mask_texture, i + corner + ivec3(fold.origin), 0)[fold.channel];
#else
  return texelFetch(mask_texture, i + corner, 0).r;
#endif
}

// Lays surfaces over what lies behind; returns emission and extinction of the cores.
vec4 meet_masks(vec3 g, vec3 p, float t) {
  ivec3 corner = corner_of(g);
  vec3 f = g - vec3(corner);
  uint layer[8];
  float confidence[8];
  float weight[8];
  for (int i = 0; i < 8; ++i) {
    ivec3 at = ivec3(i & 1, (i >> 1) & 1, i >> 2);
    uint voxel = mask_texel(corner, at);
    layer[i] = voxel >> 8;
    confidence[i] = float(voxel & 255u) / 255.0;
    vec3 w = mix(1.0 - f, f, vec3(at));
    weight[i] = w.x * w.y * w.z;
  }
  vec4 core = vec4(0.0);
  uint mine = 0u;
  for (int i = 0; i < 8; ++i) {
    // The lowest number first.
    uint next = NO_LAYER;
    for (int k = 0; k < 8; ++k) next = layer[k] > mine ? min(next, layer[k]) : next;
    if (next == NO_LAYER) break;
    mine = next;
    float value[8];
    float sum = 0.0;
    for (int k = 0; k < 8; ++k) {
      value[k] = layer[k] == mine ? confidence[k] : 0.0;
      sum += weight[k] * value[k];
    }
    vec3 colour = texelFetch(mask_colours, ivec2(int(mine) - 1, 0), 0).rgb;
    uint bit = 1u << (mine & 31u);
    uint word = mine >> 5;
    if ((surface_met[word] & bit) == 0u && sum >= max(ray.mask.x, 0.5 / 255.0)) {
      surface_met[word] |= bit;
#if LIT
      vec3 shown = lit(colour, in_metres(slope_of(value, f), corner, p) * 1e6, 1.0);
#else
      vec3 shown = colour;
#endif
      lay_over(shown, ray.mask.z, t);
    }
    if (sum >= ray.mask.y) core += ray.mask.w * vec4(colour, 1.0);
  }
  return core;
}
