// SPDX-License-Identifier: Apache-2.0
#include "school/evidence/null_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "base/units.h"
#include "school/evidence/block_means.h"
#include "school/seabed/seabed_plane.h"
#include "school/test_water.h"

namespace sonar {
namespace {

constexpr Shape3 kShape{20, 25, 900};
constexpr double kWater_db = -65.0;
constexpr double kLeast = 5.0;

/// Pings of fading echo whose expected sv is told for each voxel.
struct Pings {
  explicit Pings(const std::function<double(int fan, int beam, int sample, int ping)>& sv, double gain_db = 0.0)
      : flat(kShape) {
    std::fill(flat.power_db.begin(), flat.power_db.end(), -100.0 + gain_db);
    const Array3<SampleFlags> flags(kShape);
    for (int p = 0; p < 7; ++p) {
      Array3<double> expected(kShape);
      for (int f = 0; f < kShape.fans; ++f) {
        for (int b = 0; b < kShape.beams; ++b) {
          for (int s = 0; s < kShape.samples; ++s) expected(f, b, s) = sv(f, b, s, p) * linear_from_db(gain_db);
        }
      }
      const Array3<std::int16_t> counts = test::counts_of(expected, 700 + static_cast<std::uint64_t>(p));
      means.push_back(block_means(counts.view(), flags.view(), block_samples(sector.range())));
    }
  }
  [[nodiscard]] std::vector<WaterLevels> levels(const Seabed* seabed = nullptr) const {
    std::vector<WaterPing> window;
    for (const Array3<std::int16_t>& mean : means) {
      window.push_back({&mean, seabed, {flat.power_db, flat.calibration.view()}});
    }
    return water_levels(window, sector, kLeast);
  }
  Sector sector = test::grid().sector(test::range_axis());
  test::FlatBackground flat;
  std::vector<Array3<std::int16_t>> means;
};

double water(int /*fan*/, int /*beam*/, int /*sample*/, int /*ping*/) { return linear_from_db(kWater_db); }

double mean_level_db(const WaterLevels& water) {
  double sum = 0.0;
  for (const std::int16_t level : water.level) sum += db_from_counts(level);
  return sum / static_cast<double>(water.level.size());
}

// The mean of 15 samples of an exponential variable has its median 0.1 dB below its mean (chi-square of 30: 29.34 / 30).
TEST(NullModel, TheWatersLevelIsItsMean) {
  const std::vector<WaterLevels> told = Pings(water).levels();
  ASSERT_EQ(told.size(), 7U);
  EXPECT_NEAR(mean_level_db(told[3]), kWater_db - 0.1, 0.05);
}

// Five deviations of a Gaussian are passed once in 3.5 million; 7 pings have 7 x 500 x 60 blocks, and fading's tail is
// heavier. What is looked for is more than what chance gives to a survey.
TEST(NullModel, HardlyAnythingInWaterIsAboveBackground) {
  std::size_t cells = 0;
  for (const WaterLevels& ping : Pings(water).levels()) cells += ping.cells.size();
  EXPECT_LE(cells, 20U);
}

// A law: all of the echo and the noise by the same factor is the same sea heard with another gain.
TEST(NullModel, GainChangesLevelsAndNoEvidence) {
  const auto school = [](int f, int b, int s, int p) {
    const bool inside = f >= 8 && f < 12 && b >= 8 && b < 14 && s >= 300 && s < 340;
    return water(f, b, s, p) * (inside ? 20.0 : 1.0);
  };
  const WaterLevels here = Pings(school).levels()[2];
  const WaterLevels louder = Pings(school, 12.0).levels()[2];
  EXPECT_NEAR(mean_level_db(louder) - mean_level_db(here), 12.0, 0.02);
  ASSERT_FALSE(here.cells.empty());
  // counts are rounded: what lies at the limit may fall on either side
  EXPECT_NEAR(static_cast<double>(louder.cells.size()), static_cast<double>(here.cells.size()),
              0.05 * static_cast<double>(here.cells.size()));
}

TEST(NullModel, WhatFillsAMinorityIsAboveBackgroundAndMovesNoLevel) {
  const auto school = [](int f, int b, int s, int p) {
    const bool inside = f >= 6 && f < 12 && b >= 8 && b < 16 && s >= 300 && s < 345;
    return water(f, b, s, p) * (inside ? 10.0 : 1.0);  // 10 dB above its water
  };
  const Pings pings(school);
  const WaterLevels told = pings.levels()[3];
  const int block = static_cast<int>(std::lround(told.place_at(9 * 25 + 12, 322)));
  const auto cell = static_cast<std::size_t>(9 * told.places + block);
  EXPECT_NEAR(db_from_counts(told.level[cell]), kWater_db, 0.4);
  std::size_t inside = 0;
  for (const EchoCell& one : told.cells) {
    const int fan = one.row / 25;
    const int beam = one.row % 25;
    EXPECT_TRUE(fan >= 5 && fan <= 12 && beam >= 7 && beam <= 16) << fan << " " << beam;
    if (fan >= 6 && fan < 12 && beam >= 8 && beam < 16) ++inside;
  }
  EXPECT_GE(inside, 6U * 8U * 2U) << "each beam of it, in two blocks at least";
}

// As of a ship at rest that looks at a near school, which keeps its place in all pings.
TEST(NullModel, WhatFillsTheMajorityIsAboveBackgroundOfTheRest) {
  const auto school = [](int f, int b, int s, int p) {
    const bool inside = f >= 6 && f < 12 && b >= 5 && b < 20 && s >= 300 && s < 360;
    return water(f, b, s, p) * (inside ? linear_from_db(20.0) : 1.0);
  };
  const WaterLevels told = Pings(school).levels()[3];
  const int block = static_cast<int>(std::lround(told.place_at(9 * 25 + 12, 330)));
  EXPECT_NEAR(db_from_counts(told.level[static_cast<std::size_t>(9 * told.places + block)]), kWater_db, 0.5);
  const auto inside = std::ranges::count_if(told.cells, [](const EchoCell& one) {
    return one.row / 25 >= 6 && one.row / 25 < 12 && one.row % 25 >= 5 && one.row % 25 < 20;
  });
  EXPECT_GE(inside, 6 * 15 * 3) << "each beam of it, in three blocks at least";
}

// A beam in five that something hides, or a ping in seven full of bubbles: the others are the water all the same.
TEST(NullModel, AMinorityThatHearsBadlyMakesNoSchoolOfTheRest) {
  for (const bool beams : {true, false}) {
    const auto hidden = [&](int f, int b, int s, int p) {
      return water(f, b, s, p) * linear_from_db((beams ? b % 5 == 2 : p == 4) ? -15.0 : 0.0);
    };
    std::size_t cells = 0;
    for (const WaterLevels& ping : Pings(hidden).levels()) cells += ping.cells.size();
    EXPECT_LE(cells, 20U) << beams;
  }
}

// Towards a loud seabed beams hear its beam-edge echo rise by 1.5 dB a metre, 8 dB from block to block, and its slope brings it nearer
// in some of them than in others by less than a block: each beam's water is as loud as it is there.
TEST(NullModel, TheBeamEdgeEchoOfASlopingSeabedIsWater) {
  Seabed seabed;
  seabed.found = true;
  seabed.offset_m = 110.0;
  seabed.slope_x = 0.01;
  seabed.slope_y = 0.013;
  const SeabedPlane plane{seabed.offset_m, seabed.slope_x, seabed.slope_y};
  const Sector sector = test::grid().sector(test::range_axis());
  const auto level_db = [&](int row, int sample) {
    const double edge_echo_m =
        plane.range(Sector::direction(sector.elevation_rad(row / 25) - 0.105, sector.azimuth_rad(row % 25)));
    return kWater_db + std::clamp(1.5 * (sector.range().range_m(sample) - edge_echo_m) + 40.0, 0.0, 40.0);
  };
  const auto sea = [&](int f, int b, int s, int /*ping*/) { return linear_from_db(level_db(f * 25 + b, s)); };
  const WaterLevels told = Pings(sea).levels(&seabed)[3];
  const int half = told.block_samples / 2;
  double worst_db = 0.0;
  int looked_at = 0;
  for (int row = 0; row < 250; ++row) {
    for (int s = 2 * half; s < 900 - 2 * half; ++s) {
      const double here = level_db(row, s);
      // where it begins and ends, the mean of a block is not that of its middle
      if (here - kWater_db < 12.0 || here - kWater_db > 30.0) continue;
      const double at = told.place_at(row, s);
      const auto place = static_cast<std::size_t>((row / 25) * told.places + static_cast<int>(at));
      const double share = at - std::floor(at);
      const double of_places =
          (1.0 - share) * db_from_counts(told.level[place]) + share * db_from_counts(told.level[place + 1]);
      worst_db = std::max(worst_db, std::abs(of_places - here));
      ++looked_at;
    }
  }
  EXPECT_GT(looked_at, 1000);
  EXPECT_LT(worst_db, 3.0);
}

// A slope stretches each fan and beam otherwise; a school lies at the same range in all of them. The second one lies at the
// record's end, which stretching moves out of where level seabeds are heard.
TEST(NullModel, ASeabedsSlopeTearsNoSchool) {
  const auto schools = [](int f, int b, int s, int p) {
    const bool inside = f >= 9 && f < 12 && b >= 11 && b < 14 && ((s >= 300 && s < 330) || (s >= 840 && s < 870));
    return water(f, b, s, p) * (inside ? 6.0 : 1.0);
  };
  const Pings pings(schools);
  Seabed seabed;
  seabed.found = true;
  seabed.offset_m = 100.0;
  seabed.slope_x = 0.1;
  seabed.slope_y = 0.15;
  const WaterLevels level = pings.levels()[3];
  const WaterLevels sloping = pings.levels(&seabed)[3];
  ASSERT_GT(sloping.stretch_of(10 * 25 + 12), 1.1);
  const auto most = [](const WaterLevels& told, int sample) {
    float evidence = 0.0F;
    for (const EchoCell& cell : told.cells) {
      if (cell.row == 10 * 25 + 12 && std::abs(cell.block - told.block_at(sample)) < 1.5) {
        evidence = std::max(evidence, cell.evidence);
      }
    }
    return evidence;
  };
  for (const int sample : {315, 855}) {
    EXPECT_GT(most(level, sample), 7.0F) << sample;
    EXPECT_NEAR(most(sloping, sample) / most(level, sample), 1.0F, 0.2F) << sample;
  }
}

// Ringing, a layer, the surface in side lobes: what all beams of a fan hear at one range is the water there.
TEST(NullModel, WhatAllBeamsHearIsWater) {
  const auto layer = [](int f, int b, int s, int p) {
    return water(f, b, s, p) * (f > 10 && s >= 400 && s < 460 ? 100.0 : 1.0);
  };
  std::size_t cells = 0;
  for (const WaterLevels& ping : Pings(layer).levels()) cells += ping.cells.size();
  EXPECT_LE(cells, 20U);
}

/// Plankton 4 dB up and down, over 200 m along range and 75 degrees across; another phase in each ping.
double patchy(int f, int b, int s, int p) {
  const double phase = 2.0 * 3.14159265 * (s / 520.0 + b / 25.0 + f / 40.0) + 1.7 * p;
  return water(f, b, s, p) * linear_from_db(4.0 * std::sin(phase));
}

TEST(NullModel, PatchesWiderThanSchoolsAreWater) {
  std::size_t cells = 0;
  for (const WaterLevels& ping : Pings(patchy).levels()) cells += ping.cells.size();
  EXPECT_LE(cells, 20U);
}

// The same school as in even water, and the water it is held against follows the patches: 4 dB of them to one.
TEST(NullModel, ASchoolIsAboveBackgroundInPatchyWater) {
  const auto school = [](int f, int b, int s, int p) {
    const bool inside = f >= 9 && f < 12 && b >= 11 && b < 14 && s >= 300 && s < 330;
    return patchy(f, b, s, p) * (inside ? 10.0 : 1.0);
  };
  const Pings pings(school);
  const std::vector<WaterLevels> told = pings.levels();
  for (std::size_t p = 0; p < told.size(); ++p) {
    const bool seen = std::ranges::any_of(told[p].cells, [&](const EchoCell& cell) {
      return cell.row == 10 * 25 + 12 && cell.evidence > 7.0F && std::abs(cell.block - told[p].block_at(315)) < 1.5;
    });
    EXPECT_TRUE(seen) << p;
  }
  double squares = 0.0;
  int number = 0;
  for (int b = 4; b < 21; ++b) {
    for (int s = 120; s < 780; s += 15) {
      const int row = 4 * 25 + b;
      const auto block = static_cast<std::size_t>(std::lround(told[3].block_at(s)));
      const auto blocks = static_cast<std::size_t>(told[3].blocks);
      const double level_db =
          db_from_counts(told[3].level[4 * blocks + block]) +  // as many places: no seabed
          db_from_counts(kPatchStep * told[3].patch[static_cast<std::size_t>(row) * blocks + block]);
      const double off_db = level_db - db_from_linear(patchy(4, b, s, 3));
      squares += off_db * off_db;
      ++number;
    }
  }
  EXPECT_LT(std::sqrt(squares / number), 1.5);
}

// Half the beams of every ping: they would be the water, were the ping looked at alone without its noise.
TEST(NullModel, FaultySamplesHaveNoSay) {
  Array3<std::int16_t> counts(kShape, static_cast<std::int16_t>(counts_from_db(kWater_db)));
  Array3<SampleFlags> flags(kShape);
  for (int s = 0; s < kShape.samples; ++s) {
    counts(3, 4, s) = static_cast<std::int16_t>(counts_from_db(-10.0));
    flags(3, 4, s) = SampleFlags::corrupted;
  }
  const Array3<std::int16_t> means = block_means(std::as_const(counts).view(), std::as_const(flags).view(), 5);
  for (const std::int16_t mean : means.view().row(3 * 25 + 4)) EXPECT_EQ(mean, kNoData);
  for (const std::int16_t mean : means.view().row(3 * 25 + 5)) EXPECT_NEAR(db_from_counts(mean), kWater_db, 0.02);
}

}  // namespace
}  // namespace sonar
