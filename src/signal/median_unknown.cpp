// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/units.h"
#include "signal/median_network.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "signal/median_unknown.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "signal/lane_io-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sonar::HWY_NAMESPACE {
namespace {

/// out[i] = a[i] + b[i + shift].
HWY_INLINE void add_shifted(const std::int16_t* a, const std::int16_t* b, std::size_t shift, std::int16_t* out,
                            std::size_t size) {
  const Counts d;
  for (std::size_t i = 0; i < size; i += hn::Lanes(d)) {
    hn::StoreU(hn::Add(hn::LoadU(d, a + i), hn::LoadU(d, b + i + shift)), d, out + i);
  }
}

/// How many of the 8 m - 1 values round each sample are left out; returns the largest number.
/// in      row: `kernel / 2` values before sample 0 and behind the last may be read
///         scratch: 5 pieces of `piece` values; piece >= samples + 2 * 64
int LeftOutAlong(const std::int16_t* row, std::size_t samples, std::size_t kernel, std::int16_t* scratch,
                 std::size_t piece, std::int16_t* out) {
  const Counts d;
  const auto top = hn::Set(d, std::int16_t{32767});
  const auto bottom = hn::Set(d, std::int16_t{-32767});
  std::int16_t* sums[5];  // of 1, 2, 4, 8 and 16 values
  for (std::size_t i = 0; i < 5; ++i) sums[i] = scratch + i * piece;
  const std::size_t length = samples + kernel - 1;
  for (std::size_t i = 0; i < length; i += hn::Lanes(d)) {
    const auto v = load_some(d, row - kernel / 2 + i, length - i, 0);
    const auto left_out = hn::Or(hn::VecFromMask(d, hn::Eq(v, top)), hn::VecFromMask(d, hn::Eq(v, bottom)));
    hn::StoreU(hn::Neg(left_out), d, sums[0] + i);
  }
  for (std::size_t i = 1; i < 5; ++i) {
    add_shifted(sums[i - 1], sums[i - 1], std::size_t{1} << (i - 1), sums[i], length);
  }
  // 7 = 4 + 2 + 1, 15 = 8 + 7, 23 = 16 + 7.
  add_shifted(sums[2], sums[1], 4, sums[1], length);
  add_shifted(sums[1], sums[0], 6, sums[1], length);
  if (kernel == 15) add_shifted(sums[3], sums[1], 8, sums[1], length);
  if (kernel == 23) add_shifted(sums[4], sums[1], 16, sums[1], length);
  auto largest = hn::Zero(d);
  for (std::size_t i = 0; i < samples; i += hn::Lanes(d)) {
    const auto n = load_some(d, sums[1] + i, samples - i, 0);
    largest = hn::Max(largest, n);
    store_some(d, n, out + i, samples - i);
  }
  HWY_ALIGN std::int16_t lanes[hn::MaxLanes(Counts())];
  hn::Store(largest, d, lanes);
  return *std::max_element(lanes, lanes + hn::Lanes(d));
}

/// out = kNoData where the nine rows' numbers together exceed a limit.
void DropWhereAbove(const std::int16_t* const* numbers, std::size_t samples, std::int16_t limit, std::int16_t* out) {
  const Counts d;
  const auto bound = hn::Set(d, limit);
  for (std::size_t i = 0; i < samples; i += hn::Lanes(d)) {
    auto sum = hn::Zero(d);
    for (int n = 0; n < 9; ++n) {
      if (numbers[n] != nullptr) sum = hn::Add(sum, load_some(d, numbers[n] + i, samples - i, 0));
    }
    const auto unknown = hn::VecFromMask(d, hn::Gt(sum, bound));
    const auto v = load_some(d, out + i, samples - i, 0);
    store_some(d, hn::IfVecThenElse(unknown, hn::Set(d, kNoData), v), out + i, samples - i);
  }
}

}  // namespace
}  // namespace sonar::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sonar {

namespace {
HWY_EXPORT(LeftOutAlong);
HWY_EXPORT(DropWhereAbove);
}  // namespace

void drop_unknown(const MaskedBox& masked, int kernel_samples, View3<std::int16_t> out) {
  const Shape3 shape = masked.shape();
  const auto rows = static_cast<int>(shape.rows());
  const auto samples = static_cast<std::size_t>(shape.samples);
  if (std::count(masked.any_left_out.begin(), masked.any_left_out.end(), 1) == 0) return;
  static thread_local std::vector<std::int16_t> numbers;
  static thread_local std::vector<std::int16_t> scratch;
  numbers.resize(shape.rows() * samples);
  const std::size_t piece = samples + 256;
  scratch.assign(5 * piece, 0);
  std::vector<int> largest(shape.rows(), 0);
  const auto numbers_of = [&](int row) { return numbers.data() + static_cast<std::size_t>(row) * samples; };
  for (int row = 0; row < rows; ++row) {
    if (masked.any_left_out[static_cast<std::size_t>(row)] == 0) continue;
    largest[static_cast<std::size_t>(row)] = HWY_DYNAMIC_DISPATCH(LeftOutAlong)(
        masked.row(row / shape.beams, row % shape.beams), samples, static_cast<std::size_t>(kernel_samples),
        scratch.data(), piece, numbers_of(row));
  }
  const int half = 9 * kernel_samples / 2;
  for (int row = 0; row < rows; ++row) {
    std::array<const std::int16_t*, 9> around{};
    int most = 0;
    for (int n = 0; n < 9; ++n) {
      const int fan = std::clamp(row / shape.beams + n / 3 - 1, 0, shape.fans - 1);
      const int beam = std::clamp(row % shape.beams + n % 3 - 1, 0, shape.beams - 1);
      const int other = fan * shape.beams + beam;
      const int there = largest[static_cast<std::size_t>(other)];
      if (there > 0) around[static_cast<std::size_t>(n)] = numbers_of(other);
      most += there;
    }
    if (most <= half) continue;
    const auto to = out.row(masked.box.fan_begin + row / shape.beams, masked.box.beam_begin + row % shape.beams)
                        .subspan(static_cast<std::size_t>(masked.box.sample_begin), samples);
    HWY_DYNAMIC_DISPATCH(DropWhereAbove)
    (around.data(), samples, static_cast<std::int16_t>(half), to.data());
  }
}

}  // namespace sonar
#endif  // HWY_ONCE
