// SPDX-License-Identifier: Apache-2.0
#include "view/echograms/echogram_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "base/units.h"
#include "geo/refraction.h"
#include "view/maps/map_example.h"

namespace sonar {
namespace {

constexpr EchogramOf kBeam{1, 2, EchogramHeight::range};

/// 3 fans, 4 beams, 60 samples of 2 m, the first behind the transducer; every sample its own level.
struct Sea {
  Sector sector = map_example::grid().grid.sector(map_example::grid().range);
  Array3<std::int16_t> sv{{3, 4, 60}};
  Array3<SampleFlags> flags{{3, 4, 60}, SampleFlags::none};
  Sea() {
    for (int fan = 0; fan < 3; ++fan) {
      for (int beam = 0; beam < 4; ++beam) {
        for (int s = 0; s < 60; ++s) {
          sv(fan, beam, s) = static_cast<std::int16_t>(-6000 + 500 * fan + 130 * beam + 7 * s);
        }
      }
    }
  }
  [[nodiscard]] std::vector<EchogramCell> column(const EchogramOf& of, const EchogramRange& range,
                                                 const Placement& placement = {},
                                                 SampleFlags hidden = SampleFlags::none) const {
    return echogram_column(sector, sv.view(), flags.view(), hidden, echogram_rows(sector, placement, of), range);
  }
};

TEST(EchogramRows, ACellOfABeamIsOneSampleAsItIs) {
  Sea sea;
  sea.flags(1, 2, 30) = SampleFlags::seabed;
  const EchogramRange range = echogram_range(sea.sector, {}, kBeam);
  EXPECT_DOUBLE_EQ(range.bin_m, 2.0);
  const auto all = sea.column(kBeam, range);
  const auto masked = sea.column(kBeam, range, {}, SampleFlags::seabed);
  std::set<int> bins;
  for (int s = 0; s < 60; ++s) {
    const double range_m = -1.0 + 2.0 * s;
    const int bin = bin_of(range, range_m);
    if (range_m < 0.0) {
      EXPECT_EQ(bin, -1);
      continue;
    }
    ASSERT_TRUE(bin >= 0 && bins.insert(bin).second) << s;
    EXPECT_DOUBLE_EQ(range.first_m + (bin + 0.5) * range.bin_m, range_m) << "in the middle of its bin";
    if (range_m < 2.0) continue;  // nearer than a sample's length there is no volume
    const EchogramCell& cell = all[static_cast<std::size_t>(bin)];
    EXPECT_EQ(cell.mean_count(), sea.sv(1, 2, s)) << s;
    EXPECT_EQ(cell.low, sea.sv(1, 2, s));
    EXPECT_EQ(cell.high, sea.sv(1, 2, s));
    EXPECT_EQ(masked[static_cast<std::size_t>(bin)].empty(), s == 30);
  }
  EXPECT_EQ(static_cast<int>(bins.size()), range.bins);
}

// Azimuths of 260 .. 280 in steps of 5 degrees, elevations in steps of 10 about -25, -15 and -5: worked from the angles.
TEST(EchogramRows, AFanIsTheLinearMeanOfItsBeamsByVolume) {
  const Sea sea;
  const EchogramOf fan{2, std::nullopt, EchogramHeight::range};
  const EchogramRange range = echogram_range(sea.sector, {}, fan);
  const auto column = sea.column(fan, range);
  for (const int s : {5, 20, 59}) {
    double sv = 0.0;
    double volume = 0.0;
    for (int beam = 0; beam < 4; ++beam) {
      const double solid = rad_from_deg(5.0) * std::abs(std::sin(rad_from_deg(0.0)) - std::sin(rad_from_deg(-10.0)));
      const double far = std::pow(2.0 * s, 3.0);
      const double near = std::pow(2.0 * s - 2.0, 3.0);
      const double v = solid * (far - near) / 3.0;
      sv += std::pow(10.0, db_from_counts(sea.sv(2, beam, s)) / 10.0) * v;
      volume += v;
    }
    const EchogramCell& cell = column[static_cast<std::size_t>(bin_of(range, -1.0 + 2.0 * s))];
    EXPECT_NEAR(cell.volume_m3, volume, 1e-5 * volume);
    EXPECT_NEAR(db_from_counts(cell.mean_count()), 10.0 * std::log10(sv / volume), 0.007);
  }
}

TEST(EchogramRows, AllBeamsAreThoseOfATimeline) {
  const Sea sea;
  const EchogramRange range{0.0, 2.0, 60};
  const Volume volume{sea.sv, sea.flags};
  EXPECT_EQ(sea.column({}, range), echogram_column(sea.sector, volume, SampleFlags::none, range));
}

// Where geo says that a voxel lies once the ship has rolled, pitched and heaved.
TEST(EchogramRows, DepthIsThatOfEachVoxelOfEachPing) {
  const Sea sea;
  std::vector<Placement> pings;
  for (int i = 0; i < 5; ++i) {
    pings.push_back({{60.0, 5.0}, 0.3, 6.0 + 0.7 * i, rad_from_deg(3.0 * i - 6.0), rad_from_deg(1.0 - i)});
  }
  for (const EchogramOf& of :
       {EchogramOf{0, 3, EchogramHeight::depth}, EchogramOf{2, std::nullopt, EchogramHeight::depth}}) {
    const EchogramRange range = echogram_range(sea.sector, pings, of);
    for (const Placement& ping : pings) {
      const auto column = sea.column(of, range, ping);
      std::vector<EchogramCell> expected(column.size());
      for (const EchogramRow& row : echogram_rows(sea.sector, ping, of)) {
        for (int s = 0; s < 60; ++s) {
          const int fan = row.row / 4;
          const int beam = row.row % 4;
          const double depth_m = levelled(sea.sector.centre(fan, beam, s), ping).z + ping.transducer_depth_m;
          EXPECT_NEAR(row.height_m(s), depth_m, 1e-9);
          if (s < 2 || depth_m < 0.0) continue;
          const int bin = static_cast<int>(std::floor(depth_m / range.bin_m));
          ASSERT_LT(bin, range.bins) << "no sample lies below the axis";
          EchogramCell& cell = expected[static_cast<std::size_t>(bin)];
          cell.low = std::min(cell.low, sea.sv(fan, beam, s));
          cell.high = std::max(cell.high, sea.sv(fan, beam, s));
        }
      }
      for (std::size_t b = 0; b < column.size(); ++b) {
        EXPECT_EQ(column[b].low, expected[b].low) << b;
        EXPECT_EQ(column[b].high, expected[b].high) << b;
      }
    }
  }
}

/// Depth of sound from 7 m, where its speed is 1490 m/s and rises by g m/s each metre down. By hand: it goes on a circle,
/// artanh of the dip's sine falls by g each second, and the speed goes with the dip's cosine (Snell).
double on_circle_m(double sine, double range_m, double g) {
  const double before = std::atanh(sine);
  return 7.0 + 1490.0 / g * (std::cosh(before) / std::cosh(before - g * range_m / 1490.0) - 1.0);
}

/// A ship that lists, in water where speed changes by g m/s each metre.
Placement listing(double roll_deg, double g) {
  Placement out{{60.0, 5.0}, 0.3, 7.0, rad_from_deg(roll_deg)};
  const SoundProfile profile{{0.0, 1490.0 - 7.0 * g}, {200.0, 1490.0 + 193.0 * g}};
  out.rays = std::make_shared<const Refraction>(profile, 7.0, 1490.0, 120.0);
  return out;
}

// Beam 1 looks to port, 2.5 degrees abaft the beam. Rays may be 0.1 m off; straight paths are 2.9 to 6.7 m off.
TEST(EchogramRows, DepthFollowsRaysAndRollBothWays) {
  const Sea sea;
  for (const double g : {-2.0, 2.0}) {
    for (const double roll_deg : {0.0, -8.0}) {
      const Placement ping = listing(roll_deg, g);
      const EchogramRow row = echogram_rows(sea.sector, ping, {0, 1, EchogramHeight::depth}).front();
      const double roll = rad_from_deg(roll_deg);
      const double sine = std::sin(rad_from_deg(25.0)) * std::cos(roll) -
                          std::cos(rad_from_deg(25.0)) * std::sin(rad_from_deg(87.5)) * std::sin(roll);
      for (int s = 1; s < 60; ++s) {
        EXPECT_NEAR(row.height_m(s), on_circle_m(sine, -1.0 + 2.0 * s, g), 0.1) << g << " " << roll_deg << " " << s;
        EXPECT_NEAR(row.sample_at(row.height_m(s)).value_or(-1.0), s, 1e-6);
      }
      EXPECT_GT(std::abs(row.height_m(59) - 7.0 - 117.0 * sine), 2.5) << "bending is to be seen";
    }
  }
}

// 5 degrees down where speed rises: lowest after 65 m, and at 117 m it has come up to where it was after 13 m.
TEST(EchogramRows, ARayThatTurnsBackHasItsLowestPointAndTheNearerSampleOfADepth) {
  const Sea sea;
  const Placement ping = listing(0.0, 2.0);
  const EchogramOf of{2, 1, EchogramHeight::depth};
  const EchogramRow row = echogram_rows(sea.sector, ping, of).front();
  const double lowest_m = 7.0 + 745.0 * (1.0 / std::cos(rad_from_deg(5.0)) - 1.0);
  EXPECT_NEAR(std::ranges::max(row.heights_m), lowest_m, 0.1);
  EXPECT_LT(row.height_m(59), lowest_m - 1.0);
  EXPECT_LT(row.sample_at(row.height_m(59)).value_or(59.0), 20.0);
  EXPECT_FALSE(row.sample_at(lowest_m + 0.5));
  EXPECT_FALSE(row.sample_at(5.0));
  // Every sample from the surface down has a bin, those on the way up in the bins of those on the way down.
  const EchogramRange range = echogram_range(sea.sector, std::span(&ping, 1), of);
  const auto column = sea.column(of, range, ping);
  double volume_m3 = 0.0;
  for (int s = 0; s < 60; ++s) volume_m3 += sea.sector.volume_m3(2, 1, s);
  double found_m3 = 0.0;
  for (const EchogramCell& cell : column) found_m3 += cell.volume_m3;
  EXPECT_NEAR(found_m3, volume_m3, 1e-5 * volume_m3);
}

TEST(EchogramRows, AHorizontalBeamHasOneDepth) {
  const Sector level({-0.1, 0.0}, {4.7}, {0.0, 2.0, 50});
  const Placement ping{{60.0, 5.0}, 0.0, 7.0};
  const EchogramRange range = echogram_range(level, std::span(&ping, 1), {1, 0, EchogramHeight::depth});
  EXPECT_GT(range.bins, 1);
  for (const EchogramRow& row : echogram_rows(level, ping, {1, 0, EchogramHeight::depth})) {
    EXPECT_NEAR(row.height_m(49), 7.0, 1e-9);
    EXPECT_FALSE(row.sample_at(7.0)) << "all of them lie there";
    EXPECT_GE(bin_of(range, row.height_m(49)), 0);
  }
}

// A sounder's usual pulse is four sample intervals: its first sample lies two spacings behind a transducer at the surface,
// and every other one upon an edge.
TEST(EchogramRows, SamplesOnTheEdgesOfBinsHaveOneEach) {
  for (const double spacing_m : {0.192, 0.188, 0.1, 0.7}) {
    const EchogramRange range{0.0, spacing_m, 3000};
    std::vector<int> samples(3000, 0);
    for (int s = 2; s < 3002; ++s) {
      const int bin = bin_of(range, -2.0 * spacing_m + s * spacing_m);
      ASSERT_GE(bin, 0) << s;
      ++samples[static_cast<std::size_t>(bin)];
    }
    EXPECT_EQ(std::count(samples.begin(), samples.end(), 1), 3000) << spacing_m;
  }
}

TEST(EchogramRows, BinsAreCoarserWhereThereWouldBeTooMany) {
  const Sector fine({-0.1}, {4.7}, {-0.1, 0.2, 20'000});
  const EchogramRange range = echogram_range(fine, {}, {0, 0, EchogramHeight::range});
  EXPECT_EQ(range.bins, kMostBeamBins);
  EXPECT_EQ(bin_of(range, fine.range().range_m(19'999)), range.bins - 1);
}

}  // namespace
}  // namespace sonar
