// SPDX-License-Identifier: Apache-2.0
#include "school/side_lobes.h"

#include <gtest/gtest.h>

#include "base/units.h"
#include "school/test_water.h"

namespace sonar {
namespace {

constexpr Shape3 kShape{20, 25, 700};

std::int16_t count(double db) { return static_cast<std::int16_t>(counts_from_db(db)); }

/// A ping without speckle: fans 9 and 10 hear -58 dB from all beams at samples 400 to 500, and 2 dB more in ten of them.
struct Ping {
  Ping() : sector(test::grid().sector(test::range_axis(kShape.samples))), sv(kShape, count(-95.0)), flags(kShape) {
    for (int fan = 9; fan <= 10; ++fan) echo(fan, 0, 24, 400, 500, -58.0);
    for (int fan = 9; fan <= 10; ++fan) echo(fan, 8, 17, 420, 470, -56.0);
    for (int fan = 9; fan <= 10; ++fan) {
      for (int beam = 8; beam <= 17; ++beam) mask.runs.push_back({fan * 25 + beam, 420, 50});
    }
    mask.confidence.assign(50 * mask.runs.size(), 255);
  }
  void echo(int fan, int first_beam, int last_beam, int first, int end, double db) {
    for (int beam = first_beam; beam <= last_beam; ++beam) {
      for (int s = first; s < end; ++s) sv(fan, beam, s) = count(db);
    }
  }
  void flag(int fan, int first, int end, SampleFlags what) {
    for (int beam = 0; beam < 25; ++beam) {
      for (int s = first; s < end; ++s) flags(fan, beam, s) |= what;
    }
  }
  void seabed(double db) {
    echo(4, 0, 24, 380, 520, db);
    flag(4, 380, 520, SampleFlags::seabed);
  }
  [[nodiscard]] bool is_lobe(const DetectParams& params = {}) const {
    return is_side_lobe(mask, box_of(mask, 25), sector, sv.view(), sv.view(), flags.view(), params);
  }

  Sector sector;
  Array3<std::int16_t> sv;
  Array3<SampleFlags> flags;
  PingMask mask;
};

TEST(SideLobes, OfAStrongSeabedAreNoSchool) {
  Ping ping;
  EXPECT_FALSE(ping.is_lobe());
  ping.seabed(-25.0);
  EXPECT_TRUE(ping.is_lobe());
  DetectParams off;
  off.side_lobe_rise_db = 0.0;
  EXPECT_FALSE(ping.is_lobe(off));
}

TEST(SideLobes, AreMuchWeakerThanTheSeabed) {
  Ping ping;
  ping.seabed(-50.0);
  EXPECT_FALSE(ping.is_lobe());
}

TEST(SideLobes, WhatStandsOutOfItsFansIsASchool) {
  Ping ping;
  ping.seabed(-25.0);
  for (int fan = 9; fan <= 10; ++fan) ping.echo(fan, 8, 17, 420, 470, -52.0);
  EXPECT_FALSE(ping.is_lobe());
}

// A school in quiet water over the same seabed, and one so wide that it fills half of its fans.
TEST(SideLobes, AWideSchoolInQuietWaterIsASchool) {
  Ping ping;
  ping.seabed(-25.0);
  for (int fan = 9; fan <= 10; ++fan) {
    ping.echo(fan, 0, 24, 400, 500, -85.0);
    ping.echo(fan, 8, 17, 420, 470, -56.0);
    ping.echo(fan, 5, 7, 420, 470, -58.0);
    ping.echo(fan, 18, 20, 420, 470, -58.0);
  }
  EXPECT_FALSE(ping.is_lobe());
}

TEST(SideLobes, WhereMostBeamsAreShutNobodyKnows) {
  Ping ping;
  ping.seabed(-25.0);
  for (int fan = 9; fan <= 10; ++fan) {
    for (int beam = 0; beam < 13; ++beam) {
      for (int s = 400; s < 500; ++s) ping.flags(fan, beam, s) |= SampleFlags::surface;
    }
  }
  EXPECT_FALSE(ping.is_lobe());
}

TEST(SideLobes, ASchoolMayFillANarrowSector) {
  Ping ping;
  ping.seabed(-25.0);
  DetectParams params;
  params.floor_beams = 26;
  EXPECT_FALSE(ping.is_lobe(params));
}

// The seabed lies deeper than the sector reaches at that range, and is seen further off.
TEST(SideLobes, OfASeabedBelowTheSectorLieInTheLowestFan) {
  Ping ping;
  ping.mask.runs.clear();
  for (int fan = 0; fan <= 1; ++fan) {
    ping.echo(fan, 0, 24, 400, 500, -58.0);
    for (int beam = 8; beam <= 17; ++beam) ping.mask.runs.push_back({fan * 25 + beam, 420, 50});
  }
  EXPECT_FALSE(ping.is_lobe());
  ping.flag(0, 600, 700, SampleFlags::seabed);
  EXPECT_TRUE(ping.is_lobe());
  for (int fan = 0; fan <= 1; ++fan) ping.echo(fan, 8, 17, 420, 470, -50.0);
  EXPECT_FALSE(ping.is_lobe());
}

TEST(SideLobes, OfTheSurfaceLieInTheTopmostFan) {
  Ping low;
  for (int fan = 18; fan <= 19; ++fan) low.flag(fan, 550, 700, SampleFlags::surface);
  EXPECT_FALSE(low.is_lobe());
  Ping high = low;
  high.mask.runs.clear();
  for (int fan = 18; fan <= 19; ++fan) {
    high.echo(fan, 0, 24, 400, 500, -58.0);
    for (int beam = 8; beam <= 17; ++beam) high.mask.runs.push_back({fan * 25 + beam, 420, 50});
  }
  EXPECT_TRUE(high.is_lobe());
  // A sonar that looks nowhere near the surface has none.
  high.flags = Array3<SampleFlags>(kShape);
  EXPECT_FALSE(high.is_lobe());
}

// Fans below those that the surface shuts hear it in their side lobes: all beams alike, and far below what the shut fans
// hear. A school there stands out of its fans, and far below the surface there is none of it.
TEST(SideLobes, OfTheSurfaceLieInFansBelowTheShutOnes) {
  Ping ping;
  ping.echo(13, 0, 24, 380, 520, -25.0);
  EXPECT_FALSE(ping.is_lobe());
  ping.flag(13, 380, 520, SampleFlags::surface);
  EXPECT_TRUE(ping.is_lobe());
  DetectParams near;
  near.side_lobe_fans = 2;
  EXPECT_FALSE(ping.is_lobe(near));
  Ping school = ping;
  for (int fan = 9; fan <= 10; ++fan) school.echo(fan, 8, 17, 420, 470, -52.0);
  EXPECT_FALSE(school.is_lobe());
  Ping calm = ping;
  calm.echo(13, 0, 24, 380, 520, -50.0);
  EXPECT_FALSE(calm.is_lobe());
}

}  // namespace
}  // namespace sonar
