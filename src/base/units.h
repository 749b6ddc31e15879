// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace sonar {

/// One count of stored power or Sv: 10 log10(2) / 256 dB (Simrad's compressed power).
inline constexpr double kDbPerCount = 3.0102999566398119521 / 256.0;

/// The count that says "no data".
inline constexpr std::int16_t kNoData = -32768;

/// Smallest and largest count that data may hold; the two values beyond them are the masked median's plus and minus
/// infinity.
inline constexpr std::int16_t kMinCount = -32766;
inline constexpr std::int16_t kMaxCount = 32766;

inline constexpr double kMetresPerNauticalMile = 1852.0;
inline constexpr double kKnot_mps = kMetresPerNauticalMile / 3600.0;

[[nodiscard]] inline double db_from_linear(double linear) { return 10.0 * std::log10(linear); }
[[nodiscard]] inline double linear_from_db(double db) { return std::exp(db * (std::numbers::ln10 / 10.0)); }
[[nodiscard]] constexpr double db_from_counts(double counts) { return counts * kDbPerCount; }
[[nodiscard]] constexpr double counts_from_db(double db) { return db / kDbPerCount; }
[[nodiscard]] constexpr double rad_from_deg(double deg) { return deg * (std::numbers::pi / 180.0); }
[[nodiscard]] constexpr double deg_from_rad(double rad) { return rad * (180.0 / std::numbers::pi); }

/// The nearest whole number, halves upwards, without a call of the mathematical library. |value| < 2^30
[[nodiscard]] constexpr int nearest_int(double value) {
  constexpr int kOffset = 1 << 30;
  // NOLINTNEXTLINE(bugprone-incorrect-roundings): what is cut off is above 0
  return static_cast<int>(static_cast<std::int64_t>(value + kOffset + 0.5) - kOffset);
}

namespace detail {

/// 2^((k + shift) / 256), k = 0..255, by exp's series: alike with every compiler.
constexpr std::array<double, 256> powers_of_two(double shift) {
  std::array<double, 256> powers{};
  for (std::size_t k = 0; k < powers.size(); ++k) {
    const long double x = (static_cast<long double>(k) + shift) / 256.0L * std::numbers::ln2_v<long double>;
    long double sum = 1.0L;
    for (int n = 24; n > 0; --n) sum = 1.0L + x / n * sum;
    powers[k] = static_cast<double>(sum);
  }
  return powers;
}
inline constexpr std::array<double, 256> kPowersOfTwo = powers_of_two(0.0);
inline constexpr std::array<double, 256> kBetweenPowers = powers_of_two(0.5);

inline constexpr int kMantissaBits = 52;
inline constexpr int kExponentBias = 1023;

}  // namespace detail

/// Linear value of a count, 10^(dB/10) = 2^(count/256); 0 for "no data".
[[nodiscard]] constexpr double linear_from_count(std::int16_t count) {
  if (count == kNoData) return 0.0;
  const auto mantissa = std::bit_cast<std::uint64_t>(detail::kPowersOfTwo[static_cast<std::size_t>(count & 255)]);
  const auto octave = static_cast<std::uint64_t>(static_cast<std::int64_t>(count >> 8));
  return std::bit_cast<double>(mantissa + (octave << detail::kMantissaBits));
}

/// The count nearest to a linear value > 0, by no library's logarithm; kMinCount..kMaxCount.
[[nodiscard]] constexpr std::int16_t count_from_linear(double linear) {
  constexpr double kLeast = linear_from_count(kMinCount);
  constexpr double kMost = linear_from_count(kMaxCount);
  if (!(linear > kLeast)) return kMinCount;
  if (linear >= kMost) return kMaxCount;
  const auto bits = std::bit_cast<std::uint64_t>(linear);
  const int octave = static_cast<int>(bits >> detail::kMantissaBits) - detail::kExponentBias;
  constexpr std::uint64_t kMantissa = (std::uint64_t{1} << detail::kMantissaBits) - 1;
  constexpr auto kOne = static_cast<std::uint64_t>(detail::kExponentBias) << detail::kMantissaBits;
  const double mantissa = std::bit_cast<double>((bits & kMantissa) | kOne);
  // at most log2(m), and by 0.005 at most less
  const double t = mantissa - 1.0;
  auto k = static_cast<std::size_t>(256.0 * (t + t * (1.0 - t) * (0.43 - 0.2 * t)));
  while (k < detail::kBetweenPowers.size() && mantissa >= detail::kBetweenPowers[k]) ++k;
  return static_cast<std::int16_t>(256 * octave + static_cast<int>(k));
}

}  // namespace sonar
