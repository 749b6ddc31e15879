// SPDX-License-Identifier: Apache-2.0
#include "render/cpu/trace.h"

#include "render/ray_rules.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cpu/trace.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/cpu/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sonar::HWY_NAMESPACE {
namespace {

constexpr std::size_t kLanes = hn::MaxLanes(D());

/// Pixels of a packet: nearly square, so that its rays stay together.
struct Pixels {  // NOLINT(cppcoreguidelines-pro-type-member-init): filled in whole
  HWY_ALIGN float x[kLanes];
  HWY_ALIGN float y[kLanes];
  HWY_ALIGN float phase[kLanes];
  HWY_ALIGN float end_m[kLanes];
  std::array<float, 4>* out[kLanes];
  std::uint32_t lanes = 0;  ///< bits of those inside the tile
};

Rays rays_of(const TraceView& view, const Pixels& px, V& eye_u) {
  const V sx = hn::Load(D(), px.x);
  const V sy = hn::Load(D(), px.y);
  const auto along = [&](std::size_t i) {
    return hn::MulAdd(sx, set(view.right[i]), hn::MulAdd(sy, set(view.up[i]), set(view.forward[i])));
  };
  Rays ray;
  ray.dx = along(0);
  ray.dy = along(1);
  ray.dz = along(2);
  const V per =
      hn::Div(set(1.0F), root(hn::MulAdd(ray.dx, ray.dx, hn::MulAdd(ray.dy, ray.dy, hn::Mul(ray.dz, ray.dz)))));
  ray.dx = hn::Mul(ray.dx, per);
  ray.dy = hn::Mul(ray.dy, per);
  ray.dz = hn::Mul(ray.dz, per);
  eye_u = begin_at(ray, set(view.eye[0]), set(view.eye[1]), set(view.eye[2]));
  return ray;
}

/// From eye or outer sphere to outer sphere or an opaque thing, below the sea surface; last <= first where none.
void outer_bounds(const TraceJob& job, const Rays& ray, V eye_u, V end_m, V& first, V& last) {
  const V far2 = set(job.grid.farthest_m * job.grid.farthest_m);
  const V half = root(hn::Sub(far2, ray.m2));
  first = hn::Max(hn::Neg(half), eye_u);
  last = hn::Min(half, hn::Add(eye_u, end_m));
  const V surface = set(job.grid.surface_z_m);
  const V crossing = hn::Div(hn::Sub(surface, ray.nz), ray.dz);
  const M level = hn::Lt(hn::Abs(ray.dz), set(1e-12F));
  const M down = hn::Gt(ray.dz, zero());
  first = hn::IfThenElse(hn::AndNot(level, down), hn::Max(first, crossing), first);
  last = hn::IfThenElse(hn::Or(level, down), last, hn::Min(last, crossing));
  const M above = hn::And(level, hn::Lt(ray.nz, surface));
  last = hn::IfThenElse(hn::Or(above, hn::Ge(ray.m2, far2)), first, last);
}

template <bool kPlain>
void trace_packet(const TraceJob& job, const Pixels& px, RayCounts& counts) {
  V eye_u;
  const Rays ray = rays_of(job.view, px, eye_u);
  V first;
  V last;
  outer_bounds(job, ray, eye_u, hn::Load(D(), px.end_m), first, last);
  const M meets = hn::Lt(first, last);
  Packet<kPlain> packet(job, ray, eye_u, hn::Load(D(), px.phase), first, last);
  if (any(meets)) packet.run(counts);
  packet.store(px.out, px.lanes);
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(D(), packet.met_sector(), bits);
  counts.rays += std::popcount((bits[0] | std::uint32_t{bits[1]} << 8U) & px.lanes);
}

void fill_lane(const TraceView& view, int x, int y, std::size_t lane, Pixels& px) {
  const int fx = full_pixel(x, view.divisor, view.full.width);
  const int fy = full_pixel(y, view.divisor, view.full.height);
  const float x_px = static_cast<float>(fx) + 0.5F + view.shift[0];
  const float y_px = static_cast<float>(fy) + 0.5F + view.shift[1];
  px.x[lane] = (x_px - 0.5F * static_cast<float>(view.full.width)) * view.pixel_scale;
  px.y[lane] = (0.5F * static_cast<float>(view.full.height) - y_px) * view.pixel_scale;
  px.phase[lane] = static_cast<float>(sample_phase(fx, fy, view.samples_frame));
  px.end_m[lane] = 1e9F;
  if (view.opaque_m != nullptr) {
    px.end_m[lane] = view.opaque_m[static_cast<std::size_t>(fy) * static_cast<std::size_t>(view.full.width) +
                                   static_cast<std::size_t>(fx)];
  }
}

void TraceTile(const TraceJob& job, int x0, int y0, int x1, int y1, std::array<float, 4>* rgba, RayCounts& counts) {
  const int lanes = static_cast<int>(hn::Lanes(D()));
  const int wide = lanes >= 16 ? 4 : (lanes >= 4 ? lanes / 2 : lanes);
  const int high = lanes / wide;
  for (int y = y0; y < y1; y += high) {
    for (int x = x0; x < x1; x += wide) {
      Pixels px;
      for (int i = 0; i < lanes; ++i) {
        const int px_x = x + i % wide;
        const int px_y = y + i / wide;
        const auto lane = static_cast<std::size_t>(i);
        const bool inside = px_x < x1 && px_y < y1;
        fill_lane(job.view, std::min(px_x, x1 - 1), std::min(px_y, y1 - 1), lane, px);
        if (!inside) px.end_m[lane] = -1e9F;
        px.lanes |= inside ? 1U << lane : 0U;
        px.out[lane] = rgba + static_cast<std::ptrdiff_t>(px_y) * job.view.size.width + px_x;
      }
      job.view.plain ? trace_packet<true>(job, px, counts) : trace_packet<false>(job, px, counts);
    }
  }
}

bool ReadsColumns() { return SONAR_PLAIN_LOADS != 0; }
const char* TargetName() { return hwy::TargetName(HWY_TARGET); }

}  // namespace
}  // namespace sonar::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sonar {
namespace {

HWY_EXPORT(TraceTile);
HWY_EXPORT(ReadsColumns);
HWY_EXPORT(TargetName);

}  // namespace

void trace_tile(const TraceJob& job, int x0, int y0, int x1, int y1, std::array<float, 4>* rgba, RayCounts& counts) {
  HWY_DYNAMIC_DISPATCH(TraceTile)(job, x0, y0, x1, y1, rgba, counts);
}

bool trace_reads_columns() { return HWY_DYNAMIC_DISPATCH(ReadsColumns)(); }

const char* trace_target() { return HWY_DYNAMIC_DISPATCH(TargetName)(); }

}  // namespace sonar
#endif  // HWY_ONCE
