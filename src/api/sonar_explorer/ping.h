// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace sonar_explorer {

/// Axes of a ping's arrays, in this order, sample fastest.
struct Shape {
  int fans = 0;     ///< from the deepest
  int beams = 0;    ///< from the most aft where the sonar looks to port
  int samples = 0;  ///< along range
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(fans) * static_cast<std::size_t>(beams) * static_cast<std::size_t>(samples);
  }
  friend bool operator==(const Shape&, const Shape&) = default;
};

/// Counts of power and Sv: dB = count * kDbPerCount, 10 log10(2) / 256.
inline constexpr double kDbPerCount = 3.0102999566398119521 / 256.0;
/// The count of a sample that is not there.
inline constexpr std::int16_t kNoData = -32768;

/// Bits of a ping's flags.
enum : std::uint8_t {
  kNearField = 1,
  kSurface = 2,
  kCorruptedPackets = 4,
  kDropout = 8,
  kInterference = 16,
  kImpulseNoise = 32,
  kSeabed = 64,
  kLowSnr = 128,
};

/// One ping's samples. Copies share them; they live as long as any copy.
/// threads  any
class Ping {
 public:
  struct Arrays;
  explicit Ping(std::shared_ptr<const Arrays> arrays) : arrays_(std::move(arrays)) {}

  [[nodiscard]] Shape shape() const;
  /// [fan][beam][sample] received power, counts re 1 W; kNoData = not recorded
  [[nodiscard]] std::span<const std::int16_t> power() const;
  /// [fan][beam][sample] volume backscattering strength as calibrated, counts re 1 m^-1
  [[nodiscard]] std::span<const std::int16_t> sv() const;
  /// [fan][beam][sample] Sv after the median filter, in which schools are grown and detected, counts re 1 m^-1
  [[nodiscard]] std::span<const std::int16_t> sv_filtered() const;
  /// [fan][beam][sample] bits: why a sample is not to be trusted; 0 = sound
  [[nodiscard]] std::span<const std::uint8_t> flags() const;
  /// [fan][beam] background noise power that is subtracted, dB re 1 W; NaN = none known
  [[nodiscard]] std::span<const double> background_power_db() const;

 private:
  std::shared_ptr<const Arrays> arrays_;
};

}  // namespace sonar_explorer
