// SPDX-License-Identifier: Apache-2.0
#include "school/evidence/patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "base/units.h"
#include "model/water_levels.h"

namespace sonar {
namespace {

/// Mean of the box round each block, in steps, by adding up each box by itself.
double plain_steps(const Array3<std::int16_t>& excess, int fan, int beam, int block) {
  const Shape3 shape = excess.shape();
  double sum = 0.0;
  int number = 0;
  for (int f = std::max(0, fan - 2); f <= std::min(shape.fans - 1, fan + 2); ++f) {
    for (int b = std::max(0, beam - 4); b <= std::min(shape.beams - 1, beam + 4); ++b) {
      for (int s = std::max(0, block - 5); s <= std::min(shape.samples - 1, block + 5); ++s) {
        if (excess(f, b, s) == kNoData) continue;
        sum += excess(f, b, s);
        ++number;
      }
    }
  }
  if (8 * number < 5 * 9 * 11) return 0.0;
  return std::clamp(sum / number / kPatchStep, -127.0, 127.0);
}

void expect_plain_boxes(const Array3<std::int16_t>& excess) {
  const Shape3 shape = excess.shape();
  const std::vector<std::int8_t> patches = local_patches(excess.view());
  ASSERT_EQ(patches.size(), shape.size());
  std::size_t i = 0;
  for (int fan = 0; fan < shape.fans; ++fan) {
    for (int beam = 0; beam < shape.beams; ++beam) {
      for (int block = 0; block < shape.samples; ++block) {
        ASSERT_NEAR(patches[i++], plain_steps(excess, fan, beam, block), 0.5001) << fan << " " << beam << " " << block;
      }
    }
  }
}

TEST(patches, are_the_means_of_the_boxes_round_each_block) {
  std::mt19937 random(28);
  for (const Shape3 shape :
       {Shape3{20, 25, 89}, Shape3{3, 7, 40}, Shape3{1, 70, 30}, Shape3{6, 9, 3}, Shape3{1, 1, 200}}) {
    Array3<std::int16_t> excess(shape);
    for (std::int16_t& value : excess.all()) {
      const auto any = static_cast<int>(random() % 1601) - 800;
      value = random() % 3 == 0 ? kNoData : static_cast<std::int16_t>(any);
    }
    expect_plain_boxes(excess);
  }
}

// The largest that a sum and its number are held for together; what is more counts as that.
TEST(patches, boxes_of_the_loudest_and_the_faintest_blocks_do_not_run_over) {
  for (const int level : {8191, -8191, 30000, -30000}) {
    const Array3<std::int16_t> excess({5, 9, 40}, static_cast<std::int16_t>(level));
    for (const std::int8_t patch : local_patches(excess.view())) ASSERT_EQ(patch, level > 0 ? 127 : -127);
  }
}

}  // namespace
}  // namespace sonar
