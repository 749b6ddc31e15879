// SPDX-License-Identifier: Apache-2.0
// A packet of rays against the sector and its cells; included once per target.
#if defined(SONAR_RENDER_CPU_GEOMETRY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SONAR_RENDER_CPU_GEOMETRY_INL_H_
#undef SONAR_RENDER_CPU_GEOMETRY_INL_H_
#else
#define SONAR_RENDER_CPU_GEOMETRY_INL_H_
#endif

#include "render/cpu/lookup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sonar::HWY_NAMESPACE {

/// Rays p = near + u d in the fan frame, `near` the point nearest to the transducer: r^2 = m2 + u^2, so that spheres,
/// cones and planes all have short and well-conditioned formulas.
struct Rays {
  V dx, dy, dz;
  V nx, ny, nz;
  V m2;
  V cone_a, cone_b, cone_d;  ///< dz^2, nz dz, nz^2 + m2 dz^2
};

/// Fills what follows from the direction and a place on the ray; returns u there.
HWY_INLINE V begin_at(Rays& ray, V x, V y, V z) {
  const V u = hn::MulAdd(x, ray.dx, hn::MulAdd(y, ray.dy, hn::Mul(z, ray.dz)));
  ray.nx = hn::NegMulAdd(u, ray.dx, x);
  ray.ny = hn::NegMulAdd(u, ray.dy, y);
  ray.nz = hn::NegMulAdd(u, ray.dz, z);
  ray.m2 = hn::MulAdd(ray.nx, ray.nx, hn::MulAdd(ray.ny, ray.ny, hn::Mul(ray.nz, ray.nz)));
  ray.cone_a = hn::Mul(ray.dz, ray.dz);
  ray.cone_b = hn::Mul(ray.nz, ray.dz);
  ray.cone_d = hn::MulAdd(ray.m2, ray.cone_a, hn::Mul(ray.nz, ray.nz));
  return u;
}

struct Place {
  V x, y, z, rho, r;
  V fan, beam, sample;  ///< fractions within the voxel cell
  W fan0, beam0, sample0;
};

HWY_INLINE V nearer_root(V best, V candidate, V after) {
  return hn::IfThenElse(hn::Gt(candidate, after), hn::Min(best, candidate), best);  // false for NaN
}

/// Where the plane of azimuth (sin, cos) is met.
HWY_INLINE V plane_root(const Rays& ray, V s, V c) {
  const V along = hn::MulSub(s, ray.dx, hn::Mul(c, ray.dy));
  const V at = hn::MulSub(c, ray.ny, hn::Mul(s, ray.nx));
  return hn::Mul(at, inverse(along));
}

/// Nearest meeting beyond `after` with the cone of sin^2 of an elevation: (dz^2 - S) u^2 + 2 nz dz u + nz^2 - S m2 = 0.
HWY_INLINE V nearer_cone(const Rays& ray, V s2, V best, V after) {
  const V disc = hn::Mul(s2, hn::NegMulAdd(s2, ray.m2, ray.cone_d));
  const M real = hn::Ge(disc, zero());
  const V sq = hn::CopySign(root(disc), ray.cone_b);
  const V q = hn::Neg(hn::Add(ray.cone_b, sq));
  const V c = hn::NegMulAdd(s2, ray.m2, hn::Mul(ray.nz, ray.nz));
  V out = nearer_root(best, hn::Mul(q, inverse(hn::Sub(ray.cone_a, s2))), after);
  out = nearer_root(out, hn::Mul(c, inverse(q)), after);
  return hn::IfThenElse(real, out, best);
}

/// Nearest meeting beyond `after` with the sphere of radius r.
HWY_INLINE V nearer_sphere(const Rays& ray, V r, V best, V after) {
  const V h2 = hn::MulSub(r, r, ray.m2);
  const V h = root(h2);
  const V out = nearer_root(nearer_root(best, h, after), hn::Neg(h), after);
  return hn::IfThenElse(hn::Gt(h2, zero()), out, best);
}

HWY_INLINE V sector_crossing(const TraceGrid& grid, const Rays& ray, V after, V best) {
  const V s = set(grid.sin_side);
  const V c = set(grid.cos_side);
  best = nearer_root(best, plane_root(ray, s, c), after);
  best = nearer_root(best, plane_root(ray, s, hn::Neg(c)), after);
  best = nearer_cone(ray, set(grid.sin_e0 * grid.sin_e0), best, after);
  best = nearer_cone(ray, set(grid.sin_e1 * grid.sin_e1), best, after);
  return nearer_sphere(ray, set(grid.nearest_m), best, after);
}

HWY_INLINE M in_sector(const TraceGrid& grid, const Rays& ray, V u) {
  const V x = hn::MulAdd(u, ray.dx, ray.nx);
  const V y = hn::MulAdd(u, ray.dy, ray.ny);
  const V z = hn::MulAdd(u, ray.dz, ray.nz);
  const V rho = root(hn::MulAdd(x, x, hn::Mul(y, y)));
  const V r = root(hn::MulAdd(u, u, ray.m2));
  const M side = hn::Ge(hn::Mul(x, set(grid.sin_side)), hn::Mul(hn::Abs(y), set(grid.cos_side)));
  const M low = hn::Le(hn::Mul(z, set(grid.cos_e0)), hn::Neg(hn::Mul(rho, set(grid.sin_e0))));
  const M high = hn::Ge(hn::Mul(rho, set(grid.sin_e1)), hn::Neg(hn::Mul(z, set(grid.cos_e1))));
  return hn::And(hn::And(side, hn::Ge(r, set(grid.nearest_m))), hn::And(low, high));
}

/// The next piece [from, to] of the rays of `lanes` inside the sector; from = to = last where there is none.
HWY_INLINE void next_piece(const TraceGrid& grid, const Rays& ray, M lanes, V last, V& from, V& to) {
  V start = from;
  M open = lanes;
  // Planes 2, cones 4, sphere 2: nine pieces at most.
  for (int i = 0; i < 10 && any(open); ++i) {
    const V end = sector_crossing(grid, ray, hn::Add(start, set(1e-3F)), last);
    const M in = hn::And(open, in_sector(grid, ray, hn::Mul(set(0.5F), hn::Add(start, end))));
    from = hn::IfThenElse(in, start, from);
    to = hn::IfThenElse(in, end, to);
    open = hn::AndNot(in, open);
    const M over = hn::And(open, hn::Ge(end, last));
    from = hn::IfThenElse(over, last, from);
    to = hn::IfThenElse(over, last, to);
    open = hn::AndNot(over, open);
    start = end;
  }
  from = hn::IfThenElse(open, last, from);
  to = hn::IfThenElse(open, last, to);
}

HWY_INLINE Place place_at(const TraceGrid& grid, const Rays& ray, V u) {
  Place p;
  p.x = hn::MulAdd(u, ray.dx, ray.nx);
  p.y = hn::MulAdd(u, ray.dy, ray.ny);
  p.z = hn::MulAdd(u, ray.dz, ray.nz);
  V per_rho;
  p.rho = root(hn::MulAdd(p.x, p.x, hn::Mul(p.y, p.y)), per_rho);
  p.r = root(hn::MulAdd(u, u, ray.m2));
  const V beam = grid.even_beams ? index_of(grid.even_beam, arc(hn::Mul(p.y, inverse(hn::Max(p.x, set(1e-20F))))))
                                 : index_of(grid.beam_of, diamond(p.x, p.y, grid.wide));
  const V fan = grid.even_fans ? index_of(grid.even_fan, arc(hn::Neg(hn::Mul(p.z, per_rho))))
                               : index_of(grid.fan_of, diamond(p.rho, hn::Neg(p.z), false));
  const V sample = hn::Clamp(hn::Mul(hn::Sub(p.r, set(grid.first_m)), set(grid.per_spacing)), zero(),
                             set(static_cast<float>(grid.samples - 1)));
  p.beam0 = hn::Min(floor_to_int(beam), seti(grid.beams - 2));
  p.fan0 = hn::Min(floor_to_int(fan), seti(grid.fans - 2));
  p.sample0 = hn::Min(floor_to_int(sample), seti(grid.samples - 2));
  p.beam = hn::Sub(beam, hn::ConvertTo(D(), p.beam0));
  p.fan = hn::Sub(fan, hn::ConvertTo(D(), p.fan0));
  p.sample = hn::Sub(sample, hn::ConvertTo(D(), p.sample0));
  return p;
}

/// Of place_at(), which takes what lies outside to the sector's nearest face.
HWY_INLINE M is_inside(const TraceGrid& grid, const Place& p) {
  const auto between = [](W whole, V part, int count) {
    const V index = hn::Add(hn::ConvertTo(D(), whole), part);
    return hn::And(hn::Gt(index, set(kFaceIndex)), hn::Lt(index, set(static_cast<float>(count - 1) - kFaceIndex)));
  };
  const M across = hn::And(between(p.beam0, p.beam, grid.beams), between(p.fan0, p.fan, grid.fans));
  return hn::And(hn::And(across, between(p.sample0, p.sample, grid.samples)), hn::Ge(p.z, set(grid.surface_z_m)));
}

HWY_INLINE W cell_of(const TraceGrid& grid, const Place& p) {
  const W row = hn::Add(hn::Mul(p.fan0, seti(grid.cell_beams)), p.beam0);
  return hn::Add(hn::Mul(row, seti(grid.cell_ranges)), hn::ShiftRight<4>(p.sample0));
}

// Azimuth turns one way only along a straight ray and elevation turns back once at most: of each pair of a block's faces
// one need be met, and rarely the other.

/// Rate of the fan's index: linear in u, so that it changes its sign once.
HWY_INLINE V climbing(const Rays& ray, V u) { return hn::MulSub(ray.nz, u, hn::Mul(ray.dz, ray.m2)); }

/// Nearest meeting with the cones of a block, the one moved towards first.
HWY_INLINE V nearer_fan(const TraceGrid& grid, const Rays& ray, W ahead, W behind, V rate, V best, V u) {
  best = nearer_cone(ray, hn::GatherIndex(D(), grid.sin2_elevation, ahead), best, u);
  const M turns = hn::Lt(hn::Mul(climbing(ray, best), rate), zero());
  if (!any(turns)) return best;
  return nearer_cone(ray, hn::GatherIndex(D(), grid.sin2_elevation, behind), best, u);
}

/// Where the rays leave the block of `reach` cells to each side of their cell; `u` where they stand at its face, within
/// what indices are wrong by, and move towards it: they may be past it already, and then its root lies behind them and
/// would be missed, the whole way along a face that a ray grazes.
HWY_INLINE V block_exit(const TraceGrid& grid, const Rays& ray, const Place& p, W reach, V u, V best) {
  const auto number = [](W i) { return hn::ConvertTo(D(), i); };
  const auto choose = [](M m, W yes, W no) { return hn::IfThenElse(hn::RebindMask(I(), m), yes, no); };
  const V azimuth_rate = hn::MulSub(ray.nx, ray.dy, hn::Mul(ray.ny, ray.dx));
  const V elevation_rate = climbing(ray, u);
  const W above = hn::Add(reach, seti(1));
  const W b0 = hn::Max(hn::Sub(p.beam0, reach), seti(0));
  const W b1 = hn::Min(hn::Add(p.beam0, above), seti(grid.beams - 1));
  const W f0 = hn::Max(hn::Sub(p.fan0, reach), seti(0));
  const W f1 = hn::Min(hn::Add(p.fan0, above), seti(grid.fans - 1));
  const W beam = choose(hn::Gt(azimuth_rate, zero()), b1, b0);
  const M rising = hn::Gt(elevation_rate, zero());
  const W fan = choose(rising, f1, f0);
  // Inwards to the nearer sphere, if it is met, else out through the farther.
  const W k = hn::ShiftRight<4>(p.sample0);
  const V k0 = number(hn::ShiftLeft<4>(hn::Sub(k, reach)));
  const V k1 = number(hn::ShiftLeft<4>(hn::Add(k, above)));
  const V r0 = hn::MulAdd(k0, set(grid.spacing_m), set(grid.first_m));
  const V r1 = hn::MulAdd(k1, set(grid.spacing_m), set(grid.first_m));
  const V in2 = hn::MulSub(r0, r0, ray.m2);
  const M falling = hn::Lt(u, zero());
  const M inwards = hn::And(falling, hn::And(hn::Gt(in2, zero()), hn::Gt(r0, zero())));
  const V half = root(hn::IfThenElse(inwards, in2, hn::MulSub(r1, r1, ray.m2)));
  best = nearer_root(best, hn::IfThenElse(inwards, hn::Neg(half), half), u);
  V sine;
  V cosine;
  pairs_at(grid.azimuth_sines, beam, sine, cosine);
  best = nearer_root(best, plane_root(ray, sine, cosine), u);
  best = nearer_fan(grid, ray, fan, choose(rising, f0, f1), elevation_rate, best, u);
  const auto close = [](V face, V index) { return hn::Lt(hn::Abs(hn::Sub(face, index)), set(4e-3F)); };
  const M at_sample = close(hn::IfThenElse(falling, k0, k1), hn::Add(number(p.sample0), p.sample));
  const M at_beam = close(number(beam), hn::Add(number(p.beam0), p.beam));
  const M at_fan = close(number(fan), hn::Add(number(p.fan0), p.fan));
  return hn::IfThenElse(hn::Or(hn::Or(at_beam, at_fan), at_sample), u, best);
}

}  // namespace sonar::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SONAR_RENDER_CPU_GEOMETRY_INL_H_
