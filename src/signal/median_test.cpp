// SPDX-License-Identifier: Apache-2.0
#include "signal/median.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <vector>

#include "base/units.h"
#include "signal/test_data.h"
#include "signal/test_targets.h"

namespace sonar {
namespace {

enum class Fill { random, equal, extreme, zero_one };

Array3<std::int16_t> filled(Shape3 shape, Fill fill, std::uint64_t seed) {
  TestRandom random(seed);
  Array3<std::int16_t> ping(shape);
  for (auto& count : ping.all()) {
    switch (fill) {
      case Fill::random:
        count = static_cast<std::int16_t>(random.below(65533) - 32766);
        break;
      case Fill::equal:
        count = -7000;
        break;
      case Fill::extreme:
        count = random.below(2) == 0 ? kMinCount : kMaxCount;
        break;
      case Fill::zero_one:
        count = static_cast<std::int16_t>(random.below(2));
        break;
    }
  }
  return ping;
}

/// Flags as they come: near field, a surface corner, stretches and single samples, some not recorded.
Array3<SampleFlags> sprinkled(Array3<std::int16_t>& ping, std::uint64_t seed) {
  const Shape3 shape = ping.shape();
  TestRandom random(seed);
  Array3<SampleFlags> flags(shape);
  for (int f = 0; f < shape.fans; ++f) {
    for (int b = 0; b < shape.beams; ++b) {
      const int hot = random.below(shape.samples);
      for (int s = 0; s < shape.samples; ++s) {
        if (s < shape.samples / 30) flags(f, b, s) |= SampleFlags::near_field;
        if (f == shape.fans - 1 && s > shape.samples / 2) flags(f, b, s) |= SampleFlags::surface;
        if (b % 4 == 1 && s > hot && s < hot + 40) flags(f, b, s) |= SampleFlags::corrupted;
        if (s > shape.samples / 3 && s < shape.samples / 3 + 6) flags(f, b, s) |= SampleFlags::interference;
        if (random.below(100) == 0) flags(f, b, s) |= SampleFlags::impulse;
        if (random.below(300) == 0) flags(f, b, s) |= SampleFlags::low_snr;
        if (f == 0 && s > shape.samples - 9) flags(f, b, s) |= SampleFlags::seabed;
        if (random.below(200) == 0) ping(f, b, s) = kNoData;
        if (b == shape.beams - 1 && s > shape.samples - 5) ping(f, b, s) = kNoData;
      }
    }
  }
  return flags;
}

Array3<std::int16_t> by(MedianMethod method, const Array3<std::int16_t>& ping, const Array3<SampleFlags>& flags,
                        const MedianParams& params, Work* work = nullptr) {
  Array3<std::int16_t> out(ping.shape(), 123);
  median_into(ping.view(), flags.view(), params, method, work, out.view());
  return out;
}

/// Compares both fast ways, where there are both, with the plain one.
void expect_equal_to_reference(Array3<std::int16_t> ping, const MedianParams& params, std::uint64_t seed) {
  for (const bool with_flags : {false, true}) {
    const auto flags = with_flags ? sprinkled(ping, seed) : Array3<SampleFlags>(ping.shape());
    const auto expected = median_reference(ping.view(), flags.view(), params);
    EXPECT_TRUE(by(MedianMethod::histogram, ping, flags, params) == expected) << "histogram";
    EXPECT_TRUE(by(MedianMethod::automatic, ping, flags, params) == expected) << "automatic";
    if (has_network(params)) {
      EXPECT_TRUE(by(MedianMethod::network, ping, flags, params) == expected) << "network";
    }
  }
}

constexpr Shape3 kShapes[] = {{1, 1, 1},  {1, 1, 22},   {1, 7, 100}, {6, 1, 50},  {2, 2, 23},  {3, 5, 9},
                              {5, 4, 64}, {20, 25, 40}, {4, 60, 31}, {40, 3, 33}, {2, 3, 1319}};

TEST(median, equals_the_plain_one_on_every_fill_and_shape) {
  for (const Shape3 shape : kShapes) {
    for (const Fill fill : {Fill::random, Fill::equal, Fill::extreme, Fill::zero_one}) {
      SCOPED_TRACE(testing::Message() << shape.fans << " x " << shape.beams << " x " << shape.samples << ", fill "
                                      << static_cast<int>(fill));
      expect_equal_to_reference(filled(shape, fill, 1), {}, 2);
    }
  }
}

TEST(median, equals_the_plain_one_for_every_network_length) {
  for (const int samples : {7, 15, 23, 31}) {
    MedianParams params;
    params.kernel_samples = samples;
    EXPECT_EQ(has_network(params), samples < 31);
    SCOPED_TRACE(samples);
    expect_equal_to_reference(filled({5, 9, 75}, Fill::random, 3), params, 4);
    expect_equal_to_reference(filled({3, 18, 70}, Fill::zero_one, 5), params, 6);
  }
}

TEST(median, equals_the_plain_one_for_other_boxes) {
  for (const auto& [fans, beams, samples] : {std::array{1, 1, 1}, {1, 3, 5}, {5, 5, 11}, {3, 3, 63}, {7, 1, 9}}) {
    const MedianParams params{.enabled = true, .kernel_fans = fans, .kernel_beams = beams, .kernel_samples = samples};
    SCOPED_TRACE(testing::Message() << fans << " x " << beams << " x " << samples);
    expect_equal_to_reference(filled({4, 6, 50}, Fill::random, 7), params, 8);
  }
}

TEST(median, a_large_grid_and_a_long_beam) {
  for (const Shape3 shape : {Shape3{60, 40, 50}, Shape3{3, 3, 10000}}) {
    const auto ping = filled(shape, Fill::random, 9);
    const Array3<SampleFlags> flags(shape);
    EXPECT_TRUE(by(MedianMethod::automatic, ping, flags, {}) == by(MedianMethod::histogram, ping, flags, {}));
  }
}

TEST(median, every_instruction_set_gives_the_same_bits) {
  auto ping = filled({4, 21, 120}, Fill::random, 10);
  const auto flags = sprinkled(ping, 11);
  const auto expected = median_reference(ping.view(), flags.view(), {});
  test::on_each_target([&] { EXPECT_TRUE(by(MedianMethod::automatic, ping, flags, {}) == expected); });
}

TEST(median, any_number_of_threads_gives_the_same_bits) {
  auto ping = filled({6, 11, 900}, Fill::random, 12);
  const auto flags = sprinkled(ping, 13);
  Work one(1);
  Work three(3);
  const auto alone = by(MedianMethod::automatic, ping, flags, {});
  EXPECT_TRUE(median(ping.view(), flags.view(), {}, one) == alone);
  EXPECT_TRUE(median(ping.view(), flags.view(), {}, three) == alone);
}

// By hand: in a constant field with flagged interference of strong samples the median is the constant, also where it lies;
// the near field is cut away and leaves no data.
TEST(median, flagged_samples_do_not_count) {
  const Shape3 shape{5, 6, 200};
  Array3<std::int16_t> ping(shape, -5000);
  Array3<SampleFlags> flags(shape);
  for (int f = 0; f < shape.fans; ++f) {
    for (int b = 0; b < shape.beams; ++b) {
      for (int s = 0; s < 20; ++s) flags(f, b, s) = SampleFlags::near_field, ping(f, b, s) = 30000;
      for (int s = 100; s < 106; ++s) flags(f, b, s) = SampleFlags::interference, ping(f, b, s) = 20000;
    }
  }
  const auto out = by(MedianMethod::automatic, ping, flags, {});
  for (int s = 0; s < shape.samples; ++s) EXPECT_EQ(out(2, 3, s), s < 20 ? kNoData : -5000) << s;
}

// By hand: with all of the box's right half lost, a voxel whose kernel is lost by more than half knows nothing.
TEST(median, more_than_half_left_out_is_no_data) {
  const Shape3 shape{3, 3, 100};
  Array3<std::int16_t> ping(shape, -5000);
  Array3<SampleFlags> flags(shape);
  for (int f = 0; f < 3; ++f) {
    for (int b = 0; b < 3; ++b) {
      for (int s = 50; s < 100; ++s) flags(f, b, s) = SampleFlags::dropout;
    }
  }
  const auto out = by(MedianMethod::automatic, ping, flags, {});
  // The kernel of sample s holds s + 11 - 49 lost of 23 slices: 11 at s = 49, 12 at s = 50.
  EXPECT_EQ(out(1, 1, 49), -5000);
  EXPECT_EQ(out(1, 1, 50), kNoData);
}

TEST(median, monotone_maps_commute) {
  const auto ping = filled({5, 6, 80}, Fill::random, 14);
  const Array3<SampleFlags> flags(ping.shape());
  const auto map = [](std::int16_t v) { return v == kNoData ? v : static_cast<std::int16_t>(v / 3 - 100); };
  auto mapped = ping;
  for (auto& v : mapped.all()) v = map(v);
  auto expected = by(MedianMethod::automatic, ping, flags, {});
  for (auto& v : expected.all()) v = map(v);
  EXPECT_TRUE(by(MedianMethod::automatic, mapped, flags, {}) == expected);
}

TEST(median, switched_off_it_only_masks) {
  auto ping = filled({2, 3, 90}, Fill::random, 15);
  const auto flags = sprinkled(ping, 16);
  MedianParams off;
  off.enabled = false;
  EXPECT_TRUE(by(MedianMethod::automatic, ping, flags, off) == median_reference(ping.view(), flags.view(), off));
}

TEST(median, an_empty_or_wholly_flagged_ping) {
  const Shape3 shape{3, 4, 50};
  const auto ping = filled(shape, Fill::random, 17);
  const Array3<SampleFlags> flags(shape, SampleFlags::near_field);
  EXPECT_TRUE(by(MedianMethod::automatic, ping, flags, {}) == Array3<std::int16_t>(shape, kNoData));
  EXPECT_TRUE(
      by(MedianMethod::automatic, Array3<std::int16_t>({0, 0, 0}), Array3<SampleFlags>({0, 0, 0}), {}).all().empty());
}

}  // namespace
}  // namespace sonar
