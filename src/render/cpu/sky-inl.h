// SPDX-License-Identifier: Apache-2.0
// Ambient light that reaches a surface, see ray_rules.h; included once per target.
#if defined(SONAR_RENDER_CPU_SKY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SONAR_RENDER_CPU_SKY_INL_H_
#undef SONAR_RENDER_CPU_SKY_INL_H_
#else
#define SONAR_RENDER_CPU_SKY_INL_H_
#endif

#include "render/cpu/field-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sonar::HWY_NAMESPACE {

/// Whether there is a value at p that counts, wherever p is.
HWY_INLINE M is_known(const TraceGrid& grid, const Place& p) {
  const M inside = is_inside(grid, p);
  return grid.known == nullptr ? inside : hn::And(inside, hn::Ge(share_of(grid, voxel_of(grid, p), p), set(0.5F)));
}

/// Where within occlusion_m Sv first reaches the level, 0..1.
HWY_INLINE V open_along(const TraceGrid& grid, const TraceView& view, const Rays& ray, V start) {
  const V step = set(view.lighting.occlusion_m / static_cast<float>(kSkySteps));
  V before = zero();  // counts above the level
  V open = set(1.0F);
  M going = hn::Lt(zero(), open);
  for (int i = 0; i < kSkySteps && any(going); ++i) {
    const Place p = place_at(grid, ray, hn::MulAdd(set(static_cast<float>(i + 1)), step, start));
    const V over = hn::IfThenElse(is_known(grid, p), hn::Sub(value_at(grid, p), set(view.first_hit_count)), set(-1.0F));
    const M met = hn::And(going, hn::Ge(over, zero()));
    const V part = hn::Div(before, hn::Min(hn::Sub(before, over), set(-1e-6F)));
    open = hn::IfThenElse(
        met, hn::Mul(hn::Add(set(static_cast<float>(i)), part), set(1.0F / static_cast<float>(kSkySteps))), open);
    going = hn::AndNot(met, going);
    before = hn::Min(over, zero());
  }
  return open;
}

/// Share of the ambient light that reaches a surface.
HWY_NOINLINE V sky_over(const TraceGrid& grid, const TraceView& view, const Place& p, const Gradient& g) {
  const V length2 = hn::MulAdd(g.x, g.x, hn::MulAdd(g.y, g.y, hn::Mul(g.z, g.z)));
  const V per = hn::Div(set(-1.0F), hn::Max(root(length2), set(1e-20F)));
  const V nx = hn::Mul(g.x, per);
  const V ny = hn::Mul(g.y, per);
  const V nz = hn::Mul(g.z, per);
  // Two tangents without a branch: Duff and others, Building an orthonormal basis, revisited, JCGT 6 (2017).
  const V side = hn::CopySign(set(1.0F), nz);
  const V a = hn::Div(set(-1.0F), hn::Add(side, nz));
  const V b = hn::Mul(hn::Mul(nx, ny), a);
  const V one[3] = {hn::MulAdd(hn::Mul(side, a), hn::Mul(nx, nx), set(1.0F)), hn::Mul(side, b),
                    hn::Neg(hn::Mul(side, nx))};
  const V two[3] = {b, hn::MulAdd(a, hn::Mul(ny, ny), side), hn::Neg(ny)};
  const V normal[3] = {nx, ny, nz};
  V sum = zero();
  for (const auto& d : view.sky) {
    const auto along = [&](int i) {
      return hn::MulAdd(set(d[0]), one[i], hn::MulAdd(set(d[1]), two[i], hn::Mul(set(d[2]), normal[i])));
    };
    Rays ray;
    ray.dx = along(0);
    ray.dy = along(1);
    ray.dz = along(2);
    const V start = begin_at(ray, p.x, p.y, p.z);
    sum = hn::Add(sum, open_along(grid, view, ray, start));
  }
  return hn::Mul(sum, set(1.0F / static_cast<float>(kSkyRays)));
}

}  // namespace sonar::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SONAR_RENDER_CPU_SKY_INL_H_
