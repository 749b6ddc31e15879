// SPDX-License-Identifier: Apache-2.0
// Light by the gradient in metres; the same words as lit() in render/ray_rules.h.
vec3 lit(vec3 rgb, vec3 gradient, float sky) {
  float strength = length(gradient);
  if (strength == 0.0) return rgb;
  vec3 n = -gradient / strength;
  float w = min(1.0, strength / ray.light.w);
  float diffuse = max(0.0, dot(n, ray.light.xyz));
  float gloss = pow(max(0.0, dot(n, normalize(ray.light.xyz - dir))), 16.0);
  float scale = 1.0 - w + w * (ray.lighting.x * sky + ray.lighting.y * diffuse);
  return rgb * scale + w * ray.lighting.z * gloss;
}

// A change by index (sample, beam, fan) turned into one a metre.
vec3 in_metres(vec3 slope, ivec3 corner, vec3 p) {
  float r = max(length(p), 1e-6);
  float rho = max(length(p.xy), 1e-6);
  float beams_a_rad = texelFetch(faces_texture, ivec2(corner.y, 0), 0).z;
  float fans_a_rad = texelFetch(faces_texture, ivec2(corner.z, 1), 0).z;
  vec3 outwards = p / r;
  vec3 aside = vec3(-p.y, p.x, 0.0) / rho;
  vec3 upwards = vec3(p.z * p.xy / (r * rho), -rho / r);
  return slope.x * ray.range.y * outwards + slope.y * beams_a_rad / rho * aside + slope.z * fans_a_rad / r * upwards;
}

vec3 sv_gradient(vec3 g, vec3 p) {
  ivec3 corner = corner_of(g);
  float v[8];
  for (int i = 0; i < 8; ++i) v[i] = sv_texel(corner, ivec3(i & 1, (i >> 1) & 1, i >> 2));
  return in_metres(slope_of(v, g - vec3(corner)), corner, p) * ray.lighting.w;
}
