// SPDX-License-Identifier: Apache-2.0
#include "school/open_floor.h"

#include <gtest/gtest.h>

#include <cstddef>

#include "base/units.h"
#include "school/test_water.h"

namespace sonar {
namespace {

constexpr int kSamples = 900;

/// Echo of -31 dB in the two lowest fans from a sample on, in some beams, and what is made of some of them.
struct Floor {
  Floor() : sector(test::grid().sector(test::range_axis())), sv(Shape3{20, 25, kSamples}), flags(sv.shape()) {
    for (std::int16_t& count : sv.all()) count = static_cast<std::int16_t>(counts_from_db(-90.0));
  }
  void add_echo(int first_beam, int end_beam, int first, int end, int lowest = 0) {
    for (int fan = lowest; fan < lowest + 2; ++fan) {
      for (int beam = first_beam; beam < end_beam; ++beam) {
        for (int s = first; s < end; ++s) sv(fan, beam, s) = static_cast<std::int16_t>(counts_from_db(-31.0));
      }
    }
  }
  void spoil(int beam, SampleFlags reason) {
    for (int fan = 0; fan < 2; ++fan) {
      for (SampleFlags& flag : flags.view().row(fan * 25 + beam)) flag |= reason;
    }
  }
  [[nodiscard]] bool judged(int first_beam, int end_beam, int first, int end, int lowest = 0) const {
    PingMask mask;
    for (int fan = lowest; fan < lowest + 2; ++fan) {
      for (int beam = first_beam; beam < end_beam; ++beam) mask.runs.push_back({fan * 25 + beam, first, end - first});
    }
    mask.confidence.assign(static_cast<std::size_t>(2 * (end_beam - first_beam) * (end - first)), 255);
    Detection detection = describe_mask(std::move(mask), flags.view(), sector);
    detection.reference_db = -31.0;
    detection.threshold_db = -41.0;
    return is_open_floor(detection, sector, sv.view(), flags.view(), {});
  }

  Sector sector;
  Array3<std::int16_t> sv;
  Array3<SampleFlags> flags;
};

TEST(OpenFloor, IsWhatTheRecordsEndCutsOff) {
  Floor floor;
  floor.add_echo(0, 25, 860, kSamples);
  EXPECT_TRUE(floor.judged(0, 25, 860, kSamples));
}

// A lost packet parts the seabed: each piece is seabed as the whole was.
TEST(OpenFloor, FaultyBeamsMakeNoSchoolsOfItsPieces) {
  Floor floor;
  floor.add_echo(0, 25, 860, kSamples);
  floor.spoil(6, SampleFlags::lost);
  floor.spoil(15, SampleFlags::hot_beam);
  EXPECT_TRUE(floor.judged(0, 6, 860, kSamples));
  EXPECT_TRUE(floor.judged(7, 15, 860, kSamples));
  EXPECT_TRUE(floor.judged(16, 25, 860, kSamples));
}

TEST(OpenFloor, ASchoolAtTheRecordsEndIsNone) {
  Floor floor;
  floor.add_echo(8, 14, 860, kSamples);
  EXPECT_FALSE(floor.judged(8, 14, 860, kSamples));
}

// Near the sonar the sector is narrow, and a school may fill most of it where the record ends.
TEST(OpenFloor, NorIsAWideSchoolWithWaterUnderIt) {
  Floor floor;
  floor.add_echo(3, 22, 860, kSamples, 6);
  EXPECT_FALSE(floor.judged(3, 22, 860, kSamples, 6));
}

// Its threshold is 10 dB below its own level; the noise of all beams may reach that.
TEST(OpenFloor, NorIsASchoolThatStandsBarelyOutOfTheNoise) {
  Floor floor;
  for (std::int16_t& count : floor.sv.all()) count = static_cast<std::int16_t>(counts_from_db(-40.0));
  floor.add_echo(8, 14, 860, kSamples);
  EXPECT_FALSE(floor.judged(8, 14, 860, kSamples));
}

TEST(OpenFloor, NorIsAnEchoThatEndsBefore) {
  Floor floor;
  floor.add_echo(0, 20, 700, 760);
  EXPECT_FALSE(floor.judged(0, 20, 700, 760));
}

}  // namespace
}  // namespace sonar
