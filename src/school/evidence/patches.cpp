// SPDX-License-Identifier: Apache-2.0
#include "school/evidence/patches.h"

#include <algorithm>
#include <cstddef>

#include "base/units.h"
#include "model/water_levels.h"

namespace sonar {
namespace {

// A box of some 60 m along range and 25 by 15 degrees: patches are 40 to 250 m wide (Horne & Schneider 1997), schools mostly
// narrower, and the mean of so many blocks is told to a quarter of a dB.
constexpr std::size_t kFans = 2;  ///< on either side
constexpr std::size_t kBeams = 4;
constexpr std::size_t kBlocks = 5;
constexpr float kLeastShare = 0.125F;  ///< of the box is known

/// Replaces [outer][n][inner] by the sums over `half` neighbours on either side along n.
void sum_along(std::span<float> values, std::size_t n, std::size_t inner, std::size_t half) {
  std::vector<float> line(n * inner);
  std::vector<float> sum(inner);
  const auto add = [&](std::size_t k, float sign) {
    for (std::size_t i = 0; i < inner; ++i) sum[i] += sign * line[k * inner + i];
  };
  for (auto at = values.begin(); at != values.end(); at += std::ssize(line)) {
    std::copy_n(at, line.size(), line.begin());
    std::ranges::fill(sum, 0.0F);
    for (std::size_t k = 0; k < std::min(half, n); ++k) add(k, 1.0F);
    for (std::size_t k = 0; k < n; ++k) {
      if (k + half < n) add(k + half, 1.0F);
      if (k > half) add(k - half - 1, -1.0F);
      std::ranges::copy(sum, at + static_cast<std::ptrdiff_t>(k * inner));
    }
  }
}

}  // namespace

std::vector<std::int8_t> local_patches(View3<const std::int16_t> excess) {
  const Shape3 shape = excess.shape();
  const auto fans = static_cast<std::size_t>(shape.fans);
  const auto beams = static_cast<std::size_t>(shape.beams);
  const auto blocks = static_cast<std::size_t>(shape.samples);
  std::vector<float> sum(fans * beams * blocks, 0.0F);
  std::vector<float> number(sum.size(), 0.0F);
  for (std::size_t i = 0; i < sum.size(); ++i) {
    const std::int16_t value = excess.all()[i];
    if (value == kNoData) continue;
    // whole counts: their sums are exact in whatever order they are added
    sum[i] = value;
    number[i] = 1.0F;
  }
  for (std::vector<float>* of : {&sum, &number}) {
    sum_along(*of, blocks, 1, kBlocks);
    sum_along(*of, beams, blocks, kBeams);
    sum_along(*of, fans, beams * blocks, kFans);
  }
  constexpr auto kBox = static_cast<float>((2 * kFans + 1) * (2 * kBeams + 1) * (2 * kBlocks + 1));
  std::vector<std::int8_t> patches(sum.size(), 0);
  for (std::size_t i = 0; i < sum.size(); ++i) {
    if (number[i] < kLeastShare * kBox) continue;
    const float steps = std::clamp(sum[i] / number[i] / static_cast<float>(kPatchStep), -127.0F, 127.0F);
    patches[i] = static_cast<std::int8_t>(steps < 0.0F ? steps - 0.5F : steps + 0.5F);  // halves away from 0
  }
  return patches;
}

}  // namespace sonar
