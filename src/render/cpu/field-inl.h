// SPDX-License-Identifier: Apache-2.0
// Values interpolated between eight samples, and their gradients; included once per target.
#if defined(SONAR_RENDER_CPU_FIELD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SONAR_RENDER_CPU_FIELD_INL_H_
#undef SONAR_RENDER_CPU_FIELD_INL_H_
#else
#define SONAR_RENDER_CPU_FIELD_INL_H_
#endif

#include "render/cpu/geometry-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sonar::HWY_NAMESPACE {

/// The eight corners of a voxel cell: [fan][beam], first and second sample.
struct Corners {
  V first[4];
  V second[4];
};

/// Derivatives by fan, beam and sample fraction.
struct Slope {
  V fan, beam, sample;
};

HWY_INLINE W voxel_of(const TraceGrid& grid, const Place& p) {
  const W row = hn::Add(hn::Mul(p.fan0, seti(grid.beams)), p.beam0);
  return hn::Add(hn::Mul(row, seti(grid.samples)), p.sample0);
}

/// Two neighbouring 16-bit samples of each of the four columns lie in one word: four gathers for eight corners.
HWY_INLINE void gather_columns(const TraceGrid& grid, const void* volume, W voxel, W out[4]) {
  const auto* base = static_cast<const std::uint16_t*>(volume);
  const W at = hn::ShiftLeft<1>(voxel);
  const std::ptrdiff_t fan = static_cast<std::ptrdiff_t>(grid.beams) * grid.samples;
  out[0] = gather_bytes(base, at);
  out[1] = gather_bytes(base + grid.samples, at);
  out[2] = gather_bytes(base + fan, at);
  out[3] = gather_bytes(base + fan + grid.samples, at);
}

HWY_INLINE Corners corners_of(const TraceGrid& grid, W voxel) {
  W word[4];
  gather_columns(grid, grid.sv, voxel, word);
  Corners out;
  for (int i = 0; i < 4; ++i) {
    out.first[i] = hn::ConvertTo(D(), hn::ShiftRight<16>(hn::ShiftLeft<16>(word[i])));
    out.second[i] = hn::ConvertTo(D(), hn::ShiftRight<16>(word[i]));
  }
  return out;
}

HWY_INLINE V value_of(const Corners& c, const Place& p) {
  const V a = lerp(c.first[0], c.second[0], p.sample);
  const V b = lerp(c.first[1], c.second[1], p.sample);
  const V e = lerp(c.first[2], c.second[2], p.sample);
  const V f = lerp(c.first[3], c.second[3], p.sample);
  return lerp(lerp(a, b, p.beam), lerp(e, f, p.beam), p.fan);
}

/// value_of() of what lies at p.
HWY_INLINE V value_at(const TraceGrid& grid, const Place& p) {
#if SONAR_PLAIN_LOADS
  if (grid.columns != nullptr) {
    const W row = hn::Add(hn::Mul(p.fan0, seti(grid.cell_beams)), p.beam0);
    V c[4];
    columns_at(grid.columns, hn::Add(hn::Mul(row, seti(grid.samples)), p.sample0), p.sample, c);
    return hn::Mul(lerp(lerp(c[0], c[1], p.beam), lerp(c[2], c[3], p.beam), p.fan), set(1.0F / kColumnParts));
  }
#endif
  return value_of(corners_of(grid, voxel_of(grid, p)), p);
}

HWY_INLINE Slope slope_of(const Corners& c, const Place& p) {
  V at[4];
  V step[4];
  for (int i = 0; i < 4; ++i) {
    at[i] = lerp(c.first[i], c.second[i], p.sample);
    step[i] = hn::Sub(c.second[i], c.first[i]);
  }
  return {hn::Sub(lerp(at[2], at[3], p.beam), lerp(at[0], at[1], p.beam)),
          lerp(hn::Sub(at[1], at[0]), hn::Sub(at[3], at[2]), p.fan),
          lerp(lerp(step[0], step[1], p.beam), lerp(step[2], step[3], p.beam), p.fan)};
}

/// Share of known samples.
HWY_INLINE V share_of(const TraceGrid& grid, W voxel, const Place& p) {
  const std::ptrdiff_t fan = static_cast<std::ptrdiff_t>(grid.beams) * grid.samples;
  const std::ptrdiff_t column[4] = {0, grid.samples, fan, fan + grid.samples};
  Corners c;
  for (int i = 0; i < 4; ++i) {
    const W word = gather_bytes(grid.known + column[i], voxel);
    c.first[i] = hn::ConvertTo(D(), hn::And(word, seti(0xFF)));
    c.second[i] = hn::ConvertTo(D(), hn::And(hn::ShiftRight<8>(word), seti(0xFF)));
  }
  return value_of(c, p);
}

struct Gradient {
  V x, y, z;
};

/// Per metre: e_r dv/dr + e_az (1/rho) dv/daz + e_el (1/r) dv/del.
HWY_INLINE Gradient gradient_of(const TraceGrid& grid, const Place& p, const Slope& s) {
  const V rho = hn::Max(p.rho, set(1e-6F));
  const V r = hn::Max(p.r, set(1e-6F));
  const V along = hn::Div(hn::Mul(s.sample, set(grid.per_spacing)), r);
  const V side = hn::Div(hn::Mul(s.beam, hn::GatherIndex(D(), grid.beams_per_rad, p.beam0)), hn::Mul(rho, rho));
  const V up = hn::Div(hn::Mul(s.fan, hn::GatherIndex(D(), grid.fans_per_rad, p.fan0)), hn::Mul(r, r));
  const V up_side = hn::Div(hn::Mul(up, p.z), rho);  // e_el = (z x / rho, z y / rho, -rho) / r
  return {hn::MulAdd(p.x, hn::Add(along, up_side), hn::Neg(hn::Mul(p.y, side))),
          hn::MulAdd(p.y, hn::Add(along, up_side), hn::Mul(p.x, side)), hn::NegMulAdd(rho, up, hn::Mul(p.z, along))};
}

/// lit() of ray_rules.h, colours changed in place. `scale` makes the gradient one of dB.
HWY_INLINE void light(const TraceView& view, const Rays& ray, const Gradient& g, float scale, Rgb& rgb, V sky) {
  const V length2 = hn::MulAdd(g.x, g.x, hn::MulAdd(g.y, g.y, hn::Mul(g.z, g.z)));
  const V length = hn::Max(root(length2), set(1e-20F));
  const V per = hn::Div(set(-1.0F), length);
  const V nx = hn::Mul(g.x, per);
  const V ny = hn::Mul(g.y, per);
  const V nz = hn::Mul(g.z, per);
  const V w = hn::Min(hn::Mul(length, set(scale / view.lighting.full_gradient_db_per_m)), set(1.0F));
  const V lx = set(view.light[0]);
  const V ly = set(view.light[1]);
  const V lz = set(view.light[2]);
  const V toward = hn::Max(hn::MulAdd(nx, lx, hn::MulAdd(ny, ly, hn::Mul(nz, lz))), zero());
  const V hx = hn::Sub(lx, ray.dx);
  const V hy = hn::Sub(ly, ray.dy);
  const V hz = hn::Sub(lz, ray.dz);
  const V half = root(hn::MulAdd(hx, hx, hn::MulAdd(hy, hy, hn::Mul(hz, hz))));
  V gloss = hn::Div(hn::MulAdd(nx, hx, hn::MulAdd(ny, hy, hn::Mul(nz, hz))), hn::Max(half, set(1e-20F)));
  gloss = hn::Max(gloss, zero());
  for (int i = 0; i < 4; ++i) gloss = hn::Mul(gloss, gloss);
  const V shade = hn::MulAdd(toward, set(view.lighting.diffuse), hn::Mul(sky, set(view.lighting.ambient)));
  const V factor = hn::MulAdd(w, hn::Sub(shade, set(1.0F)), set(1.0F));
  const V white = hn::Mul(hn::Mul(w, set(view.lighting.specular)), gloss);
  rgb.r = hn::MulAdd(rgb.r, factor, white);
  rgb.g = hn::MulAdd(rgb.g, factor, white);
  rgb.b = hn::MulAdd(rgb.b, factor, white);
}

}  // namespace sonar::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SONAR_RENDER_CPU_FIELD_INL_H_
