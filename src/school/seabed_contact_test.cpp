// SPDX-License-Identifier: Apache-2.0
#include "school/seabed_contact.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>

#include "base/units.h"

namespace sonar {
namespace {

constexpr int kSamples = 60;

/// One fan of four beams; the seabed's margin begins at sample 40 in all of them.
struct Water {
  Water() : sv(Shape3{1, 4, kSamples}), flags(sv.shape()) {
    for (int row = 0; row < 4; ++row) {
      for (std::size_t s = 40; s < kSamples; ++s) flags.view().row(row)[s] = SampleFlags::seabed;
    }
  }

  /// A run of one beam up to the margin: as loud as said at its first sample, changing by so much a sample.
  void add(int row, int first, double first_db, double step_db) {
    mask.runs.push_back({row, first, 40 - first});
    for (int s = first; s < 40; ++s) {
      sv.view().row(row)[static_cast<std::size_t>(s)] =
          static_cast<std::int16_t>(counts_from_db(first_db + step_db * (s - first)));
      mask.confidence.push_back(static_cast<std::uint8_t>(row + 1));
    }
  }

  Array3<std::int16_t> sv;
  Array3<SampleFlags> flags;
  PingMask mask;
  DetectParams params;
};

TEST(SeabedContact, TheFlankOfTheSeabedRises) {
  Water water;
  water.add(0, 10, -60.0, 0.5);
  water.add(1, 10, -58.0, 0.5);
  EXPECT_TRUE(rises_to_seabed(water.mask, water.sv.view(), water.flags.view(), water.params));
}

TEST(SeabedContact, ASchoolAtTheSeabedDoesNot) {
  Water water;
  water.add(0, 10, -45.0, -0.3);
  water.add(1, 10, -45.0, -0.2);
  EXPECT_FALSE(rises_to_seabed(water.mask, water.sv.view(), water.flags.view(), water.params));
  EXPECT_EQ(free_of_seabed(water.mask, water.sv.view(), water.flags.view(), water.params), water.mask);
}

TEST(SeabedContact, TheSchoolIsLeftWhereAFlankHangsBelowIt) {
  Water water;
  water.add(0, 20, -60.0, 0.9);
  water.add(1, 10, -45.0, -0.3);
  water.add(2, 10, -45.0, -0.3);
  const PingMask free = free_of_seabed(water.mask, water.sv.view(), water.flags.view(), water.params);
  ASSERT_EQ(free.runs.size(), 2U);
  EXPECT_EQ(free.runs.front().row, 1);
  // The confidence stays with its own voxels.
  ASSERT_EQ(free.confidence.size(), 60U);
  EXPECT_EQ(free.confidence.front(), 2);
  EXPECT_EQ(free.confidence.back(), 3);
}

TEST(SeabedContact, AMaskThatIsMostlyFlankStaysOneAndIsRefused) {
  Water water;
  water.add(0, 10, -60.0, 0.9);
  water.add(1, 10, -60.0, 0.9);
  water.add(2, 30, -45.0, -0.3);
  const PingMask free = free_of_seabed(water.mask, water.sv.view(), water.flags.view(), water.params);
  EXPECT_EQ(free, water.mask);
  EXPECT_TRUE(rises_to_seabed(free, water.sv.view(), water.flags.view(), water.params));
}

}  // namespace
}  // namespace sonar
