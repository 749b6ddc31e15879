// SPDX-License-Identifier: Apache-2.0
// The macrocells: what may be passed over, and how far.
uniform usampler2D state_texture;  // distance to the next cell that counts; flags
uniform sampler2D means_texture;   // of thin cells: mean extinction x rgb, mean extinction
uniform isampler2D largest_texture;
uniform sampler2D faces_texture;  // row 0: sine, cosine, beams a radian, of each beam; row 1: sine^2, -, fans a radian

const uint THIN = 1u;
const uint GAPS = 2u;
const uint MASKED = 4u;

ivec3 cell_of(vec3 g) {
  return clamp(ivec3(floor(g * vec3(1.0 / float(CELL_SAMPLES), 1.0, 1.0))), ivec3(0), ray.cells.xyz - 1);
}

ivec2 cell_texel(ivec3 cell) {
  int i = (cell.z * ray.cells.y + cell.y) * ray.cells.x + cell.x;
  return ivec2(i & (CELL_ROW - 1), i / CELL_ROW);
}

// The smaller of both t that lies behind `now`.
float next_root(float now, float a, float b) { return min(a > now ? a : FAR, b > now ? b : FAR); }

// At a face, within what indices are wrong by, and moving towards it.
bool at_face(float rate, float index, int low, int high) {
  return (rate < 0.0 && index - float(low) < 4e-3) || (rate > 0.0 && float(high) - index < 4e-3);
}

// Where a ray leaves the block of cells that reach `around` cells to each side of the one of index g; never later than
// that. `now` where it stands at the block's face: it may be past it already, and then the root lies behind it and would
// be missed, the whole way along a face that a ray grazes.
float block_exit(vec3 g, int around, float now) {
  ivec3 cell = cell_of(g);
  ivec3 low = max(cell - around, ivec3(0));
  ivec3 high = min(cell + 1 + around, ray.cells.xyz);
  float near_r = ray.range.x + float(low.x * CELL_SAMPLES) * ray.range.z;
  float far_r = ray.range.x + float(high.x * CELL_SAMPLES) * ray.range.z;
  float t = sqrt(max(far_r * far_r - base2, 0.0));
  float in2 = near_r * near_r - base2;
  float inner = -sqrt(max(in2, 0.0));
  t = near_r > 0.0 && in2 > 0.0 && inner > now ? min(t, inner) : t;

  // Along a straight ray the azimuth turns one way only.
  float turning = base.x * dir.y - base.y * dir.x;
  bool rising = turning > 0.0;
  vec3 p = base + now * dir;
  float climbing = p.z * now - dir.z * (base2 + now * now);
  if (at_face(turning, g.y, low.y, high.y) || at_face(climbing, g.z, low.z, high.z) ||
      at_face(now, g.x, low.x * CELL_SAMPLES, high.x * CELL_SAMPLES)) {
    return now;
  }
  vec2 side = texelFetch(faces_texture, ivec2(rising ? high.y : low.y, 0), 0).xy;
  float v1 = side.x * dir.x - side.y * dir.y;
  float at_side = v1 == 0.0 ? FAR : -(side.x * base.x - side.y * base.y) / v1;
  t = at_side > now ? min(t, at_side) : t;

  vec2 s2 = vec2(texelFetch(faces_texture, ivec2(low.z, 1), 0).x, texelFetch(faces_texture, ivec2(high.z, 1), 0).x);
  vec2 a = dir.z * dir.z - s2;
  a = mix(a, vec2(-1e-12), lessThan(abs(a), vec2(1e-12)));
  float b = base.z * dir.z;
  vec2 c = base.z * base.z - s2 * base2;
  vec2 disc = b * b - a * c;
  vec2 q = -(b + (b < 0.0 ? -1.0 : 1.0) * sqrt(max(disc, vec2(0.0))));
  vec2 first = q / a;
  vec2 second = mix(c / q, first, equal(q, vec2(0.0)));
  t = disc.x >= 0.0 ? min(t, next_root(now, first.x, second.x)) : t;
  return disc.y >= 0.0 ? min(t, next_root(now, first.y, second.y)) : t;
}
