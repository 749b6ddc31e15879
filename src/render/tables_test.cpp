// SPDX-License-Identifier: Apache-2.0
// The tables that both back-ends share, against plain counting.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/units.h"
#include "render/filled_volume.h"
#include "render/grid_axes.h"
#include "render/homogeneous_cells.h"
#include "render/macrocells.h"
#include "render/test_scenes.h"

namespace sonar {
namespace {

using namespace scenes;

double looked_up(const AngleTable& table, double diamond) {
  const double at = std::clamp((diamond - table.first) * table.per_unit, 0.0, kAngleEntries - 1.001);
  const auto k = static_cast<std::size_t>(at);
  const double low = static_cast<double>(table.value[k]);
  return low + (at - static_cast<double>(k)) * (static_cast<double>(table.value[k + 1]) - low);
}

TEST(GridAxes, TablesGiveTheSectorsIndex) {
  const Sector sectors[] = {fan(),
                            {uneven(-80.0, 20.0, 11), uneven(-170.0, 170.0, 40), RangeAxis{0.0, 0.5, 100}},
                            {uneven(-90.0, 90.0, 21), even(0.0, 360.0, 37), RangeAxis{0.0, 0.5, 100}},
                            {even(-30.0, 10.0, 9), even(330.0, 420.0, 19), RangeAxis{0.0, 0.5, 100}}};
  for (const Sector& sector : sectors) {
    const GridAxes axes = grid_axes(sector);
    for (int i = 0; i < 2000; ++i) {
      const double f = 0.5 * (1.0 + noise(static_cast<std::uint32_t>(2 * i))) * (sector.fans() - 1);
      const double b = 0.5 * (1.0 + noise(static_cast<std::uint32_t>(2 * i + 1))) * (sector.beams() - 1);
      const auto at = [](int n, double v, const auto& angle) {
        const int k = std::min(static_cast<int>(v), n - 2);
        return angle(k) + (v - k) * (angle(k + 1) - angle(k));
      };
      const auto p = Sector::direction(at(sector.fans(), f, [&](int k) { return sector.elevation_rad(k); }),
                                       at(sector.beams(), b, [&](int k) { return sector.azimuth_rad(k); }));
      const double c = std::cos(axes.middle_rad);
      const double s = std::sin(axes.middle_rad);
      const double x = p.x * c + p.y * s;
      const double y = p.y * c - p.x * s;
      EXPECT_NEAR(looked_up(axes.fan_of, diamond_angle(std::hypot(x, y), -p.z)), f, 2e-3);
      EXPECT_NEAR(looked_up(axes.beam_of, diamond_angle(x, y)), b, 4e-3);
    }
  }
}

// Where beams are even, an angle's share of the width is its index, and the table says the same.
TEST(GridAxes, EvenGridsWithin45DegreesAreKnown) {
  const auto axes = [](std::vector<double> fans, std::vector<double> beams) {
    return grid_axes({std::move(fans), std::move(beams), RangeAxis{0.0, 0.5, 100}});
  };
  const GridAxes usual = axes(even(-45.0, 0.0, 20), even(240.0, 300.0, 25));
  EXPECT_TRUE(usual.even_fans && usual.even_beams);
  const GridAxes wide = axes(even(-50.0, 0.0, 20), even(0.0, 360.0, 37));
  EXPECT_FALSE(wide.even_fans || wide.even_beams) << "the polynomial is one of -45 to 45 degrees";
  const GridAxes other = axes(uneven(-45.0, 0.0, 20), uneven(240.0, 300.0, 25));
  EXPECT_FALSE(other.even_fans || other.even_beams);
  // A thousandth of a spacing off.
  std::vector<double> nearly = even(240.0, 300.0, 25);
  nearly[7] += 1e-3 * (nearly[1] - nearly[0]);
  EXPECT_FALSE(axes(even(-45.0, 0.0, 20), nearly).even_beams);
  for (const double angle : {-0.7, -0.3, 0.0}) {
    const double index =
        (angle - usual.first_elevation_rad) / (usual.last_elevation_rad - usual.first_elevation_rad) * 19;
    EXPECT_NEAR(looked_up(usual.fan_of, diamond_angle(std::cos(angle), std::sin(angle))), index, 1e-3);
  }
}

TEST(Macrocells, LeastAndLargestHoldEveryInterpolatedValue) {
  const auto data = volume(fan(50));
  const Macrocells cells = macrocells(filled_volume(data->sv));
  ASSERT_EQ(cells.ranges, 4);  // 49 steps: 16 + 16 + 16 + 1
  for (int f = 0; f < cells.fans; ++f) {
    for (int b = 0; b < cells.beams; ++b) {
      for (int s = 0; s < 49; ++s) {
        const auto cell = static_cast<std::size_t>((f * cells.beams + b) * cells.ranges + s / 16);
        for (int i = 0; i < 8; ++i) {
          const std::int16_t v = data->sv(f + (i >> 2), b + (i >> 1 & 1), s + (i & 1));
          ASSERT_LE(cells.least[cell], v);
          ASSERT_GE(cells.largest[cell], v);
        }
      }
    }
  }
}

TEST(Macrocells, DistanceIsChebyshevs) {
  const Macrocells cells{6, 7, 11, {}, {}, {}};
  std::vector<std::uint8_t> set(cells.size(), 0);
  set[30] = set[200] = set[455] = 1;
  const auto distance = empty_distance(cells, set);
  const auto place = [&](std::size_t i) {
    const auto n = static_cast<int>(i);
    return std::array<int, 3>{n / 77, n / 11 % 7, n % 11};
  };
  for (std::size_t i = 0; i < set.size(); ++i) {
    int least = 255;
    for (const std::size_t j : {std::size_t{30}, std::size_t{200}, std::size_t{455}}) {
      const auto a = place(i);
      const auto b = place(j);
      least = std::min(least, std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])}));
    }
    ASSERT_EQ(distance[i], least) << i;
  }
  set.assign(cells.size(), 0);
  EXPECT_THAT(empty_distance(cells, set), testing::Each(255));
}

TEST(TransferTable, RangeTestsNeverMissAnEntry) {
  const OpticalTable optics = table(false);
  const TransferTable fine = transfer_table(optics);
  for (int least = -8000; least < -1000; least += 211) {
    for (int largest = least; largest < -1000; largest += 397) {
      double most = 0.0;
      for (int c = least; c <= largest; ++c) most = std::max(most, optics_at(optics, db_from_counts(c))[3]);
      EXPECT_GE(static_cast<double>(fine.largest_extinction(least, largest)), most * 0.9999);
      EXPECT_TRUE(fine.visible(least, largest) || !(most > 0.0));
    }
  }
  // Nothing is visible below -62 dB.
  EXPECT_FALSE(fine.visible(-8000, static_cast<int>(counts_from_db(-62.5))));
  EXPECT_NEAR(fine.lowest_visible_db, -62.0, 0.3);
}

TEST(HomogeneousCells, MeansAreThoseOfInterpolatedValues) {
  const auto data = volume(fan(50));
  const FilledVolume filled = filled_volume(data->sv);
  const Macrocells cells = macrocells(filled);
  const OpticalTable optics = table(true);
  const std::vector<std::uint8_t> all(cells.size(), 1);
  Work work(1);
  const auto means = cell_means(filled, cells, transfer_table(optics), all, work);
  for (const int k : {0, 2, 3}) {
    const int first = 16 * k;
    const int last = std::min(first + 16, 49);
    std::array<double, 4> sum{};
    double n = 0.0;
    const auto gauss = [](int i, int bit) {
      return (i >> bit & 1) != 0 ? 0.5 + std::sqrt(1.0 / 12) : 0.5 - std::sqrt(1.0 / 12);
    };
    for (int s = first; s < last; ++s) {
      for (int g = 0; g < 8; ++g) {
        double v = 0.0;
        for (int i = 0; i < 8; ++i) {
          double w = 1.0;
          for (int bit = 0; bit < 3; ++bit) w *= (i >> bit & 1) != 0 ? gauss(g, bit) : 1.0 - gauss(g, bit);
          v += w * data->sv(4 + (i >> 2), 5 + (i >> 1 & 1), s + (i & 1));
        }
        const auto o = optics_at(optics, db_from_counts(v));
        for (std::size_t c = 0; c < 4; ++c) sum[c] += o[3] * (c < 3 ? o[c] : 1.0);
        n += 1.0;
      }
    }
    const auto& mean = means[static_cast<std::size_t>((4 * cells.beams + 5) * cells.ranges + k)];
    for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(static_cast<double>(mean[c]), sum[c] / n, 3e-3 * sum[3] / n + 1e-8);
  }
}

TEST(FilledVolume, AGapTakesTheMeanOfItsNeighbours) {
  Array3<std::int16_t> sv({2, 2, 6}, -100);
  EXPECT_TRUE(filled_volume(sv).complete());
  sv(0, 0, 2) = kNoData;
  sv(0, 0, 1) = -202;  // of 11 known neighbours
  const FilledVolume filled = filled_volume(sv);
  EXPECT_EQ(filled.sv(0, 0, 2), std::lround((-202.0 - 10 * 100.0) / 11.0));
  EXPECT_EQ(filled.known(0, 0, 2), 0);
  EXPECT_EQ(filled.known(0, 0, 1), 1);
}

}  // namespace
}  // namespace sonar
