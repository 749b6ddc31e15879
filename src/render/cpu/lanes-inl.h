// SPDX-License-Identifier: Apache-2.0
// Lanes of floats, one ray each, and what is looked up for them; included once per target.
#if defined(SONAR_RENDER_CPU_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SONAR_RENDER_CPU_LANES_INL_H_
#undef SONAR_RENDER_CPU_LANES_INL_H_
#else
#define SONAR_RENDER_CPU_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdint>
#include <cstring>

#include "render/cpu/trace.h"
#include "render/grid_axes.h"

HWY_BEFORE_NAMESPACE();
namespace sonar::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<float>;
using I = hn::RebindToSigned<D>;
using V = hn::Vec<D>;
using W = hn::Vec<I>;
using M = hn::Mask<D>;

HWY_INLINE V set(float value) { return hn::Set(D(), value); }
HWY_INLINE W seti(std::int32_t value) { return hn::Set(I(), value); }
HWY_INLINE V zero() { return hn::Zero(D()); }
HWY_INLINE bool any(M m) { return !hn::AllFalse(D(), m); }
HWY_INLINE M none() { return hn::MaskFromVec(zero()); }
template <int bit>
HWY_INLINE M is_set(W words) {
  return hn::RebindMask(D(), hn::MaskFromVec(hn::BroadcastSignBit(hn::ShiftLeft<31 - bit>(words))));
}
HWY_INLINE V lerp(V a, V b, V f) { return hn::MulAdd(f, hn::Sub(b, a), a); }

/// A bit a lane.
HWY_INLINE std::uint32_t bits(M m) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(D(), m, bytes);
  std::uint32_t out = 0;
  for (std::size_t i = 0; i < 4; ++i) out |= std::uint32_t{bytes[i]} << (8 * i);
  return out;
}
HWY_INLINE M mask_of(std::uint32_t lanes) {
  std::uint8_t bytes[8] = {};
  for (std::size_t i = 0; i < 4; ++i) bytes[i] = static_cast<std::uint8_t>(lanes >> (8 * i));
  return hn::LoadMaskBits(D(), bytes);
}

// Division and square root hold a vector unit for 15 to 25 cycles; an estimate and one step of Newton's, right to about
// 2^-22, for 5. Neither makes a number of 1/0: NaN, which compares false.
#if HWY_TARGET == HWY_SCALAR
HWY_INLINE V inverse(V v) { return hn::Div(set(1.0F), v); }
HWY_INLINE V root(V v) { return hn::Sqrt(hn::Max(v, zero())); }
#else
HWY_INLINE V inverse(V v) {
  const V guess = hn::ApproximateReciprocal(v);
  return hn::Mul(guess, hn::NegMulAdd(v, guess, set(2.0F)));
}
/// Of what is above 0; 0 of what is not, nearly.
HWY_INLINE V root(V v) {
  const V above = hn::Max(v, set(1e-30F));
  const V guess = hn::ApproximateReciprocalSqrt(above);
  const V first = hn::Mul(above, guess);
  return hn::MulAdd(hn::Mul(hn::NegMulAdd(first, first, above), set(0.5F)), guess, first);
}
#endif
/// The root and what to multiply by in place of dividing by it.
HWY_INLINE V root(V v, V& over) {
#if HWY_TARGET == HWY_SCALAR
  const V out = root(v);
  over = hn::Div(set(1.0F), hn::Max(out, set(1e-15F)));
  return out;
#else
  const V above = hn::Max(v, set(1e-30F));
  const V guess = hn::ApproximateReciprocalSqrt(above);
  const V first = hn::Mul(above, guess);
  const V part = hn::Mul(hn::NegMulAdd(first, guess, set(1.0F)), set(0.5F));
  over = hn::MulAdd(guess, part, guess);
  return hn::MulAdd(first, part, first);
#endif
}
// Values here are clamped to what they index: what the library does for those beyond 2^31 is left out where it costs.
#if HWY_TARGET == HWY_AVX2
HWY_INLINE W floor_to_int(V v) { return W{_mm256_cvttps_epi32(v.raw)}; }  // of values from 0
HWY_INLINE W nearest_int(V v) { return W{_mm256_cvtps_epi32(v.raw)}; }
#else
HWY_INLINE W floor_to_int(V v) { return hn::ConvertTo(I(), v); }
HWY_INLINE W nearest_int(V v) { return hn::NearestInt(v); }
#endif

/// 32 bits from any byte address a lane.
HWY_INLINE W gather_bytes(const void* base, W byte_offset) {
#if HWY_TARGET <= HWY_AVX2 && HWY_ARCH_X86
  return hn::GatherOffset(I(), static_cast<const std::int32_t*>(base), byte_offset);
#else
  HWY_ALIGN std::int32_t at[hn::MaxLanes(I())];
  hn::Store(byte_offset, I(), at);
  for (std::size_t i = 0; i < hn::Lanes(I()); ++i) {
    std::int32_t value = 0;
    std::memcpy(&value, static_cast<const char*>(base) + at[i], sizeof value);
    at[i] = value;
  }
  return hn::Load(I(), at);
#endif
}

/// 1 - exp(-x) for x >= 0 with a small relative error also where x is tiny.
HWY_INLINE V opacity_of(V depth) {
  // y = exp(-x) - 1 by its series, off by 1e-6 of it at most; where a depth is too large for that y = exp(-x / 32) - 1,
  // then five times (1 + y)^2 - 1. A step through anything but the densest fish is shallow.
  const bool shallow = hn::AllTrue(D(), hn::Lt(depth, set(0.25F)));
  const V x = hn::Mul(hn::Min(depth, set(16.0F)), set(shallow ? -1.0F : -1.0F / 32.0F));
  V y = hn::MulAdd(x, set(1.0F / 120.0F), set(1.0F / 24.0F));
  y = hn::MulAdd(x, y, set(1.0F / 6.0F));
  y = hn::MulAdd(x, y, set(0.5F));
  y = hn::MulAdd(x, y, set(1.0F));
  y = hn::Mul(x, y);
  if (!shallow) {
    for (int i = 0; i < 5; ++i) y = hn::Mul(y, hn::Add(y, set(2.0F)));
  }
  return hn::Neg(y);
}

/// diamond_angle() of x, y; `wide` where x may be negative.
HWY_INLINE V diamond(V x, V y, bool wide) {
  const V p = hn::Mul(y, inverse(hn::Max(hn::Add(hn::Abs(x), hn::Abs(y)), set(1e-20F))));
  if (!wide) return p;
  return hn::IfThenElse(hn::Lt(x, zero()), hn::Sub(hn::CopySign(set(2.0F), y), p), p);
}

/// atan for -1..1, off by 2e-6 at most: a polynomial of least largest error.
HWY_INLINE V arc(V t) {
  const V u = hn::Mul(t, t);
  V sum = hn::MulAdd(u, set(-0.011719133F), set(0.052647348F));
  for (const float c : {-0.116426483F, 0.193540379F, -0.332622829F, 0.999977219F}) sum = hn::MulAdd(u, sum, set(c));
  return hn::Mul(t, sum);
}

/// Index by an angle, where the angles are even.
HWY_INLINE V index_of(const EvenAngle& axis, V angle) {
  return hn::Clamp(hn::Mul(hn::Sub(angle, set(axis.first_rad)), set(axis.per_rad)), zero(), set(axis.last));
}

HWY_INLINE V index_of(const PackedAngle& table, V angle) {
  const V at = hn::Clamp(hn::Mul(hn::Sub(angle, set(table.first)), set(table.per_unit)), zero(),
                         set(static_cast<float>(kAngleEntries) - 1.001F));
  const W k = floor_to_int(at);
  const V f = hn::Sub(at, hn::ConvertTo(D(), k));
  const W word = hn::GatherIndex(I(), reinterpret_cast<const std::int32_t*>(table.words), k);
  const hn::RebindToUnsigned<I> du;
  const V value = hn::ConvertTo(D(), hn::BitCast(I(), hn::ShiftRight<12>(hn::BitCast(du, word))));
  const V slope = hn::ConvertTo(D(), hn::And(word, seti(0xFFF)));
  return hn::MulAdd(hn::Mul(slope, set(table.index_per_slope)), f, hn::Mul(value, set(table.index_per_value)));
}

/// Colour of an entry of the transfer table, 0..1.
struct Rgb {
  V r, g, b;
};
HWY_INLINE Rgb unpacked(W rgb10) {
  const V scale = set(1.0F / 1023.0F);
  const W bits = seti(1023);
  return {hn::Mul(hn::ConvertTo(D(), hn::And(rgb10, bits)), scale),
          hn::Mul(hn::ConvertTo(D(), hn::And(hn::ShiftRight<10>(rgb10), bits)), scale),
          hn::Mul(hn::ConvertTo(D(), hn::And(hn::ShiftRight<20>(rgb10), bits)), scale)};
}

}  // namespace sonar::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SONAR_RENDER_CPU_LANES_INL_H_
