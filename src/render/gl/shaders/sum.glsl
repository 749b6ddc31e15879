// SPDX-License-Identifier: Apache-2.0
// What comes together along a ray, front to back.
vec3 rgb = vec3(0.0);
float through = 1.0;
#if CUED
vec2 pale;  // of this ray, over t: rise, and start
void set_cue(float at_eye) {
  float rise = dot(dir, ray.forward.xyz) * ray.frame.w;
  pale = vec2(rise, -at_eye * rise - ray.frame.z * ray.frame.w);
}
vec3 faded(vec3 emission, float weight, float t) {
  return mix(emission, weight * ray.ground.rgb, ray.ground.w * clamp(t * pale.x + pale.y, 0.0, 1.0));
}
#else
#define faded(emission, weight, t) (emission)
#endif

// Emission and extinction that go on over a length round t, in front of what lies behind.
void lay(vec4 emission, float length_m, float t) {
  float depth = emission.a * length_m;
  // (1 - exp(-x)) / x without the loss of digits at small x, where haze lives.
  float series = 1.0 - depth * (0.5 - depth * (1.0 / 6.0 - depth * (1.0 / 24.0 - depth * (1.0 / 120.0 - depth / 720.0))));
  float mean = depth < 0.5 ? series : (1.0 - exp(-depth)) / max(depth, 0.5);
  rgb += through * length_m * mean * faded(emission.rgb, emission.a, t);
  through *= 1.0 - depth * mean;
}

// A surface.
void lay_over(vec3 colour, float opacity, float t) {
  rgb += through * opacity * faded(colour, 1.0, t);
  through *= 1.0 - opacity;
}
