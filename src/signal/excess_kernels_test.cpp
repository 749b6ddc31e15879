// SPDX-License-Identifier: Apache-2.0
#include "signal/excess_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "base/units.h"
#include "signal/test_targets.h"

namespace sonar {
namespace {

constexpr std::size_t kSize = 1003;  // some vectors of any width, and some values that fill none
constexpr std::int16_t kStep = 16;

struct Values {
  explicit Values(unsigned seed) : random(seed) {}

  std::vector<std::int16_t> counts(int most) {
    std::vector<std::int16_t> out(kSize);
    for (std::int16_t& value : out) {
      const auto offset = static_cast<int>(random() % static_cast<unsigned>(2 * most + 1)) - most;
      value = random() % 4 == 0 ? kNoData : static_cast<std::int16_t>(offset);
    }
    return out;
  }
  std::vector<std::uint8_t> marks() {
    std::vector<std::uint8_t> out(kSize);
    for (std::uint8_t& mark : out) mark = static_cast<std::uint8_t>(random() % 3);
    return out;
  }
  std::vector<std::int8_t> steps() {
    std::vector<std::int8_t> out(kSize);
    for (std::int8_t& step : out) step = static_cast<std::int8_t>(static_cast<int>(random() % 255) - 127);
    return out;
  }
  /// Whole numbers, exact as floats.
  std::vector<float> whole(int least, int most) {
    std::vector<float> out(kSize);
    for (float& value : out) {
      value = static_cast<float>(least + static_cast<int>(random() % static_cast<unsigned>(most - least + 1)));
    }
    return out;
  }
  std::mt19937 random;
};

void expect_marked_values_are_no_data() {
  Values values(1);
  const auto counts = values.counts(32766);
  const auto marks = values.marks();
  std::vector<std::int16_t> out(kSize);
  copy_unmarked(counts, marks, out);
  for (std::size_t i = 0; i < kSize; ++i) ASSERT_EQ(out[i], marks[i] == 0 ? counts[i] : kNoData) << i;
}
TEST(excess_kernels, marked_values_are_no_data) { test::on_each_target(expect_marked_values_are_no_data); }

void expect_excess_over_the_louder_of_water_and_noise() {
  Values values(2);
  const auto level = values.counts(32766);
  auto water = values.counts(32766);
  auto noise = values.counts(32766);
  std::ranges::replace(water, kNoData, kMinCount);
  std::ranges::replace(noise, kNoData, kMinCount);
  std::vector<std::int16_t> out(kSize);
  excess_over(level, water, noise, out);
  for (std::size_t i = 0; i < kSize; ++i) {
    const int below = std::max(water[i], noise[i]);
    const bool known = level[i] != kNoData && below > kMinCount;
    ASSERT_EQ(out[i], known ? std::clamp(level[i] - below, -30000, 30000) : kNoData) << i;
  }
}
TEST(excess_kernels, excess_over_the_louder_of_water_and_noise) {
  test::on_each_target(expect_excess_over_the_louder_of_water_and_noise);
}

void expect_excess_is_clipped_on_both_sides() {
  Values values(3);
  const auto excess = values.counts(30000);
  auto clip = values.counts(30000);
  for (std::int16_t& most : clip) most = static_cast<std::int16_t>(std::abs(std::max<int>(most, -32767)));
  const auto marks = values.marks();
  std::vector<std::int16_t> out(kSize);
  clip_excess(excess, clip, marks, out);
  for (std::size_t i = 0; i < kSize; ++i) {
    const bool known = excess[i] != kNoData && marks[i] == 0;
    ASSERT_EQ(out[i], known ? std::clamp<int>(excess[i], -clip[i], clip[i]) : kNoData) << i;
  }
}
TEST(excess_kernels, excess_is_clipped_on_both_sides) { test::on_each_target(expect_excess_is_clipped_on_both_sides); }

void expect_steps_are_taken_off_what_is_known() {
  Values values(4);
  const auto before = values.counts(30000);
  const auto steps = values.steps();
  auto after = before;
  take_off_steps(steps, kStep, after);
  for (std::size_t i = 0; i < kSize; ++i) {
    ASSERT_EQ(after[i], before[i] == kNoData ? kNoData : before[i] - kStep * steps[i]) << i;
  }
}
TEST(excess_kernels, steps_are_taken_off_what_is_known) {
  test::on_each_target(expect_steps_are_taken_off_what_is_known);
}

void expect_whitened_by_middle_and_scale() {
  Values values(5);
  const auto excess = values.counts(3000);
  const auto middle = values.whole(0, 300);
  const auto scale = values.whole(0, 3);
  std::vector<float> whitened(kSize);
  std::vector<float> number(kSize);
  whiten(excess, middle, scale, whitened, number);
  for (std::size_t i = 0; i < kSize; ++i) {
    const bool known = excess[i] != kNoData && scale[i] != 0.0F;
    ASSERT_EQ(number[i], known ? 1.0F : 0.0F) << i;
    ASSERT_EQ(whitened[i], known ? (static_cast<float>(excess[i]) - middle[i]) * scale[i] : 0.0F) << i;
  }
}
TEST(excess_kernels, whitened_by_middle_and_scale) { test::on_each_target(expect_whitened_by_middle_and_scale); }

void expect_sums_over_the_root_of_their_number() {
  Values values(6);
  const auto excess = values.counts(3000);
  const auto sum = values.whole(-100000, 100000);
  const auto number = values.whole(0, 9);
  std::vector<std::int16_t> out(kSize);
  over_root(excess, sum, number, out);
  for (std::size_t i = 0; i < kSize; ++i) {
    const bool known = excess[i] != kNoData && number[i] > 0.0F;
    const float mean = sum[i] * (1.0F / std::sqrt(std::max(number[i], 1.0F)));
    ASSERT_EQ(out[i], known ? static_cast<std::int16_t>(std::clamp(mean, -32000.0F, 32000.0F)) : kNoData) << i;
  }
}
TEST(excess_kernels, sums_over_the_root_of_their_number) {
  test::on_each_target(expect_sums_over_the_root_of_their_number);
}

void expect_means_are_rounded_to_steps() {
  Values values(7);
  const auto sum = values.whole(-400000, 400000);
  const auto number = values.whole(0, 495);
  std::vector<std::int8_t> out(kSize);
  rounded_steps(sum, number, 62.0F, kStep, out);
  for (std::size_t i = 0; i < kSize; ++i) {
    if (number[i] < 62.0F) {
      ASSERT_EQ(out[i], 0) << i;
    } else {
      const double steps = static_cast<double>(sum[i]) / static_cast<double>(number[i]) / kStep;
      ASSERT_NEAR(out[i], std::clamp(steps, -127.0, 127.0), 0.5001) << i;
    }
  }
  const std::vector<float> halves = {8.0F, -8.0F, 24.0F, 7.0F, 0.0F};
  std::vector<std::int8_t> rounded(halves.size());
  rounded_steps(halves, std::vector<float>(halves.size(), 1.0F), 1.0F, kStep, rounded);
  EXPECT_EQ(rounded, (std::vector<std::int8_t>{1, -1, 2, 0, 0}));
}
TEST(excess_kernels, means_are_rounded_to_steps) { test::on_each_target(expect_means_are_rounded_to_steps); }

}  // namespace
}  // namespace sonar
