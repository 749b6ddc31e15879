// SPDX-License-Identifier: Apache-2.0
#include "school/detect/echo_pieces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/units.h"
#include "school/test_water.h"

namespace sonar {
namespace {

constexpr Shape3 kShape{3, 4, 200};
constexpr int kBlock = 20;  // samples
constexpr double kReference_db = -50.0;
constexpr double kThreshold_db = -60.0;
constexpr double kQuiet_db = -80.0;
constexpr double kLoud_db = -55.0;
constexpr IndexBox kMask{1, 1, 1, 2, 80, 120};

std::int16_t count(double sv) { return static_cast<std::int16_t>(std::lround(counts_from_db(db_from_linear(sv)))); }

/// A ping whose water is equally loud everywhere; its samples return what each test says.
struct EvenWater {
  explicit EvenWater(double water_db)
      : sector(test::grid().sector(test::range_axis(kShape.samples))),
        counts(kShape, count(linear_from_db(water_db))),
        flags(kShape) {
    water.block_samples = kBlock;
    water.blocks = water.places = kShape.samples / kBlock;
    const auto places = static_cast<std::size_t>(kShape.fans * water.places);
    water.level.assign(places, count(linear_from_db(water_db)));
    water.reach.assign(places, 0);
  }

  /// Of another s_v in each piece and in each sample of it.
  void scatter() {
    sv = Array3<double>(kShape);
    for (std::size_t i = 0; i < kShape.size(); ++i) {
      sv.all()[i] = 1e-6 * static_cast<double>(1 + (i / 3) % 7);
      counts.all()[i] = count(sv.all()[i]);
    }
  }

  [[nodiscard]] EchoPieces pieces(const IndexBox& mask = kMask) const {
    const Background no_noise;
    const Seabed no_seabed;
    const PingEcho echo{counts.view(), counts.view(), flags.view(), sector, no_noise, no_seabed, water};
    const Thresholder thresholder(counts.view(), flags.view(), no_noise, &water);
    return echo_pieces(echo, thresholder, mask, kReference_db, kThreshold_db);
  }

  Sector sector;
  Array3<double> sv;  ///< m^-1, before it was counted
  Array3<std::int16_t> counts;
  Array3<SampleFlags> flags;
  WaterLevels water;
};

// A count is 0.3 % wide, a unit a thousandth of the reference.
TEST(EchoPieces, InQuietWaterEachTellsItsMeanAboveTheWater) {
  EvenWater ping(kQuiet_db);
  ping.scatter();
  const EchoPieces told = ping.pieces();
  ASSERT_EQ(told.box, (IndexBox{0, 2, 0, 3, 40, 163}));  // 40 samples round the mask, in whole pieces
  EXPECT_NEAR(told.unit_sv, 1e-8, 1e-14);
  ASSERT_EQ(told.own.shape(), (Shape3{3, 4, 31}));
  for (int fan = 0; fan < 3; ++fan) {
    for (int beam = 0; beam < 4; ++beam) {
      for (int s = 40; s < 164; s += 4) {
        double mean = 0.0;
        for (int i = s; i < s + 4; ++i) mean += ping.sv(fan, beam, i) / 4.0;
        const double expected = (mean - 1e-8) / 1e-8;
        EXPECT_NEAR(told.own(fan, beam, told.piece(s)), expected, 0.6 + 0.0015 * expected) << s;
        EXPECT_EQ(told.water(fan, beam, told.piece(s)), 1);
      }
    }
  }
}

TEST(EchoPieces, InLoudWaterWithoutExcessNothingIsHeard) {
  for (const double water_db : {kThreshold_db, kLoud_db}) {
    EvenWater ping(water_db);
    ping.scatter();  // single samples exceed it, as fading echo does
    const EchoPieces told = ping.pieces();
    ASSERT_FALSE(told.empty());
    for (const std::int16_t own : told.own.all()) ASSERT_EQ(own, EchoPieces::kUnheard);
    const double water = linear_from_db(water_db) / told.unit_sv;
    for (const std::int16_t of_water : told.water.all()) ASSERT_NEAR(of_water, water, 0.6 + 0.0015 * water);
  }
}

// Half a dB below the threshold the same water is quiet.
TEST(EchoPieces, WaterIsLoudFromTheThresholdOn) {
  const EchoPieces told = EvenWater(kThreshold_db - 0.5).pieces();
  ASSERT_FALSE(told.empty());
  for (const std::int16_t own : told.own.all()) ASSERT_EQ(own, 0);
}

TEST(EchoPieces, ASchoolThatStandsOutOfLoudWaterIsTold) {
  constexpr int kRow = 1 * 4 + 2;
  constexpr int kSchoolBlock = 5;
  EvenWater ping(kLoud_db);
  for (int s = kSchoolBlock * kBlock; s < (kSchoolBlock + 1) * kBlock; ++s) ping.counts(1, 2, s) = count(1e-5);
  ping.water.cells = {{kRow, kSchoolBlock, 9.0F}};
  const EchoPieces told = ping.pieces();
  ASSERT_FALSE(told.empty());
  const double expected = (1e-5 - linear_from_db(kLoud_db)) / told.unit_sv;
  int heard = 0;
  for (int fan = 0; fan < 3; ++fan) {
    for (int beam = 0; beam < 4; ++beam) {
      for (int s = told.box.first_sample; s <= told.box.last_sample; s += EchoPieces::kSamples) {
        const std::int16_t own = told.own(fan, beam, told.piece(s));
        if (fan == 1 && beam == 2 && s / kBlock == kSchoolBlock) {
          EXPECT_NEAR(own, expected, 3.0) << s;
          ++heard;
        } else {
          EXPECT_EQ(own, EchoPieces::kUnheard) << fan << ' ' << beam << ' ' << s;
        }
      }
    }
  }
  EXPECT_EQ(heard, kBlock / EchoPieces::kSamples);
}

TEST(EchoPieces, WhereASchoolCannotBeNothingIsSaidOfOne) {
  for (const double water_db : {kQuiet_db, kLoud_db}) {
    for (const SampleFlags flag : {SampleFlags::near_field, SampleFlags::surface, SampleFlags::seabed}) {
      EvenWater ping(water_db);
      ping.flags(1, 2, 102) = flag;  // one sample of the piece 100..103
      const EchoPieces told = ping.pieces();
      ASSERT_FALSE(told.empty());
      for (int s = told.box.first_sample; s <= told.box.last_sample; s += EchoPieces::kSamples) {
        EXPECT_EQ(told.own(1, 2, told.piece(s)) == kNoData, s == 100) << water_db << ' ' << s;
      }
      EXPECT_EQ(told.water(1, 2, told.piece(100)), told.water(1, 2, told.piece(104)));
    }
  }
}

TEST(EchoPieces, FaultySamplesHaveNoSayAndHalfOfAPieceMustBeSound) {
  EvenWater ping(kQuiet_db);
  for (int s = 100; s < 108; ++s) ping.counts(1, 2, s) = count(2e-6);
  for (const int s : {100, 102, 104, 105, 107}) {
    ping.counts(1, 2, s) = count(0.1);
    ping.flags(1, 2, s) = SampleFlags::corrupted;
  }
  const EchoPieces told = ping.pieces();
  EXPECT_NEAR(told.own(1, 2, told.piece(100)), 199.0, 1.0);
  EXPECT_EQ(told.own(1, 2, told.piece(104)), EchoPieces::kUnheard);
}

TEST(EchoPieces, AreTheSameWhereverTheMaskBegins) {
  EvenWater ping(kQuiet_db);
  ping.scatter();
  const EchoPieces whole = ping.pieces({0, 2, 0, 3, 0, kShape.samples - 1});
  ASSERT_EQ(whole.box, IndexBox::whole(kShape));
  for (int first = 80; first < 84; ++first) {
    const EchoPieces some = ping.pieces({1, 1, 1, 2, first, 120});
    EXPECT_LE(some.box.first_sample, first - 40);
    EXPECT_GE(some.box.last_sample, 120 + 40);
    for (int fan = 0; fan < 3; ++fan) {
      for (int beam = 0; beam < 4; ++beam) {
        for (int s = some.box.first_sample; s <= some.box.last_sample; ++s) {
          ASSERT_EQ(some.own(fan, beam, some.piece(s)), whole.own(fan, beam, whole.piece(s))) << first << ' ' << s;
          ASSERT_EQ(some.water(fan, beam, some.piece(s)), whole.water(fan, beam, whole.piece(s)));
        }
      }
    }
  }
}

}  // namespace
}  // namespace sonar
