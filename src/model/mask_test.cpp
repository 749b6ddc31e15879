// SPDX-License-Identifier: Apache-2.0
#include "model/mask.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace sonar {
namespace {

using Voxels = std::map<std::pair<int, int>, std::uint8_t>;

PingMask mask_of(const Voxels& voxels) {
  PingMask mask;
  for (const auto& [place, confidence] : voxels) {
    const auto [row, sample] = place;
    if (!mask.runs.empty() && mask.runs.back().row == row && mask.runs.back().end() == sample) {
      ++mask.runs.back().count;
    } else {
      mask.runs.push_back({row, sample, 1});
    }
    mask.confidence.push_back(confidence);
  }
  return mask;
}

Voxels random_voxels(std::mt19937& bits) {
  Voxels voxels;
  const std::size_t count = bits() % 60;
  for (std::size_t i = 0; i < count; ++i) {
    const int row = static_cast<int>(bits() % 5);
    const int sample = static_cast<int>(bits() % 30);
    voxels[{row, sample}] = static_cast<std::uint8_t>(1 + bits() % 255);
  }
  return voxels;
}

// Set algebra against std::map, on a thousand pairs of ragged masks; std::mt19937's bits are fixed by the standard.
TEST(Mask, AlgebraAgreesWithSets) {
  std::mt19937 bits(7);
  for (int round = 0; round < 1000; ++round) {
    const Voxels a = random_voxels(bits);
    const Voxels b = random_voxels(bits);
    Voxels both = a;
    Voxels only_a;
    std::size_t shared = 0;
    for (const auto& [place, confidence] : b) both[place] = std::max(both[place], confidence);
    for (const auto& [place, confidence] : a) {
      if (b.contains(place)) {
        ++shared;
      } else {
        only_a[place] = confidence;
      }
    }
    const PingMask ma = mask_of(a);
    const PingMask mb = mask_of(b);
    EXPECT_EQ(unite(ma, mb), mask_of(both));
    EXPECT_EQ(subtract(ma, mb), mask_of(only_a));
    EXPECT_EQ(overlap(ma, mb), shared);
    EXPECT_EQ(overlap(mb, ma), shared);
    const std::size_t total = a.size() + b.size();
    EXPECT_EQ(dice(ma, mb), total == 0 ? 0.0 : 2.0 * static_cast<double>(shared) / static_cast<double>(total));
  }
}

TEST(Mask, Laws) {
  std::mt19937 bits(11);
  for (int round = 0; round < 200; ++round) {
    const PingMask a = mask_of(random_voxels(bits));
    const PingMask b = mask_of(random_voxels(bits));
    const PingMask c = mask_of(random_voxels(bits));
    EXPECT_EQ(unite(a, b), unite(b, a));
    EXPECT_EQ(unite(unite(a, b), c), unite(a, unite(b, c)));
    EXPECT_EQ(unite(a, a), a);
    EXPECT_EQ(unite(a, {}), a);
    EXPECT_EQ(subtract(a, {}), a);
    EXPECT_TRUE(subtract(a, a).empty());
    EXPECT_EQ(overlap(subtract(a, b), b), 0U);
    EXPECT_EQ(subtract(a, unite(b, c)), subtract(subtract(a, b), c));
    EXPECT_EQ(dice(a, a), a.empty() ? 0.0 : 1.0);
  }
}

// q = max(1, round(255 f)).
TEST(Mask, QuantisedConfidence) {
  EXPECT_EQ(quantised_confidence(0.0), 1);
  EXPECT_EQ(quantised_confidence(0.001), 1);
  EXPECT_EQ(quantised_confidence(0.5), 128);
  EXPECT_EQ(quantised_confidence(0.75), 191);
  EXPECT_EQ(quantised_confidence(1.0), 255);
  EXPECT_EQ(quantised_confidence(2.0), 255);
}

}  // namespace
}  // namespace sonar
