// SPDX-License-Identifier: Apache-2.0
// One ray through the sonar's own grid: what it does is ACCUMULATES, SURFACE (it ends there), MAXIMUM.
uniform sampler2D optics_texture;  // r, g, b, extinction at fine steps of Sv
layout(location = 0) out vec4 colour;

float largest = -1e9;  // counts
float largest_t = 0.0;
float hit_low = 0.0;   // t of the last place below the level of first hit, and of the first one above
float hit_high = FAR;

#if !MASKS
float masks_to = 0.0;
const bool near_masks = false;
#endif

vec4 optics(float counts) {
  float entry = clamp(counts * ray.table.x + ray.table.y, 0.0, ray.table.z);
  return texelFetch(optics_texture, ivec2(int(entry + 0.5), 0), 0);
}

// masks_end: t up to which masks are met with it
void take_sample(float t, float length_m, uint flags, float before, float masks_end) {
  vec3 p = base + t * dir;
  vec3 g = index_of(p, sqrt(base2 + t * t));
  vec4 sum = vec4(0.0);
#if DATA
  float counts = sv_at(g);
#if GAPPED
  float share = (flags & GAPS) != 0u ? known_at(g) : 1.0;
#else
  const float share = 1.0;
#endif
#if SURFACE
  if (share >= 0.5 && counts >= ray.range.w) {
    hit_low = before;
    hit_high = t;
#if MASKS
    near_masks = near_masks || (flags & MASKED) != 0u;
#endif
    return;
  }
#endif
#endif
#if MASKS
  bool here = (flags & MASKED) != 0u;
  if (here || near_masks) sum = meet_masks(t, masks_end) / length_m;
  near_masks = here;
  masks_to = masks_end;
#endif
#if DATA
#if ACCUMULATES
  vec4 seen = optics(counts);
#if LIT
  if (seen.a > 0.0) seen.rgb = lit(seen.rgb, sv_gradient(g, p), 1.0);
#endif
  sum += share * seen.a * vec4(seen.rgb, 1.0);
#elif MAXIMUM
  if (share >= 0.5 && counts > largest) {
    largest = counts;
    largest_t = t;
  }
#endif
#endif
#if ACCUMULATES || MASKS
  lay(sum, length_m, t);
#endif
}

void end_hit() {
  if (hit_high >= FAR) return;
  for (int i = 0; i < 12; ++i) {
    float middle = 0.5 * (hit_low + hit_high);
    bool above = sv_at(index_of(base + middle * dir, sqrt(base2 + middle * middle))) >= ray.range.w;
    hit_high = above ? middle : hit_high;
    hit_low = above ? hit_low : middle;
  }
#if MASKS
  float before = max(hit_high, masks_to);
  if (near_masks) lay(meet_masks(before, before), 1.0, hit_high);
#endif
  vec3 p = base + hit_high * dir;
  vec3 g = index_of(p, length(p));
  vec3 shown = optics(sv_at(g)).rgb;
#if LIT
  vec3 gradient = sv_gradient(g, p);
  shown = lit(shown, gradient, sky_over(p, gradient));
#endif
  lay_over(shown, 1.0, hit_high);
}

void climb(float t) {
  vec3 p = base + t * dir;
  vec3 g = index_of(p, sqrt(base2 + t * t));
  float counts = sv_at(g);
  if (counts <= largest || !is_known(g, p)) return;
  largest = counts;
  largest_t = t;
}

void end_maximum(vec2 span) {
  if (largest <= -1e9) return;
  // The peak between samples.
  float reach = ray.up.w;
  for (int i = 0; i < CLIMBS; ++i) {
    reach *= 0.5;
    float middle = largest_t;
    climb(max(middle - reach, span.x));
    climb(min(middle + reach, span.y));
  }
  vec4 seen = optics(largest);
  if (seen.a > 0.0) lay_over(seen.rgb, 1.0, largest_t);
}

float phase_of(ivec2 pixel) {
  if (ray.eye.w < 0.0) return 0.5;
  float noise = fract(52.9829189 * fract(0.06711056 * float(pixel.x) + 0.00583715 * float(pixel.y)));
  return fract(noise + ray.eye.w);
}

// Step near the transducer, where beams are narrow: halved until it is below half a beam, to an eighth at least.
// Rays along the beams take half steps, see ray_rules.h.
float step_at(float r, float t) {
  float h = abs(t) > ALONG_BEAMS * r ? 0.5 * ray.up.w : ray.up.w;
  if (r >= ray.cones.z) return h;
  float part = r / max(ray.cones.z, 1e-6);
  return h * (part > 0.5 ? 0.5 : (part > 0.25 ? 0.25 : 0.125));
}

// The next multiple of h. Far out, after tens of thousands of steps, it may round to where the ray is: then one step on.
float step_after(float t, float h) {
  float multiple = (floor(t / h + 1e-3) + 1.0) * h;
  return multiple > t ? multiple : t + h;
}

bool going() { return through > 0.01 && hit_high >= FAR; }

void walk(vec2 span, float phase) {
  float t = span.x;
  masks_to = t;
  while (t < span.y && going()) {
    float left = t;
    float end = piece_end(t, span.y);
    if (t != left) masks_to = t;
    if (t >= end) continue;
    float r = sqrt(base2 + t * t);
    float h = step_at(r, t);
    float next = min(step_after(t, h), end);
    float at = mix(t, next, phase);
    vec3 g = index_of(base + at * dir, sqrt(base2 + at * at));
    ivec3 cell = cell_of(g);
    uvec2 state = texelFetch(state_texture, cell_texel(cell), 0).rg;
    float leave = block_exit(g, max(int(state.r) - 1, 0), at);
    leave = r < ray.cones.z ? min(leave, at + 4.0 * h) : leave;
    bool behind_masks = near_masks && (state.g & MASKED) == 0u;
    if (behind_masks) leave = at;
#if MAXIMUM
    bool empty = state.r > 0u || ((state.g & MASKED) == 0u && float(texelFetch(largest_texture, cell_texel(cell), 0).r) <= largest);
#else
    bool empty = state.r > 0u;
#endif
    // Steps lie at multiples of h whatever is passed over, so that a picture does not hang on the transfer function.
    float beyond = min(max(next, ceil(leave / h - phase) * h), end);
    if (empty && !behind_masks) {
      masks_to = min(leave, end);
      t = beyond;
      continue;
    }
#if ACCUMULATES
    if ((state.g & THIN) != 0u && !behind_masks && abs(at) <= ALONG_BEAMS * r) {
      masks_to = min(leave, end);
      float stop = min(max(next, floor(leave / h + 0.5) * h), end);
      lay(texelFetch(means_texture, cell_texel(cell), 0), stop - t, 0.5 * (t + stop));
      t = stop;
      continue;
    }
#endif
    float start = t;
    do {
      take_sample(at, next - t, state.g, max(start, at - h), next >= end ? end : at);
      t = next;
      next = min(step_after(t, h), end);
      at = mix(t, next, phase);
    } while (at < leave && t < end && going());
  }
}

void main() {
  ivec2 pixel = min(ivec2(gl_FragCoord.xy) * ray.picture.z + ray.picture.z / 2, ray.picture.xy - 1);
  vec2 size = vec2(ray.picture.xy);
  vec2 at = (vec2(pixel) + 0.5 + ray.frame.xy - 0.5 * size) * (2.0 / size.y) * ray.right.w;
  vec3 direction = normalize(ray.forward.xyz + at.x * ray.right.xyz - at.y * ray.up.xyz);
#if MASKS
  for (int i = 0; i < MASK_WORDS; ++i) surface_met[i] = 0u;
#endif
  vec2 span = ray_in_sector(ray.eye.xyz, direction, pixel);
#if CUED
  set_cue(dot(ray.eye.xyz, direction));
#endif
  walk(span, phase_of(pixel));
#if SURFACE
  end_hit();
#elif MAXIMUM
  end_maximum(span);
#endif
  // A ray that ended early is opaque: what it had not yet seen is taken to look like what it had.
  colour = through > 0.01 ? vec4(rgb, 1.0 - through) : vec4(rgb / (1.0 - through), 1.0);
}
