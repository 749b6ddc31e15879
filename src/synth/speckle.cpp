// SPDX-License-Identifier: Apache-2.0
#include "synth/speckle.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <numbers>

#include "base/units.h"

namespace sonar::synth {
namespace {

constexpr std::size_t kRadiusSteps = 65536;
constexpr std::size_t kAngleSteps = 4096;
constexpr unsigned kMantissaBits = 12;

/// Tables that turn 32 random bits into a complex Gaussian of power 1 and a power into a count.
struct Tables {
  std::array<float, kRadiusSteps> radius{};
  std::array<float, kAngleSteps> cosine{};
  std::array<float, kAngleSteps> sine{};
  std::array<float, std::size_t{1} << kMantissaBits> log2_mantissa{};

  Tables() {
    for (std::size_t i = 0; i < kRadiusSteps; ++i) {
      radius[i] = static_cast<float>(std::sqrt(-std::log((static_cast<double>(i) + 0.5) / kRadiusSteps)));
    }
    for (std::size_t i = 0; i < kAngleSteps; ++i) {
      const double angle = 2.0 * std::numbers::pi * (static_cast<double>(i) + 0.5) / kAngleSteps;
      cosine[i] = static_cast<float>(std::cos(angle));
      sine[i] = static_cast<float>(std::sin(angle));
    }
    const auto steps = static_cast<double>(log2_mantissa.size());
    for (std::size_t i = 0; i < log2_mantissa.size(); ++i) {
      log2_mantissa[i] = static_cast<float>(std::log2(1.0 + (static_cast<double>(i) + 0.5) / steps));
    }
  }
};

const Tables& tables() {
  static const std::unique_ptr<const Tables> made = std::make_unique<const Tables>();
  return *made;
}

/// log2 of a positive, normal float to 2e-4: the exponent, and the mantissa's first bits by table.
inline float fast_log2(const Tables& t, float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const auto exponent = static_cast<float>(static_cast<std::int32_t>(bits >> 23U) - 127);
  return exponent + t.log2_mantissa[(bits & 0x7FFFFFU) >> (23U - kMantissaBits)];
}

inline std::int16_t rounded(float counts) {
  const float kept = std::clamp(counts, static_cast<float>(kMinCount), static_cast<float>(kMaxCount));
  return static_cast<std::int16_t>(static_cast<std::int32_t>(kept + 40000.5F) - 40000);
}

}  // namespace

std::int16_t count_of_power(double power_w) {
  const double counts = power_w > 0.0 ? std::round(256.0 * std::log2(power_w)) : kMinCount;
  return static_cast<std::int16_t>(std::clamp(counts, static_cast<double>(kMinCount), static_cast<double>(kMaxCount)));
}

void speckled_counts(std::span<const float> expected_w, double correlation, RandomStream random,
                     std::span<std::int16_t> out) {
  constexpr float kLeast = 1e-37F;  // the smallest normal floats; logarithms below would be wrong
  const Tables& t = tables();
  const auto kept = static_cast<float>(correlation);
  const auto fresh = static_cast<float>(std::sqrt(1.0 - correlation * correlation));
  float re = 0.0F;
  float im = 0.0F;
  for (std::size_t i = 0; i < out.size(); i += 4) {
    const std::array<std::uint32_t, 4> words = random.block();
    const std::size_t n = std::min<std::size_t>(4, out.size() - i);
    for (std::size_t k = 0; k < n; ++k) {
      const float radius = t.radius[words[k] & 0xFFFFU];
      const std::size_t angle = words[k] >> 20U;
      const bool first = i + k == 0;
      const float scale = first ? 1.0F : fresh;
      re = kept * re + scale * radius * t.cosine[angle];
      im = kept * im + scale * radius * t.sine[angle];
      const float power = expected_w[i + k] * (re * re + im * im);
      out[i + k] = rounded(256.0F * fast_log2(t, std::max(power, kLeast)));
    }
  }
}

void expected_counts(std::span<const float> expected_w, std::span<std::int16_t> out) {
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = count_of_power(static_cast<double>(expected_w[i]));
}

}  // namespace sonar::synth
