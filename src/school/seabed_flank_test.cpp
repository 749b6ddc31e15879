// SPDX-License-Identifier: Apache-2.0
#include "school/seabed_flank.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/units.h"
#include "school/test_water.h"

namespace sonar {
namespace {

constexpr Shape3 kShape{20, 25, 900};
constexpr int kFlank = 60;  ///< samples before the ground in which it is heard

/// A level seabed 100 m below: each beam hears it from -55 dB on, a little louder with each sample.
struct Water {
  Water() : sector(test::grid().sector(test::range_axis())), sv(kShape, counts(-85.0)), flags(kShape) {
    ground.plane = {100.0, 0.0, 0.0};
    ground.roughness_m = 0.5;
    for (int row = 0; row < 500; ++row) {
      const double range_m = ground.plane.range(beam_axis(sector, row));
      const int meets = range_m < 330.0 ? static_cast<int>(sector.range().sample_at(range_m)) : -1;
      ground.loudest.push_back(meets);
      ground.first.push_back(meets < 0 ? kShape.samples : meets - 15);
      seabed.first_sample.push_back(meets < 0 ? kShape.samples : meets - kFlank);
      for (int s = std::max(0, meets - kFlank); meets >= 0 && s < kShape.samples; ++s) {
        put(row, s, -55.0 + 0.5 * std::min(s - meets + kFlank, kFlank));
      }
    }
  }

  static std::int16_t counts(double db) { return static_cast<std::int16_t>(counts_from_db(db)); }
  void put(int row, int sample, double db) { sv.view().row(row)[static_cast<std::size_t>(sample)] = counts(db); }

  /// Echo in a block of fans and beams, so far before each of these beams meets the ground.
  void add(int fans, int beams, int before, int length, double db) {
    for (int f = 4; f < 4 + fans; ++f) {
      for (int b = 8; b < 8 + beams; ++b) {
        const int row = f * 25 + b;
        for (int s = 0; s < length; ++s) put(row, ground.loudest[static_cast<std::size_t>(row)] - before + s, db);
      }
    }
  }

  const Seabed& opened() {
    const Background none;
    open_flank({std::as_const(sv).view(), std::as_const(flags).view(), none, sector, params}, ground, seabed);
    return seabed;
  }

  Sector sector;
  Array3<std::int16_t> sv;
  Array3<SampleFlags> flags;
  SeabedParams params;
  Ground ground;
  Seabed seabed;
};

TEST(SeabedFlank, StaysSeabedWithoutASchool) { EXPECT_TRUE(Water().opened().open.empty()); }

TEST(SeabedFlank, IsOpenWhereASchoolStandsOut) {
  Water water;
  water.add(3, 5, 50, 20, -25.0);
  const Seabed& seabed = water.opened();
  ASSERT_EQ(seabed.open.size(), 500U);
  for (int row = 0; row < 500; ++row) {
    const auto r = static_cast<std::size_t>(row);
    const bool inside = row / 25 >= 4 && row / 25 < 7 && row % 25 >= 8 && row % 25 < 13;
    EXPECT_EQ(seabed.open[r].empty(), !inside) << row;
    if (!inside) continue;
    EXPECT_EQ(seabed.open[r].first, water.ground.loudest[r] - 50);
    EXPECT_EQ(seabed.open[r].end, water.ground.loudest[r] - 30);
  }
  flag_seabed(seabed, water.flags.view());  // not found yet: nothing is flagged
  water.seabed.found = true;
  flag_seabed(water.seabed, water.flags.view());
  const int row = 5 * 25 + 10;
  const auto flagged = [&](int before) {
    const int at = water.ground.loudest[static_cast<std::size_t>(row)] - before;
    return any(water.flags.view().row(row)[static_cast<std::size_t>(at)] & SampleFlags::seabed);
  };
  EXPECT_TRUE(flagged(55));
  EXPECT_FALSE(flagged(40));
  EXPECT_TRUE(flagged(25));
}

TEST(SeabedFlank, IsNoSchoolWhereMostBeamsHearAsMuch) {
  Water water;
  water.add(3, 17, 50, 20, -30.0);
  EXPECT_TRUE(water.opened().open.empty());
}

TEST(SeabedFlank, IsNoSchoolWhereItHardlyStandsOut) {
  Water water;
  water.add(3, 5, 55, 20, -45.0);  // the flank reaches from -52 to -43 dB there
  EXPECT_TRUE(water.opened().open.empty());
}

// Half a dozen metres nearer along beams that look 20 degrees down is two metres higher.
TEST(SeabedFlank, IsNoSchoolWhereTheGroundIsALittleHigher) {
  const auto shifted = [](double lift_m) {
    Water water;
    water.params.flank_lift_m = lift_m;
    constexpr int kNearer = 24;
    for (int f = 9; f < 12; ++f) {
      for (int b = 18; b < 25; ++b) {
        const auto row = water.sv.view().row(f, b);
        std::copy(row.begin() + kNearer, row.end(), row.begin());
      }
    }
    return water.opened().open.empty();
  };
  EXPECT_TRUE(shifted(SeabedParams{}.flank_lift_m));
  EXPECT_FALSE(shifted(0.0));
}

TEST(SeabedFlank, IsNoSchoolInOneBeam) {
  Water water;
  water.add(1, 1, 50, 20, -30.0);
  EXPECT_TRUE(water.opened().open.empty());
}

TEST(SeabedFlank, OverHillsWhatIsAsLowMayBeOne) {
  Water water;
  water.add(3, 5, 50, 20, -30.0);  // 9 to 12 m above the plane
  water.ground.roughness_m = 6.0;
  EXPECT_TRUE(water.opened().open.empty());
}

TEST(SeabedFlank, OverHillsTheSeabedIsToBeHeardBehindASchool) {
  Water hill;
  hill.add(3, 5, 50, 50, -20.0);
  hill.ground.roughness_m = 2.0;
  EXPECT_TRUE(hill.opened().open.empty()) << "it is loud up to the ground";
  Water school;
  school.add(3, 5, 50, 20, -20.0);
  school.ground.roughness_m = 2.0;
  EXPECT_FALSE(school.opened().open.empty());
}

}  // namespace
}  // namespace sonar
