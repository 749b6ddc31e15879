// SPDX-License-Identifier: Apache-2.0
#include "base/hash.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sonar {
namespace {

/// The buffer of xxHash's own sanity check: the top byte of a running product.
std::vector<std::byte> sanity_buffer(std::size_t size) {
  std::uint64_t product = 2654435761U;
  std::vector<std::byte> bytes(size);
  for (std::byte& byte : bytes) {
    byte = static_cast<std::byte>(product >> 56U);
    product *= 11400714785074694797ULL;
  }
  return bytes;
}

// From the table of xxHash's sanity check (seed 0).
TEST(Hash, KnownVectors) {
  EXPECT_EQ(hash_bytes({}), (Hash128{0x99AA06D3014798D8ULL, 0x6001C324468D497FULL}));
  EXPECT_EQ(hash_bytes(sanity_buffer(1)), (Hash128{0xA6CD5E9392000F6AULL, 0xC44BDFF4074EECDBULL}));
  EXPECT_EQ(hash_bytes(sanity_buffer(6)), (Hash128{0x082AFE0B8162D12AULL, 0x3E7039BDDA43CFC6ULL}));
}

TEST(Hash, HexadecimalIsThirtyTwoDigitsHighFirst) {
  EXPECT_EQ(to_hex(hash_text("")), "99aa06d3014798d86001c324468d497f");
  EXPECT_EQ(to_hex(Hash128{1, 0xAB}), "000000000000000100000000000000ab");
}

TEST(Hash, PiecesOfAnySizeGiveTheHashOfTheWhole) {
  const std::vector<std::byte> bytes = sanity_buffer(5000);
  const Hash128 whole = hash_bytes(bytes);
  for (const std::size_t piece : {std::size_t{1}, std::size_t{7}, std::size_t{256}, std::size_t{4096}}) {
    Hasher hasher;
    for (std::size_t first = 0; first < bytes.size(); first += piece) {
      hasher.add(std::span(bytes).subspan(first, std::min(piece, bytes.size() - first)));
    }
    EXPECT_EQ(hasher.value(), whole) << piece;
  }
}

TEST(Hash, OneBitMakesAnother) {
  std::vector<std::byte> bytes = sanity_buffer(100);
  const Hash128 before = hash_bytes(bytes);
  bytes[50] ^= std::byte{1};
  EXPECT_NE(hash_bytes(bytes), before);
}

}  // namespace
}  // namespace sonar
