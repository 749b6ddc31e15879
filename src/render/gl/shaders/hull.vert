// SPDX-License-Identifier: Apache-2.0
// The sector's surface, seen by the rays' camera, upside down like the picture (its first row is the upper one).
layout(location = 0) in vec3 place;
out float gl_ClipDistance[1];

void main() {
  vec3 seen = place - ray.eye.xyz;
  float depth = dot(seen, ray.forward.xyz);
  vec2 size = vec2(ray.picture.xy);
  vec2 across = vec2(dot(seen, ray.right.xyz) * size.y / size.x, -dot(seen, ray.up.xyz));
  gl_Position = vec4(across / ray.right.w - 2.0 * ray.frame.xy / size * depth, 0.0, depth);
  // What lies above the sea is cut off, where the eye is there too: from below one may look out through the cut.
  gl_ClipDistance[0] = ray.eye.z < ray.forward.w ? place.z - ray.forward.w : 1.0;
}
