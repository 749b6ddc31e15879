// SPDX-License-Identifier: Apache-2.0
// Ambient light that reaches a surface; the rule is told in render/ray_rules.h.
bool is_inside(vec3 g, vec3 p) {
  vec3 last = vec3(ray.size.xyz - 1) - FACE_INDEX;
  return all(greaterThan(g, vec3(FACE_INDEX))) && all(lessThan(g, last)) && p.z >= ray.forward.w;
}

// Whether there is a value that counts, wherever the place is.
bool is_known(vec3 g, vec3 p) {
#if GAPPED
  return is_inside(g, p) && known_at(g) >= 0.5;
#else
  return is_inside(g, p);
#endif
}

// Where within the reach Sv first comes to the level, 0..1.
float open_along(vec3 p, vec3 out_there) {
  float before = 0.0;  // counts above the level
  for (int i = 0; i < SKY_STEPS; ++i) {
    vec3 q = p + out_there * (ray.cones.w * float(i + 1) / float(SKY_STEPS));
    vec3 g = index_of(q, length(q));
    float over = is_known(g, q) ? sv_at(g) - ray.range.w : -1.0;
    if (over >= 0.0) return (float(i) + before / min(before - over, -1e-6)) / float(SKY_STEPS);
    before = over;
  }
  return 1.0;
}

float sky_over(vec3 p, vec3 gradient) {
  if (ray.cones.w <= 0.0) return 1.0;
  vec3 n = -gradient / max(length(gradient), 1e-20);
  // Two tangents without a branch: Duff and others, Building an orthonormal basis, revisited, JCGT 6 (2017).
  float side = n.z < 0.0 ? -1.0 : 1.0;
  float a = -1.0 / (side + n.z);
  float b = n.x * n.y * a;
  mat3 turned = mat3(vec3(1.0 + side * n.x * n.x * a, side * b, -side * n.x), vec3(b, side + n.y * n.y * a, -n.y), n);
  float sum = 0.0;
  for (int i = 0; i < SKY_RAYS; ++i) sum += open_along(p, turned * ray.sky[i].xyz);
  return sum / float(SKY_RAYS);
}
