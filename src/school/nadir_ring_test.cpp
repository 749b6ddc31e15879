// SPDX-License-Identifier: Apache-2.0
#include "school/nadir_ring.h"

#include <gtest/gtest.h>

#include "base/units.h"
#include "school/test_water.h"

namespace sonar {
namespace {

constexpr Shape3 kShape{20, 25, 700};
constexpr double kNearest_m = 100.0;

std::int16_t count(double db) { return static_cast<std::int16_t>(counts_from_db(db)); }

/// Quiet water of -80 dB without speckle; from 100 to 105 m all beams hear the seabed below the ship with -68 dB, eight
/// beams of two fans 6 dB more.
struct Ping {
  Ping() : sector(test::grid().sector(test::range_axis(kShape.samples))), sv(kShape, count(-80.0)), flags(kShape) {
    seabed.found = true;
    seabed.offset_m = kNearest_m;
    echo(0, 19, 0, 24, 0.0, 5.0, -68.0);
    school(0.0, 5.0, -62.0);
  }
  /// Metres beyond the nearest range.
  int sample(double beyond_m) const { return static_cast<int>(sector.range().sample_at(kNearest_m + beyond_m)); }
  void echo(int first_fan, int last_fan, int first_beam, int last_beam, double from_m, double to_m, double db) {
    for (int fan = first_fan; fan <= last_fan; ++fan) {
      for (int beam = first_beam; beam <= last_beam; ++beam) {
        for (int s = sample(from_m); s < sample(to_m); ++s) sv(fan, beam, s) = count(db);
      }
    }
  }
  void school(double from_m, double to_m, double db) {
    echo(7, 8, 10, 17, from_m, to_m, db);
    mask = {};
    for (int fan = 7; fan <= 8; ++fan) {
      for (int beam = 10; beam <= 17; ++beam) {
        mask.runs.push_back({fan * 25 + beam, sample(from_m), sample(to_m) - sample(from_m)});
      }
    }
    for (const Run& run : mask.runs) {
      mask.confidence.resize(mask.confidence.size() + static_cast<std::size_t>(run.count), 255);
    }
  }
  [[nodiscard]] bool is_ring(const DetectParams& params = {}) const {
    return is_nadir_ring(mask, box_of(mask, 25), seabed, sector, sv.view(), flags.view(), noise, params);
  }

  Sector sector;
  Array3<std::int16_t> sv;
  Array3<SampleFlags> flags;
  Seabed seabed;
  Background noise;
  PingMask mask;
};

TEST(NadirRing, IsNoSchool) {
  Ping ping;
  EXPECT_TRUE(ping.is_ring());
  DetectParams off;
  off.ring_rise_db = 0.0;
  EXPECT_FALSE(ping.is_ring(off));
}

TEST(NadirRing, NeedsASeabedThere) {
  Ping none;
  none.seabed.found = false;
  EXPECT_FALSE(none.is_ring());
  Ping deeper;
  deeper.seabed.offset_m = 115.0;
  EXPECT_FALSE(deeper.is_ring());
  // of a slope the nearest point lies off to one side, nearer than what is below the ship
  Ping slope;
  slope.seabed.offset_m = 125.0;
  slope.seabed.slope_x = 0.75;
  EXPECT_TRUE(slope.is_ring());
}

// Noise that time-varied gain has raised from -83 to -80 dB between the water and the ring is not heard there.
TEST(NadirRing, NoiseThatRisesWithRangeIsNone) {
  Ping ping;
  ping.echo(0, 19, 0, 24, -30.0, 0.0, -83.0 - 1.6);
  ping.echo(0, 19, 0, 24, 0.0, 5.0, -79.5 - 1.6);
  ping.school(0.0, 5.0, -71.0);
  EXPECT_TRUE(ping.is_ring());
  const std::vector<double> power_db(500, -80.0);
  const Array3<std::int16_t> calibration(kShape);
  ping.noise = {power_db, calibration.view()};
  EXPECT_FALSE(ping.is_ring());
}

TEST(NadirRing, OfQuietFansThereIsNone) {
  Ping ping;
  ping.echo(0, 19, 0, 9, 0.0, 5.0, -80.0);
  ping.echo(0, 19, 18, 24, 0.0, 5.0, -80.0);
  EXPECT_FALSE(ping.is_ring());
}

TEST(NadirRing, NoiseFraysItsEdge) {
  Ping ping;
  ping.school(0.0, 10.0, -62.0);  // 7 of 10 m are the ring's
  EXPECT_TRUE(ping.is_ring());
  DetectParams strict;
  strict.ring_inside_share = 0.8;
  EXPECT_FALSE(ping.is_ring(strict));
}

TEST(NadirRing, ASchoolReachesBeyondIt) {
  Ping ping;
  ping.school(-15.0, 10.0, -62.0);
  EXPECT_FALSE(ping.is_ring());
  ping.school(0.0, 15.0, -62.0);
  EXPECT_FALSE(ping.is_ring());
}

TEST(NadirRing, ASchoolStandsOutOfIt) {
  Ping ping;
  ping.school(0.0, 5.0, -55.0);
  EXPECT_FALSE(ping.is_ring());
}

TEST(NadirRing, WhatIsFlaggedSaysNothing) {
  Ping ping;
  for (int fan = 0; fan < 20; ++fan) {
    for (int beam = 0; beam < 20; ++beam) {
      for (int s = 0; s < kShape.samples; ++s) ping.flags(fan, beam, s) |= SampleFlags::surface;
    }
  }
  EXPECT_FALSE(ping.is_ring());
  EXPECT_FALSE(is_nadir_ring({}, {}, ping.seabed, ping.sector, ping.sv.view(), ping.flags.view(), {}, {}));
}

}  // namespace
}  // namespace sonar
