// SPDX-License-Identifier: Apache-2.0
// What a picture depends on beside textures; the C++ side is RayBlock in render/gl/ray_block.h, line by line.
// All places and directions in the fan frame: x along the middle azimuth, y starboard of it, z down; metres.
layout(std140) uniform Ray {
  vec4 right;       // w: tangent of half the vertical field of view
  vec4 up;          // w: step h, m
  vec4 forward;     // w: z of the sea surface
  vec4 eye;         // w: offset of the jitter, 0..1; below 0 = samples at the middle of steps
  vec4 light;       // w: gradient that is lit in full, dB / m
  vec4 lighting;    // ambient, diffuse, specular; w: dB of one count
  vec4 sides;       // sine and cosine of half the width, nearest and farthest range, m
  vec4 cones;       // sines of the first and the last elevation, made positive; z: range below which steps shorten; w: how far off
                    // ambient light is kept from surfaces, m
  vec4 angle;       // first diamond angle and entries a unit: of the beams, of the fans; even ones: first angle and
                    // indices a radian
  vec4 range;       // first range, m; samples a metre; metres a sample; w: level of first hit, counts
  vec4 table;       // entries a count, entry of count 0, last entry; w: counts a unit of the volume's texture
  vec4 texel;       // 1 / size of the volume's texture
  vec4 stride;      // of the folds: range, beam, fan; w: channels
  vec4 stack;       // rows from piece to piece (beam, fan), border before (beam, fan)
  vec4 mask;        // fuzzy_above, core_at, fuzzy_opacity, core extinction, 1/m
  vec4 ground;      // background that things fade into; w: share of it at the far end
  vec4 frame;       // where in their pixels rays stand, off the middle (x, y); nearest depth that fades, m; 1 / the depth
                    // from there to the far end
  vec4 sky[SKY_RAYS];  // directions ambient light comes from: first tangent, second tangent, normal
  ivec4 picture;    // full size; divisor
  ivec4 cells;      // cells along range, beam, fan
  ivec4 pieces;     // of the folds along range, beam, fan; w: stacked along beam
  ivec4 size;       // samples, beams, fans
} ray;
