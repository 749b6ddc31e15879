// SPDX-License-Identifier: Apache-2.0
// Places to fractional indices (sample, beam, fan), and values there, by the folded texture where there are folds.
uniform sampler3D sv_texture;
uniform sampler3D known_texture;
uniform sampler2D angle_texture;  // row 0 beams, row 1 fans: index, and its rise to the next entry

float angle_index(int row, float at) {
  float u = clamp(at, 0.0, float(ANGLE_ENTRIES - 1));
  int k = int(u);
  vec2 entry = texelFetch(angle_texture, ivec2(k, row), 0).rg;
  return entry.x + (u - float(k)) * entry.y;
}

// atan for -1..1, off by 2e-6 at most (a polynomial of least largest error). On a processor, where each ray fetches for
// itself, this costs a fraction of a look at the table.
float arc(float t) {
  float u = t * t;
  return t * (0.999977219 + u * (-0.332622829 + u * (0.193540379 + u * (-0.116426483 + u * (0.052647348 + u * -0.011719133)))));
}

float beam_of(vec3 p) {
#if EVEN_BEAMS
  return clamp((arc(p.y / max(p.x, 1e-20)) - ray.angle.x) * ray.angle.y, 0.0, float(ray.size.y - 1));
#else
  float side = p.y / max(abs(p.x) + abs(p.y), 1e-20);
#if WIDE
  side = p.x >= 0.0 ? side : (p.y < 0.0 ? -2.0 : 2.0) - side;
#endif
  return angle_index(0, (side - ray.angle.x) * ray.angle.y);
#endif
}

float fan_of(vec3 p) {
  float rho = length(p.xy);
#if EVEN_FANS
  return clamp((arc(-p.z / max(rho, 1e-20)) - ray.angle.z) * ray.angle.w, 0.0, float(ray.size.z - 1));
#else
  return angle_index(1, (-p.z / max(rho + abs(p.z), 1e-20) - ray.angle.z) * ray.angle.w);
#endif
}

vec3 index_of(vec3 p, float r) { return vec3((r - ray.range.x) * ray.range.y, beam_of(p), fan_of(p)); }

#if FOLDED
struct Fold {
  vec3 origin;  // of the piece in the texture, minus the index that lies there
  int channel;
};

Fold fold_of(vec3 g) {
  vec3 piece = clamp(floor(g / ray.stride.xyz), vec3(0.0), vec3(ray.pieces.xyz - 1));
  ivec3 p = ivec3(piece);
  int number = (p.z * ray.pieces.y + p.y) * ray.pieces.x + p.x;
  int channels = int(ray.stride.w);
  int slot = number / channels;
  vec2 rows = vec2(slot % ray.pieces.w, slot / ray.pieces.w) * ray.stack.xy + ray.stack.zw;
  return Fold(vec3(0.0, rows) - piece * ray.stride.xyz, number % channels);
}

float channel_of(vec4 value, int channel) { return dot(value, vec4(equal(ivec4(channel), ivec4(0, 1, 2, 3)))); }

float sv_at(vec3 g) {
  Fold fold = fold_of(g);
  return channel_of(textureLod(sv_texture, (g + fold.origin + 0.5) * ray.texel.xyz, 0.0), fold.channel) * ray.table.w;
}

float known_at(vec3 g) {
  Fold fold = fold_of(g);
  return channel_of(textureLod(known_texture, (g + fold.origin + 0.5) * ray.texel.xyz, 0.0), fold.channel);
}

float sv_texel(ivec3 i, ivec3 corner) {
  Fold fold = fold_of(vec3(i));
  return channel_of(texelFetch(sv_texture, i + corner + ivec3(fold.origin), 0), fold.channel) * ray.table.w;
}
#else
float sv_at(vec3 g) { return textureLod(sv_texture, (g + 0.5) * ray.texel.xyz, 0.0).r * ray.table.w; }
float known_at(vec3 g) { return textureLod(known_texture, (g + 0.5) * ray.texel.xyz, 0.0).r; }
float sv_texel(ivec3 i, ivec3 corner) { return texelFetch(sv_texture, i + corner, 0).r * ray.table.w; }
#endif

// Lowest corner of the voxel cell that holds a place.
ivec3 corner_of(vec3 g) { return clamp(ivec3(floor(g)), ivec3(0), ray.size.xyz - 2); }

// Change of a field with the index, from the corner values of its voxel cell: exact, not by differences.
// v[i]: bit 0 one sample on, bit 1 one beam on, bit 2 one fan on; f: place in the cell, 0..1
vec3 slope_of(float v[8], vec3 f) {
  vec4 low = vec4(v[0], v[2], v[4], v[6]);
  vec4 high = vec4(v[1], v[3], v[5], v[7]);
  vec4 along = high - low;
  vec4 at = mix(low, high, f.x);
  float by_sample = mix(mix(along.x, along.y, f.y), mix(along.z, along.w, f.y), f.z);
  float by_beam = mix(at.y - at.x, at.w - at.z, f.z);
  float by_fan = mix(at.z - at.x, at.w - at.y, f.y);
  return vec3(by_sample, by_beam, by_fan);
}
