// SPDX-License-Identifier: Apache-2.0
#include "signal/flag_kernels.h"

#include "base/check.h"
#include "base/units.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "signal/flag_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "signal/lane_io-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sonar::HWY_NAMESPACE {
namespace {

void CopyUnflagged(const std::int16_t* counts, const std::uint8_t* flags, std::uint8_t mask, std::int16_t offset,
                   std::int16_t* out, std::size_t size) {
  const Counts d;
  const auto none = hn::Set(d, kNoData);
  const auto bottom = hn::Set(d, std::int16_t{-32767});
  const auto shift = hn::Set(d, offset);
  const auto flag_mask = hn::Set(d, static_cast<std::int16_t>(mask));
  for (std::size_t i = 0; i < size; i += hn::Lanes(d)) {
    const auto v = load_some(d, counts + i, size - i, 0);
    const auto f = hn::And(load_flags(d, flags + i, size - i), flag_mask);
    const auto kept = hn::AndNot(hn::VecFromMask(d, hn::Eq(v, none)), hn::VecFromMask(d, hn::Eq(f, hn::Zero(d))));
    const auto shifted = hn::Max(hn::SaturatedSub(v, shift), bottom);
    store_some(d, hn::IfVecThenElse(kept, shifted, none), out + i, size - i);
  }
}

void FlagNoData(const std::int16_t* counts, std::uint8_t* flags, std::size_t size) {
  const Counts d;
  const hn::Rebind<std::uint8_t, Counts> bytes;
  const auto none = hn::Set(d, kNoData);
  const auto bit = hn::Set(d, static_cast<std::int16_t>(SampleFlags::dropout));
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= size; i += hn::Lanes(d)) {
    const auto lost = hn::VecFromMask(d, hn::Eq(hn::LoadU(d, counts + i), none));
    if (hn::AllTrue(d, hn::Eq(lost, hn::Zero(d)))) continue;
    const auto bits = hn::DemoteTo(bytes, hn::And(lost, bit));
    hn::StoreU(hn::Or(hn::LoadU(bytes, flags + i), bits), bytes, flags + i);
  }
  for (; i < size; ++i) {
    if (counts[i] == kNoData)
      flags[i] = static_cast<std::uint8_t>(flags[i] | static_cast<std::uint8_t>(SampleFlags::dropout));
  }
}

void BlockSums(const std::int16_t* counts, std::size_t size, std::size_t block, std::int32_t* sums,
               std::int32_t* numbers) {
  std::size_t index = 0;
  for (std::size_t first = 0; first < size; first += block, ++index) {
    const std::size_t end = HWY_MIN(size, first + block);
    std::int32_t sum = 0;
    std::int32_t number = 0;
    std::size_t i = first;
#if HWY_TARGET != HWY_SCALAR
    const Counts d;
    const hn::RepartitionToWide<Counts> wide;
    const auto none = hn::Set(d, kNoData);
    auto total = hn::Zero(wide);
    auto hits = hn::Zero(d);
    for (; i + hn::Lanes(d) <= end; i += hn::Lanes(d)) {
      const auto v = hn::LoadU(d, counts + i);
      const auto missing = hn::VecFromMask(d, hn::Eq(v, none));
      const auto data = hn::BitCast(wide, hn::AndNot(missing, v));
      total = hn::Add(total, hn::Add(hn::ShiftRight<16>(hn::ShiftLeft<16>(data)), hn::ShiftRight<16>(data)));
      hits = hn::Add(hits, hn::Add(missing, hn::Set(d, std::int16_t{1})));
    }
    sum = hn::GetLane(hn::SumOfLanes(wide, total));
    number = sum_of_lanes(d, hits);
#endif
    for (; i < end; ++i) {
      if (counts[i] == kNoData) continue;
      sum += counts[i];
      ++number;
    }
    sums[index] = sum;
    numbers[index] = number;
  }
}

void QuantileOverRows(const std::int16_t* counts, int rows, int samples, std::uint16_t fraction, int minimum_rows,
                      std::int16_t* out) {
  const Counts d;
  const hn::RebindToUnsigned<Counts> unsigned_tag;
  const auto size = static_cast<std::size_t>(samples);
  const auto none = hn::Set(d, kNoData);
  const auto one = hn::Set(d, std::int16_t{1});
  for (std::size_t i = 0; i < size; i += hn::Lanes(d)) {
    const std::int16_t* column = counts + i;
    const auto row_at = [&](int row) HWY_ATTR {
      return load_some(d, column + static_cast<std::size_t>(row) * size, size - i, kNoData);
    };
    auto missing = hn::Zero(d);
    for (int row = 0; row < rows; ++row) missing = hn::Sub(missing, hn::VecFromMask(d, hn::Eq(row_at(row), none)));
    const auto valid = hn::Sub(hn::Set(d, static_cast<std::int16_t>(rows)), missing);
    const auto share = hn::MulHigh(hn::BitCast(unsigned_tag, valid), hn::Set(unsigned_tag, fraction));
    // No data lies below all data, so it counts as that many values below.
    const auto rank = hn::Add(missing, hn::BitCast(d, share));
    auto value = none;
    for (int step = 32768; step >= 32; step /= 2) {
      const auto candidate = hn::Add(value, hn::Set(d, static_cast<std::int16_t>(step)));
      auto below = hn::Zero(d);
      for (int row = 0; row < rows; ++row) below = hn::Sub(below, hn::VecFromMask(d, hn::Lt(row_at(row), candidate)));
      const auto too_high = hn::VecFromMask(d, hn::Gt(below, rank));
      value = hn::IfVecThenElse(too_high, value, candidate);
    }
    value = hn::Max(value, hn::Add(none, one));
    const auto few = hn::VecFromMask(d, hn::Lt(valid, hn::Set(d, static_cast<std::int16_t>(minimum_rows))));
    store_some(d, hn::IfVecThenElse(few, none, value), out + i, size - i);
  }
}

void PeakBits(const std::int16_t* counts, std::size_t size, std::int16_t threshold, std::uint64_t* bits) {
  const Counts d;
  const std::size_t lanes = hn::Lanes(d);
  const auto by = hn::Set(d, threshold);
  for (std::size_t i = 6; i + 6 < size; i += lanes) {
    const std::size_t left = size - 6 - i;
    const std::int16_t* here = counts + i;
    const auto at = [&](int shift) HWY_ATTR { return load_some(d, here + shift, left, kNoData); };
    const auto before = hn::Max(hn::Max(at(-6), at(-5)), hn::Max(at(-4), at(-3)));
    const auto after = hn::Max(hn::Max(at(3), at(4)), hn::Max(at(5), at(6)));
    const auto bound = hn::SaturatedAdd(hn::Max(before, after), by);
    const auto peak = hn::VecFromMask(d, hn::Gt(at(0), bound));
    if (hn::AllTrue(d, hn::Eq(peak, hn::Zero(d)))) continue;
    std::uint64_t found = lane_bits(d, peak);
    if (left < lanes) found &= (std::uint64_t{1} << left) - 1;
    bits[i / 64] |= found << (i % 64);
    if (i % 64 != 0 && i / 64 + 1 < (size + 63) / 64) bits[i / 64 + 1] |= found >> (64 - i % 64);
  }
}

}  // namespace
}  // namespace sonar::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sonar {

namespace {
HWY_EXPORT(CopyUnflagged);
HWY_EXPORT(FlagNoData);
HWY_EXPORT(BlockSums);
HWY_EXPORT(QuantileOverRows);
HWY_EXPORT(PeakBits);
}  // namespace

void copy_unflagged(std::span<const std::int16_t> counts, std::span<const SampleFlags> flags, SampleFlags mask,
                    std::int16_t offset, std::span<std::int16_t> out) {
  SONAR_CHECK(counts.size() == flags.size() && counts.size() == out.size());
  HWY_DYNAMIC_DISPATCH(CopyUnflagged)
  (counts.data(), reinterpret_cast<const std::uint8_t*>(flags.data()), static_cast<std::uint8_t>(mask), offset,
   out.data(), counts.size());
}

void flag_no_data(std::span<const std::int16_t> counts, std::span<SampleFlags> flags) {
  SONAR_CHECK(counts.size() == flags.size());
  HWY_DYNAMIC_DISPATCH(FlagNoData)(counts.data(), reinterpret_cast<std::uint8_t*>(flags.data()), counts.size());
}

void block_sums(std::span<const std::int16_t> counts, std::size_t block, std::span<std::int32_t> sums,
                std::span<std::int32_t> numbers) {
  SONAR_CHECK(block > 0 && sums.size() * block >= counts.size() && numbers.size() == sums.size());
  HWY_DYNAMIC_DISPATCH(BlockSums)(counts.data(), counts.size(), block, sums.data(), numbers.data());
}

void quantile_over_rows(const std::int16_t* counts, int rows, int samples, double fraction, int minimum_rows,
                        std::int16_t* out) {
  SONAR_CHECK(rows >= 0 && rows <= 32767 && fraction >= 0.0 && fraction < 1.0);
  const auto share = static_cast<std::uint16_t>(fraction * 65535.0);
  HWY_DYNAMIC_DISPATCH(QuantileOverRows)(counts, rows, samples, share, minimum_rows, out);
}

void peak_bits(std::span<const std::int16_t> counts, std::int16_t threshold, std::span<std::uint64_t> bits) {
  SONAR_CHECK(bits.size() * 64 >= counts.size());
  for (std::uint64_t& word : bits) word = 0;
  HWY_DYNAMIC_DISPATCH(PeakBits)(counts.data(), counts.size(), threshold, bits.data());
}

}  // namespace sonar
#endif  // HWY_ONCE
