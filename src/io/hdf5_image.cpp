// SPDX-License-Identifier: Apache-2.0
#include "io/hdf5_image.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string_view>

namespace sonar::netcdf {
namespace {

constexpr std::size_t kVersionAt = 8;
constexpr std::size_t kOffsetSizeAt = 9;
constexpr std::size_t kSumAt = 44;  ///< where addresses have 8 bytes

std::uint32_t word_at(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) word |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8 * i);
  return word;
}

/// lookup3 of the 44 bytes before the sum: three rounds of 12, and 8 at the end.
std::uint32_t lookup3_of_superblock(std::span<const std::byte> bytes) {
  std::uint32_t a = 0xDEADBEEF + static_cast<std::uint32_t>(kSumAt);
  std::uint32_t b = a;
  std::uint32_t c = a;
  const auto take = [&](std::uint32_t& x, std::uint32_t y, int turn) {
    x -= y;
    x ^= std::rotl(y, turn);
  };
  for (std::size_t at = 0; at < 36; at += 12) {
    a += word_at(bytes, at);
    b += word_at(bytes, at + 4);
    c += word_at(bytes, at + 8);
    take(a, c, 4), c += b;
    take(b, a, 6), a += c;
    take(c, b, 8), b += a;
    take(a, c, 16), c += b;
    take(b, a, 19), a += c;
    take(c, b, 4), b += a;
  }
  a += word_at(bytes, 36);
  b += word_at(bytes, 40);
  const auto last = [](std::uint32_t& x, std::uint32_t y, int turn) { x = (x ^ y) - std::rotl(y, turn); };
  last(c, b, 14);
  last(a, c, 11);
  last(b, a, 25);
  last(c, b, 16);
  last(a, c, 4);
  last(b, a, 14);
  last(c, b, 24);
  return c;
}

}  // namespace

bool seal_superblock(std::span<std::byte> image) {
  constexpr std::array kSignature{std::byte{0x89}, std::byte{'H'},  std::byte{'D'},  std::byte{'F'},
                                  std::byte{'\r'}, std::byte{'\n'}, std::byte{0x1A}, std::byte{'\n'}};
  if (image.size() < kSumAt + 4 || !std::equal(kSignature.begin(), kSignature.end(), image.begin())) return false;
  const auto version = std::to_integer<int>(image[kVersionAt]);
  if ((version != 2 && version != 3) || image[kOffsetSizeAt] != std::byte{8}) return false;
  const std::uint32_t sum = lookup3_of_superblock(image);
  for (std::size_t i = 0; i < 4; ++i) image[kSumAt + i] = static_cast<std::byte>(sum >> (8 * i));
  return true;
}

}  // namespace sonar::netcdf
