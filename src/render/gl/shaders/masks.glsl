// SPDX-License-Identifier: Apache-2.0
// The schools' masks: layer << 8 | confidence of each voxel. A layer is interpolated over its own voxels.
uniform usampler3D mask_texture;
uniform sampler2D mask_colours;  // [layer - 1]
uint surface_met[MASK_WORDS];
const uint NO_LAYER = 256u;
float masks_to = 0.0;     // t up to which masks have been met
bool near_masks = false;  // the last sample lay in a cell with masks: one more is taken behind it

uint mask_texel(ivec3 i, ivec3 corner) {
#if FOLDED
  Fold fold = fold_of(vec3(i));
  return texelFetch(mask_texture, i + corner + ivec3(fold.origin), 0)[fold.channel];
#else
  return texelFetch(mask_texture, i + corner, 0).r;
#endif
}

// The voxels round a place.
struct MaskCorners {
  vec3 p;
  ivec3 corner;
  vec3 f;
  uint voxel[8];
};

MaskCorners mask_corners(float t) {
  MaskCorners c;
  c.p = base + t * dir;
  vec3 g = index_of(c.p, sqrt(base2 + t * t));
  c.corner = corner_of(g);
  c.f = g - vec3(c.corner);
  for (int i = 0; i < 8; ++i) c.voxel[i] = mask_texel(c.corner, ivec3(i & 1, (i >> 1) & 1, i >> 2));
  return c;
}

uint next_layer(MaskCorners c, uint above) {
  uint next = NO_LAYER;
  for (int i = 0; i < 8; ++i) next = (c.voxel[i] >> 8) > above ? min(next, c.voxel[i] >> 8) : next;
  return next;
}

float own_value(uint voxel, uint layer) { return (voxel >> 8) == layer ? float(voxel & 255u) / 255.0 : 0.0; }

float confidence_of(MaskCorners c, uint layer) {
  float sum = 0.0;
  for (int i = 0; i < 8; ++i) {
    vec3 w = mix(1.0 - c.f, c.f, vec3(i & 1, (i >> 1) & 1, i >> 2));
    sum += w.x * w.y * w.z * own_value(c.voxel[i], layer);
  }
  return sum;
}

// Where between two places a layer's confidence reaches a level, or falls below it where it does not rise.
float mask_crossing(uint layer, float low, float high, float level, bool rises) {
  for (int i = 0; i < MASK_HALVINGS; ++i) {
    float middle = 0.5 * (low + high);
    bool later = (confidence_of(mask_corners(middle), layer) >= level) != rises;
    low = later ? middle : low;
    high = later ? high : middle;
  }
  return high;
}

vec3 surface_colour(vec3 colour, uint layer, float t, float level) {
#if LIT
  MaskCorners c;
  for (int i = 1; i >= 0; --i) {
    c = mask_corners(t + 0.5 * float(i) * ray.up.w);
    if (confidence_of(c, layer) >= level) break;
  }
  float value[8];
  for (int i = 0; i < 8; ++i) value[i] = own_value(c.voxel[i], layer);
  return lit(colour, in_metres(slope_of(value, c.f), c.corner, c.p) * 1e6, 1.0);
#else
  return colour;
#endif
}

// Of a layer, metres up to t that lie in its core.
float in_core(uint layer, float first, float last, float t) {
  bool begins = first >= ray.mask.y;
  bool ends = last >= ray.mask.y;
  if (begins == ends) return begins ? t - masks_to : 0.0;
  float at = mask_crossing(layer, masks_to, t, ray.mask.y, ends);
  return ends ? t - at : at - masks_to;
}

// Lays surfaces up to t over what lies behind; returns emission and extinction of the cores up to `end`, times metres.
vec4 meet_masks(float t, float end) {
  MaskCorners before = mask_corners(masks_to);
  MaskCorners here = mask_corners(t);
  float level = max(ray.mask.x, 0.5 / 255.0);
  vec4 core = vec4(0.0);
  uint layer = 0u;
  for (int i = 0; i < 16; ++i) {
    // The lowest number first.
    layer = min(next_layer(before, layer), next_layer(here, layer));
    if (layer == NO_LAYER) break;
    float first = confidence_of(before, layer);
    float last = confidence_of(here, layer);
    vec3 colour = texelFetch(mask_colours, ivec2(int(layer) - 1, 0), 0).rgb;
    uint bit = 1u << (layer & 31u);
    uint word = layer >> 5;
    if ((surface_met[word] & bit) == 0u && last >= level) {
      surface_met[word] |= bit;
      float at = first >= level ? masks_to : mask_crossing(layer, masks_to, t, level, true);
      lay_over(surface_colour(colour, layer, at, level), ray.mask.z, at);
    }
    if (ray.mask.w <= 0.0) continue;
    if (end > t) last = confidence_of(mask_corners(end), layer);
    core += ray.mask.w * in_core(layer, first, last, end) * vec4(colour, 1.0);
  }
  return core;
}
