// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace sonar::synth {

/// One block of Philox4x32-10: a bijection of 128 counter bits under a 64-bit key. Any block can be made at any time on
/// any thread, so that no result depends on order.
/// source  Salmon, Moraes, Dror, Shaw: Parallel random numbers, as easy as 1, 2, 3 (SC 2011)
[[nodiscard]] inline std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                                         std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t p0 = std::uint64_t{0xD2511F53U} * counter[0];
    const std::uint64_t p1 = std::uint64_t{0xCD9E8D57U} * counter[2];
    counter = {static_cast<std::uint32_t>(p1 >> 32U) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(p1),
               static_cast<std::uint32_t>(p0 >> 32U) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(p0)};
    key[0] += 0x9E3779B9U;
    key[1] += 0xBB67AE85U;
  }
  return counter;
}

/// What a stream of random numbers is for; part of its key, so that no two purposes share numbers.
enum class Purpose : std::uint32_t {
  speckle,
  body,
  ragged,
  placement,
  corrupted_packets,
  interference,
  impulse,
  dropout,
  beam_noise,
  relief,
  // The array's physics (synth/array).
  water,
  element,
  school,
  fish,
  milling,
  cloud,
  sea,
  diffuse,
  other_sounder,
  sphere,
  stated
};

/// A stream of random numbers, one for each (seed, observation, ping, channel, purpose).
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, Purpose purpose, std::uint32_t observation = 0, std::uint32_t ping = 0,
               std::uint32_t channel = 0)
      : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U)},
        counter_{0, ping, channel | static_cast<std::uint32_t>(purpose) << 24U, observation} {}

  /// The next four words at once.
  [[nodiscard]] std::array<std::uint32_t, 4> block() {
    const auto words = philox(counter_, key_);
    ++counter_[0];
    return words;
  }
  [[nodiscard]] std::uint32_t next() {
    if (left_ == 0) {
      words_ = block();
      left_ = 4;
    }
    return words_[--left_];
  }
  /// Open interval (0, 1).
  [[nodiscard]] double uniform() { return (static_cast<double>(next()) + 0.5) / 4294967296.0; }
  [[nodiscard]] double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// 0 .. n-1; n > 0.
  [[nodiscard]] int index(int n) {
    return static_cast<int>((std::uint64_t{next()} * static_cast<std::uint64_t>(n)) >> 32U);
  }
  [[nodiscard]] double normal() {
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }
  /// Number of events of a Poisson process with this mean (0..700).
  [[nodiscard]] int poisson(double mean) {
    const double left = std::exp(-mean);
    int events = 0;
    for (double p = uniform(); p > left; p *= uniform()) ++events;
    return events;
  }

 private:
  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 4> words_{};
  std::size_t left_ = 0;
};

}  // namespace sonar::synth
