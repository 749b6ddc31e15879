// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#include "base/array.h"
#include "base/sample_flags.h"
#include "base/units.h"

namespace sonar {

// Small deterministic material for this room's tests.

/// SplitMix64: the same numbers everywhere.
class TestRandom {
 public:
  explicit TestRandom(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }
  /// 0 < x <= 1.
  double uniform() { return (static_cast<double>(next() >> 11) + 1.0) * 0x1p-53; }
  int below(int n) { return static_cast<int>(next() % static_cast<std::uint64_t>(n)); }
  /// Mean 1: the power of speckle and of noise.
  double exponential() { return -std::log(uniform()); }

 private:
  std::uint64_t state_;
};

inline std::int16_t counts_of_power(double power) {
  return static_cast<std::int16_t>(std::lround(counts_from_db(10.0 * std::log10(power))));
}

/// Exponential noise of a mean level in dB re 1 W.
inline Array3<std::int16_t> noise_ping(Shape3 shape, double level_db, std::uint64_t seed) {
  TestRandom random(seed);
  Array3<std::int16_t> ping(shape);
  for (auto& count : ping.all()) count = counts_of_power(std::pow(10.0, level_db / 10.0) * random.exponential());
  return ping;
}

inline std::size_t count_flag(const Array3<SampleFlags>& flags, SampleFlags flag) {
  std::size_t n = 0;
  for (const SampleFlags f : flags.all()) n += any(f & flag) ? 1U : 0U;
  return n;
}

}  // namespace sonar
