// SPDX-License-Identifier: Apache-2.0
// Loads and stores of rows that need not fill a vector, for the kernels of this room; included once per target.
#if defined(SONAR_SIGNAL_LANE_IO_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SONAR_SIGNAL_LANE_IO_INL_H_
#undef SONAR_SIGNAL_LANE_IO_INL_H_
#else
#define SONAR_SIGNAL_LANE_IO_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace sonar::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Counts = hn::ScalableTag<std::int16_t>;
using Vec = hn::Vec<Counts>;

/// `count` values from memory; the lanes beyond hold `fill`.
HWY_INLINE Vec load_some(Counts d, const std::int16_t* from, std::size_t count, std::int16_t fill) {
  if (count >= hn::Lanes(d)) return hn::LoadU(d, from);
  HWY_ALIGN std::int16_t buffer[hn::MaxLanes(Counts())];
  for (std::size_t i = 0; i < hn::Lanes(d); ++i) buffer[i] = i < count ? from[i] : fill;
  return hn::Load(d, buffer);
}

HWY_INLINE void store_some(Counts d, Vec v, std::int16_t* to, std::size_t count) {
  if (count >= hn::Lanes(d)) return hn::StoreU(v, d, to);
  HWY_ALIGN std::int16_t buffer[hn::MaxLanes(Counts())];
  hn::Store(v, d, buffer);
  for (std::size_t i = 0; i < count; ++i) to[i] = buffer[i];
}

/// Flags widened to 16 bits; the lanes beyond hold 0.
HWY_INLINE Vec load_flags(Counts d, const std::uint8_t* from, std::size_t count) {
  const hn::Rebind<std::uint8_t, Counts> bytes;
  const hn::RebindToUnsigned<Counts> words;
  if (count >= hn::Lanes(d)) return hn::BitCast(d, hn::PromoteTo(words, hn::LoadU(bytes, from)));
  HWY_ALIGN std::uint8_t buffer[hn::MaxLanes(Counts())] = {};
  for (std::size_t i = 0; i < count; ++i) buffer[i] = from[i];
  return hn::BitCast(d, hn::PromoteTo(words, hn::Load(bytes, buffer)));
}

/// Sum of all lanes.
HWY_INLINE std::int32_t sum_of_lanes(Counts d, Vec v) {
#if HWY_TARGET == HWY_SCALAR
  (void)d;
  return hn::GetLane(v);
#else
  (void)d;
  const hn::RepartitionToWide<Counts> wide;
  const auto even = hn::ShiftRight<16>(hn::ShiftLeft<16>(hn::BitCast(wide, v)));
  const auto odd = hn::ShiftRight<16>(hn::BitCast(wide, v));
  return hn::GetLane(hn::SumOfLanes(wide, hn::Add(even, odd)));
#endif
}

/// The lanes' highest bits, lowest lane first.
HWY_INLINE std::uint64_t lane_bits(Counts d, Vec v) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, hn::MaskFromVec(v), bytes);
  std::uint64_t bits = 0;
  for (std::size_t b = 0; b < 8; ++b) bits |= std::uint64_t{bytes[b]} << (8 * b);
  return bits;
}

}  // namespace sonar::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SONAR_SIGNAL_LANE_IO_INL_H_
