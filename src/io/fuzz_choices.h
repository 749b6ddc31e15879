// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string>

namespace sonar::fuzz {

/// Takes choices off the fuzzer's bytes; zeros behind their end.
class Choices {
 public:
  explicit Choices(std::span<const std::byte> bytes) : bytes_(bytes) {}

  [[nodiscard]] bool done() const { return at_ >= bytes_.size(); }
  std::size_t byte() { return done() ? 0 : std::to_integer<std::size_t>(bytes_[at_++]); }
  /// 0 .. count - 1
  std::size_t below(std::size_t count) {
    if (count < 2) return 0;
    const std::size_t low = byte();
    return (count > 256 ? low | byte() << 8U : low) % count;
  }
  /// Bounds of types, nothing at all, small numbers, any bits.
  double number() {
    constexpr double kInf = std::numeric_limits<double>::infinity();
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr std::array<double, 16> kOdd = {0.0,    -1.0,  1.0,          2.0,           59.0,   60.0,    255.0, -0.5,
                                             1e-300, 1e300, 2147483647.0, -2147483648.0, 9.2e18, -9.2e18, kInf,  kNan};
    const std::size_t kind = byte();
    if (kind < 128) return kOdd[kind % kOdd.size()];
    if (kind < 192) return static_cast<double>(below(65536)) - 32768.0;
    double value = 0.0;
    const std::uint64_t raw = bits();
    std::memcpy(&value, &raw, sizeof value);
    return value;
  }
  std::int64_t whole() {
    constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
    constexpr std::array<std::int64_t, 8> kOdd = {0, -1, 1, 2, 4, kMost, -kMost - 1, 2147483648};
    const std::size_t kind = byte();
    if (kind < 128) return kOdd[kind % kOdd.size()];
    if (kind < 192) return static_cast<std::int64_t>(below(65536)) - 32768;
    return static_cast<std::int64_t>(bits());
  }
  /// Without zero bytes, at which netCDF's texts end.
  std::string text() {
    std::string made;
    for (std::size_t left = byte() % 64; left > 0 && !done(); --left) {
      if (const std::size_t c = byte(); c != 0) made += static_cast<char>(c);
    }
    return made;
  }

 private:
  std::uint64_t bits() {
    std::uint64_t raw = 0;
    for (int i = 0; i < 8; ++i) raw = raw << 8U | byte();
    return raw;
  }
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
};

}  // namespace sonar::fuzz
