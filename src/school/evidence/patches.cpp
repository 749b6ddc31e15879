// SPDX-License-Identifier: Apache-2.0
#include "school/evidence/patches.h"

#include <algorithm>
#include <cstddef>

#include "base/units.h"
#include "model/water_levels.h"
#include "signal/excess_kernels.h"

namespace sonar {
namespace {

// A box of some 60 m along range and 25 by 15 degrees: patches are 40 to 250 m wide (Horne & Schneider 1997), schools mostly
// narrower, and the mean of so many blocks is told to a quarter of a dB.
constexpr std::size_t kFans = 2;  ///< on either side
constexpr std::size_t kBeams = 4;
constexpr std::size_t kBlocks = 5;
constexpr float kLeastShare = 0.125F;  ///< of the box is known

/// A sum of counts and how many there are, in one number: boxes are summed once instead of twice.
constexpr int kNumberBits = 9;
constexpr int kNumbers = (1 << kNumberBits) - 1;
constexpr std::int16_t kMostCounts = 8191;  ///< 96 dB; a box of such still fits
static_assert((2 * kFans + 1) * (2 * kBeams + 1) * (2 * kBlocks + 1) <= kNumbers);

/// Sums of [outer][n][inner] over `half` neighbours on either side along n.
std::vector<std::int32_t> sum_along(const std::vector<std::int32_t>& values, std::size_t n, std::size_t inner,
                                    std::size_t half) {
  std::vector<std::int32_t> out(values.size());
  std::vector<std::int32_t> sum(inner);
  const std::vector<std::int32_t> nothing(inner);
  for (std::size_t first = 0; first < values.size(); first += n * inner) {
    const auto line = [&](std::size_t k) { return k < n ? values.data() + first + k * inner : nothing.data(); };
    std::ranges::fill(sum, 0);
    for (std::size_t k = 0; k < n + half; ++k) {
      const std::int32_t* comes = line(k);
      const std::int32_t* goes = k > 2 * half ? line(k - 2 * half - 1) : nothing.data();
      for (std::size_t i = 0; i < inner; ++i) sum[i] += comes[i] - goes[i];
      if (k >= half) std::ranges::copy(sum, out.begin() + static_cast<std::ptrdiff_t>(first + (k - half) * inner));
    }
  }
  return out;
}

/// The same along a row.
void sum_along_row(std::span<const std::int32_t> row, std::size_t half, std::span<std::int32_t> out) {
  std::int32_t sum = 0;
  for (std::size_t k = 0; k < row.size() + half; ++k) {
    const std::int32_t comes = k < row.size() ? row[k] : 0;
    const std::int32_t goes = k > 2 * half ? row[k - 2 * half - 1] : 0;
    sum += comes - goes;
    if (k >= half) out[k - half] = sum;
  }
}

}  // namespace

std::vector<std::int8_t> local_patches(View3<const std::int16_t> excess) {
  const Shape3 shape = excess.shape();
  const auto fans = static_cast<std::size_t>(shape.fans);
  const auto beams = static_cast<std::size_t>(shape.beams);
  const auto blocks = static_cast<std::size_t>(shape.samples);
  std::vector<std::int32_t> sums(shape.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const std::int16_t value = excess.all()[i];
    const std::int32_t within = std::clamp(value, static_cast<std::int16_t>(-kMostCounts), kMostCounts);
    sums[i] = value != kNoData ? within * (kNumbers + 1) + 1 : 0;
  }
  sums = sum_along(sum_along(sums, fans, beams * blocks, kFans), beams, blocks, kBeams);
  std::vector<std::int32_t> box(blocks);
  std::vector<float> sum(sums.size());
  std::vector<float> number(sums.size());
  for (std::size_t first = 0; first < sums.size(); first += blocks) {
    sum_along_row(std::span(sums).subspan(first, blocks), kBlocks, box);
    for (std::size_t i = 0; i < blocks; ++i) {
      sum[first + i] = static_cast<float>(box[i] >> kNumberBits);
      number[first + i] = static_cast<float>(box[i] & kNumbers);
    }
  }
  constexpr auto kBox = static_cast<float>((2 * kFans + 1) * (2 * kBeams + 1) * (2 * kBlocks + 1));
  std::vector<std::int8_t> patches(sums.size());
  rounded_steps(sum, number, kLeastShare * kBox, kPatchStep, patches);
  return patches;
}

}  // namespace sonar
