// SPDX-License-Identifier: Apache-2.0
// The part of a ray that lies in the sector, exactly. t is metres from the ray's point nearest to the transducer:
// p = base + t dir with base dir = 0, so that r^2 = base^2 + t^2.
const float FAR = 1e9;
vec3 base;
vec3 dir;
float base2;

#if OPAQUE
uniform sampler2D opaque_texture;  // metres from the eye, of each pixel of the full picture
#endif

// First and last t where the quadric through the apex around the z axis, sine s, is on the side of `sign` of z.
vec2 cone_span(float s, float side) {
  float z0 = side * base.z;
  float z1 = side * dir.z;
  float a = z1 * z1 - s * s;
  a = abs(a) < 1e-12 ? -1e-12 : a;
  float b = z0 * z1;
  float c = z0 * z0 - s * s * base2;
  float disc = b * b - a * c;
  if (a < 0.0 && disc < 0.0) return vec2(FAR, -FAR);
  float q = -(b + (b < 0.0 ? -1.0 : 1.0) * sqrt(max(disc, 0.0)));
  float first = q / a;
  float second = q == 0.0 ? first : c / q;
  vec2 roots = vec2(min(first, second), max(first, second));
  if (a < 0.0) return z0 + z1 * 0.5 * (roots.x + roots.y) >= 0.0 ? roots : vec2(FAR, -FAR);
  return z1 > 0.0 ? vec2(roots.y, FAR) : vec2(-FAR, roots.x);
}

// First and last t where v0 + t v1 >= 0.
vec2 half_span(float v0, float v1) {
  if (abs(v1) < 1e-12) return v0 >= 0.0 ? vec2(-FAR, FAR) : vec2(FAR, -FAR);
  float t = -v0 / v1;
  return v1 > 0.0 ? vec2(t, FAR) : vec2(-FAR, t);
}

vec2 both(vec2 a, vec2 b) { return vec2(max(a.x, b.x), min(a.y, b.y)); }

vec2 sphere_span(float radius) {
  float half2 = radius * radius - base2;
  return half2 > 0.0 ? vec2(-1.0, 1.0) * sqrt(half2) : vec2(FAR, -FAR);
}

#define HOLES (INNER + WIDE + LOW_HOLE + HIGH_HOLE)
#if HOLES > 0
vec2 hole[HOLES];  // parts that are left out, first ones first
#endif

// Sets the ray, its holes, and returns the span that holds all of it in the sector; empty where x >= y.
vec2 ray_in_sector(vec3 eye, vec3 direction, ivec2 pixel) {
  dir = direction;
  float at_eye = dot(eye, direction);
  base = eye - at_eye * direction;
  base2 = dot(base, base);
  vec2 span = both(sphere_span(ray.sides.w), half_span(base.z - ray.forward.w, dir.z));
  span.x = max(span.x, at_eye);
  int holes = 0;
  vec2 right = half_span(base.x * ray.sides.x - base.y * ray.sides.y, dir.x * ray.sides.x - dir.y * ray.sides.y);
  vec2 left = half_span(base.x * ray.sides.x + base.y * ray.sides.y, dir.x * ray.sides.x + dir.y * ray.sides.y);
#if WIDE
  vec2 not_right = right.y < right.x ? vec2(-FAR, FAR) : (right.x > -FAR ? vec2(-FAR, right.x) : vec2(right.y, FAR));
  vec2 not_left = left.y < left.x ? vec2(-FAR, FAR) : (left.x > -FAR ? vec2(-FAR, left.x) : vec2(left.y, FAR));
  hole[holes++] = both(not_right, not_left);
#else
  span = both(span, both(right, left));
#endif
  vec2 low = cone_span(ray.cones.x, LOW_HOLE == 1 ? 1.0 : -1.0);
  vec2 high = cone_span(ray.cones.y, HIGH_HOLE == 1 ? -1.0 : 1.0);
#if LOW_HOLE
  hole[holes++] = low;
#else
  span = both(span, low);
#endif
#if HIGH_HOLE
  hole[holes++] = high;
#else
  span = both(span, high);
#endif
#if INNER
  hole[holes++] = sphere_span(ray.sides.z);
#endif
#if HOLES > 1
  for (int i = 0; i + 1 < HOLES; ++i) {
    for (int k = 0; k + 1 < HOLES - i; ++k) {
      vec2 a = hole[k];
      vec2 b = hole[k + 1];
      hole[k] = a.x <= b.x ? a : b;
      hole[k + 1] = a.x <= b.x ? b : a;
    }
  }
#endif
#if OPAQUE
  span.y = min(span.y, at_eye + texelFetch(opaque_texture, pixel, 0).r);
#endif
  return span;
}

// Moves t out of the holes; returns where the next one, or the span, begins or ends.
float piece_end(inout float t, float last) {
  float end = last;
#if HOLES > 0
  for (int i = 0; i < HOLES; ++i) t = t >= hole[i].x && t < hole[i].y ? hole[i].y : t;
  for (int i = 0; i < HOLES; ++i) end = hole[i].x >= t && hole[i].y > hole[i].x ? min(end, hole[i].x) : end;
#endif
  return end;
}
