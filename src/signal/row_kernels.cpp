// SPDX-License-Identifier: Apache-2.0
#include "signal/row_kernels.h"

#include "base/check.h"
#include "base/units.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "signal/row_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "signal/lane_io-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sonar::HWY_NAMESPACE {
namespace {

void AddSaturating(std::int16_t* counts, const std::int16_t* table, std::size_t size) {
  const Counts d;
  const auto none = hn::Set(d, kNoData);
  const auto low = hn::Set(d, kMinCount);
  const auto high = hn::Set(d, kMaxCount);
  for (std::size_t i = 0; i < size; i += hn::Lanes(d)) {
    const auto a = load_some(d, counts + i, size - i, 0);
    const auto b = load_some(d, table + i, size - i, 0);
    const auto sum = hn::Min(hn::Max(hn::SaturatedAdd(a, b), low), high);
    const auto missing = hn::Or(hn::VecFromMask(d, hn::Eq(a, none)), hn::VecFromMask(d, hn::Eq(b, none)));
    store_some(d, hn::IfVecThenElse(missing, none, sum), counts + i, size - i);
  }
}

std::size_t CountBelow(const std::int16_t* values, std::size_t size, std::int16_t limit) {
  std::size_t below = 0;
  std::size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
  const Counts d;
  const auto bound = hn::Set(d, limit);
  for (; i + hn::Lanes(d) <= size; i += hn::Lanes(d)) {
    below += hn::CountTrue(d, hn::Lt(hn::LoadU(d, values + i), bound));
  }
#endif
  for (; i < size; ++i) below += values[i] < limit ? 1 : 0;
  return below;
}

std::int16_t SelectRank(const std::int16_t* values, std::size_t size, std::size_t rank, int least, int most) {
  // Few values are copied to where whole vectors of them are followed by the largest value, which lies below nothing.
  constexpr std::size_t kFew = 512;
  HWY_ALIGN std::int16_t few[kFew];
  if (size < kFew) {
    const std::size_t end = HWY_MIN(kFew, (size + hn::Lanes(Counts()) - 1) / hn::Lanes(Counts()) * hn::Lanes(Counts()));
    for (std::size_t i = 0; i < size; ++i) few[i] = values[i];
    for (std::size_t i = size; i < end; ++i) few[i] = 32767;
    values = few;
    size = end;
  }
  // The largest v with fewer than rank + 1 values below it, by halving.
  while (least < most) {
    const int middle = most - (most - least) / 2;
    if (CountBelow(values, size, static_cast<std::int16_t>(middle)) <= rank) {
      least = middle;
    } else {
      most = middle - 1;
    }
  }
  return static_cast<std::int16_t>(least);
}

bool MaskRow(const std::int16_t* counts, const std::uint8_t* flags, std::size_t size, int parity, std::int16_t* out) {
  const Counts d;
  const auto none = hn::Set(d, kNoData);
  const auto left_out = hn::Set(d, static_cast<std::int16_t>(kNotFiltered));
  const auto one = hn::Set(d, std::int16_t{1});
  const auto start = hn::Add(hn::Iota(d, std::int16_t{0}), hn::Set(d, static_cast<std::int16_t>(parity & 1)));
  const auto low = hn::Set(d, std::int16_t{-32767});
  const auto high = hn::Set(d, std::int16_t{32767});
  auto any = hn::Zero(d);
  for (std::size_t i = 0; i < size; i += hn::Lanes(d)) {
    const auto v = load_some(d, counts + i, size - i, 0);
    const auto f = hn::And(load_flags(d, flags + i, size - i), left_out);
    const auto kept = hn::AndNot(hn::VecFromMask(d, hn::Eq(v, none)), hn::VecFromMask(d, hn::Eq(f, hn::Zero(d))));
    any = hn::Or(any, hn::Not(kept));
    // A vector may be a single lane wide, so the parity of i counts.
    const auto odd = hn::And(hn::Add(start, hn::Set(d, static_cast<std::int16_t>(i & 1))), one);
    const auto infinity = hn::IfVecThenElse(hn::Neg(odd), high, low);
    store_some(d, hn::IfVecThenElse(kept, v, infinity), out + i, size - i);
  }
  return !hn::AllTrue(d, hn::Eq(any, hn::Zero(d)));
}

void DropNeverMembers(const std::uint8_t* flags, std::size_t size, std::int16_t* out) {
  const Counts d;
  const auto never = hn::Set(d, static_cast<std::int16_t>(kNeverMember));
  const auto top = hn::Set(d, std::int16_t{32767});
  const auto bottom = hn::Set(d, std::int16_t{-32767});
  for (std::size_t i = 0; i < size; i += hn::Lanes(d)) {
    const auto v = load_some(d, out + i, size - i, 0);
    const auto f = hn::And(load_flags(d, flags + i, size - i), never);
    const auto infinite = hn::Or(hn::VecFromMask(d, hn::Eq(v, top)), hn::VecFromMask(d, hn::Eq(v, bottom)));
    const auto kept = hn::AndNot(infinite, hn::VecFromMask(d, hn::Eq(f, hn::Zero(d))));
    store_some(d, hn::IfVecThenElse(kept, v, hn::Set(d, kNoData)), out + i, size - i);
  }
}

void FlagBelow(const std::int16_t* counts, const std::int16_t* limits, std::int16_t limit, std::uint8_t flag,
               std::uint8_t* flags, std::size_t size) {
  const Counts d;
  const hn::Rebind<std::uint8_t, Counts> bytes;
  const auto none = hn::Set(d, kNoData);
  const auto bit = hn::Set(d, static_cast<std::int16_t>(flag));
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= size; i += hn::Lanes(d)) {
    const auto v = hn::LoadU(d, counts + i);
    const auto bound = limits != nullptr ? hn::LoadU(d, limits + i) : hn::Set(d, limit);
    const auto below = hn::AndNot(hn::VecFromMask(d, hn::Eq(v, none)), hn::VecFromMask(d, hn::Lt(v, bound)));
    const auto bits = hn::DemoteTo(bytes, hn::And(below, bit));
    hn::StoreU(hn::Or(hn::LoadU(bytes, flags + i), bits), bytes, flags + i);
  }
  for (; i < size; ++i) {
    const std::int16_t bound = limits != nullptr ? limits[i] : limit;
    if (counts[i] != kNoData && counts[i] < bound) flags[i] = static_cast<std::uint8_t>(flags[i] | flag);
  }
}

void ThresholdBits(const std::int16_t* counts, const std::int16_t* limits, bool one_limit, std::uint64_t* bits,
                   std::size_t size) {
  const Counts d;
  const std::size_t lanes = hn::Lanes(d);
  const auto none = hn::Set(d, kNoData);
  for (std::size_t word = 0; word * 64 < size; ++word) {
    std::uint64_t value = 0;
    for (std::size_t part = 0; part < 64 && word * 64 + part < size; part += lanes) {
      const std::size_t i = word * 64 + part;
      const auto v = load_some(d, counts + i, size - i, kNoData);
      const auto bound = one_limit ? hn::Set(d, limits[0]) : load_some(d, limits + i, size - i, kNoData);
      const auto inside = hn::AndNot(hn::VecFromMask(d, hn::Or(hn::Eq(v, none), hn::Eq(bound, none))),
                                     hn::VecFromMask(d, hn::Not(hn::Lt(v, bound))));
      value |= lane_bits(d, inside) << part;
    }
    bits[word] = value;
  }
}

}  // namespace
}  // namespace sonar::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sonar {

namespace {

HWY_EXPORT(AddSaturating);
HWY_EXPORT(CountBelow);
HWY_EXPORT(SelectRank);
HWY_EXPORT(MaskRow);
HWY_EXPORT(DropNeverMembers);
HWY_EXPORT(FlagBelow);
HWY_EXPORT(ThresholdBits);

const std::uint8_t* bytes(std::span<const SampleFlags> flags) {
  return reinterpret_cast<const std::uint8_t*>(flags.data());
}
std::uint8_t* bytes(std::span<SampleFlags> flags) { return reinterpret_cast<std::uint8_t*>(flags.data()); }

}  // namespace

void add_saturating(std::span<std::int16_t> counts, std::span<const std::int16_t> table) {
  SONAR_CHECK(counts.size() == table.size());
  HWY_DYNAMIC_DISPATCH(AddSaturating)(counts.data(), table.data(), counts.size());
}

std::int16_t select_rank(std::span<const std::int16_t> values, std::size_t rank, std::int16_t least,
                         std::int16_t most) {
  SONAR_CHECK(rank < values.size());
  return HWY_DYNAMIC_DISPATCH(SelectRank)(values.data(), values.size(), rank, least, most);
}

std::size_t count_data(std::span<const std::int16_t> counts) {
  return counts.size() - HWY_DYNAMIC_DISPATCH(CountBelow)(counts.data(), counts.size(), -32767);
}

bool mask_row(std::span<const std::int16_t> counts, std::span<const SampleFlags> flags, int parity,
              std::span<std::int16_t> out) {
  SONAR_CHECK(counts.size() == flags.size() && counts.size() == out.size());
  return HWY_DYNAMIC_DISPATCH(MaskRow)(counts.data(), bytes(flags), counts.size(), parity, out.data());
}

void drop_never_members(std::span<const SampleFlags> flags, std::span<std::int16_t> out) {
  SONAR_CHECK(flags.size() == out.size());
  HWY_DYNAMIC_DISPATCH(DropNeverMembers)(bytes(flags), out.size(), out.data());
}

void flag_below(std::span<const std::int16_t> counts, std::int16_t limit, SampleFlags flag,
                std::span<SampleFlags> flags) {
  SONAR_CHECK(counts.size() == flags.size());
  HWY_DYNAMIC_DISPATCH(FlagBelow)
  (counts.data(), nullptr, limit, static_cast<std::uint8_t>(flag), bytes(flags), counts.size());
}

void flag_below(std::span<const std::int16_t> counts, std::span<const std::int16_t> limit, SampleFlags flag,
                std::span<SampleFlags> flags) {
  SONAR_CHECK(counts.size() == flags.size() && counts.size() == limit.size());
  HWY_DYNAMIC_DISPATCH(FlagBelow)
  (counts.data(), limit.data(), 0, static_cast<std::uint8_t>(flag), bytes(flags), counts.size());
}

void threshold_bits(std::span<const std::int16_t> counts, std::span<const std::int16_t> limit,
                    std::span<std::uint64_t> bits) {
  SONAR_CHECK((limit.size() == 1 || limit.size() == counts.size()) && bits.size() * 64 >= counts.size());
  if (counts.empty()) return;
  HWY_DYNAMIC_DISPATCH(ThresholdBits)
  (counts.data(), limit.data(), limit.size() == 1, bits.data(), counts.size());
}

}  // namespace sonar
#endif  // HWY_ONCE
