// SPDX-License-Identifier: Apache-2.0
#include "view/maps/mask_mosaic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "view/maps/map_example.h"
#include "view/maps/observation_map.h"

namespace sonar {
namespace {

using map_example::block;

/// Brute force: the largest confidence of all cells of the sector that a place lies over, from above.
std::uint8_t from_above(const Sector& sector, const PingMask& mask, double u, double v) {
  std::uint8_t best = 0;
  std::size_t next = 0;
  const double azimuth = wrap_360(deg_from_rad(std::atan2(v, u)));
  const double distance = std::hypot(u, v);
  for (const Run& run : mask.runs) {
    for (int s = run.first_sample; s < run.end(); ++s, ++next) {
      const AngleBounds a = sector.azimuth_bounds(run.row % sector.beams());
      const AngleBounds e = sector.elevation_bounds(run.row / sector.beams());
      const double r = sector.range().range_m(s);
      const double dr = sector.range().spacing_m / 2.0;
      if (azimuth < deg_from_rad(a.lower) || azimuth >= deg_from_rad(a.upper)) continue;
      if (distance < (r - dr) * std::cos(e.lower) || distance >= (r + dr) * std::cos(e.upper)) continue;
      best = std::max(best, mask.confidence[next]);
    }
  }
  return best;
}

TEST(MaskPlan, NoBinInsideARunIsLostWhereCellsEndOnBinMiddles) {
  // The first range is two whole samples below zero, as real files have it: every cell's edge is a bin's middle.
  for (const double spacing_m : {0.377, 0.1887, 0.4715}) {
    GridRecord record = map_example::grid();
    record.range = {-2.0 * spacing_m, spacing_m, 2000};
    const Sector sector = record.grid.sector(record.range);
    for (int first = 4; first < 1500; first += 37) {
      const int n = 300;
      const MaskPlan plan = plan_from_side(sector, block(1, 0, 1, first, n), spacing_m);
      ASSERT_EQ(plan.wedges.size(), 1U);
      const MaskWedge& w = plan.wedges[0];
      EXPECT_GE(w.bins.size(), static_cast<std::size_t>(n));
      EXPECT_LE(w.bins.size(), static_cast<std::size_t>(n + 1));
      EXPECT_EQ(std::count(w.bins.begin(), w.bins.end(), 0), 0) << spacing_m << " m, from sample " << first;
    }
  }
}

TEST(MaskPlan, ThePatchIsTheMaximumOverAllVoxelsThere) {
  const Sector sector = map_example::grid().grid.sector(map_example::grid().range);
  PingMask mask = block(1, 0, 2, 20, 6, 90);
  const PingMask over = block(2, 1, 2, 21, 8, 200);
  mask.runs.insert(mask.runs.end(), over.runs.begin(), over.runs.end());
  mask.confidence.insert(mask.confidence.end(), over.confidence.begin(), over.confidence.end());
  PlanRaster raster{20.0, -80.0, 0.0, 0.25, -0.25, 0.0, 320, 160};  // bow up, starboard right, 0.25 m
  const MaskPatch patch = patch_of(plan_from_above(sector, mask, 0.05), raster);
  ASSERT_FALSE(patch.empty());
  const auto cells = map_example::compared(
      patch, raster, [&](int x, int y) { return from_above(sector, mask, 20.0 - 0.25 * y, -80.0 + 0.25 * x); });
  EXPECT_GT(cells.lit, 1500);
  // Bins of 5 cm and stamped bin middles differ from the exact bounds in a hair of the cells along the rim.
  EXPECT_LT(cells.different, cells.lit / 40);
}

TEST(MaskPlan, NothingIsLostOnACoarseRaster) {
  const Sector sector = map_example::grid().grid.sector(map_example::grid().range);
  PlanRaster raster{1000.0, -1000.0, 0.0, 100.0, -100.0, 0.0, 20, 20};
  const MaskPatch patch = patch_of(plan_from_above(sector, block(0, 2, 1, 30, 1, 7), 2.0), raster);
  EXPECT_EQ(std::count(patch.confidence.begin(), patch.confidence.end(), 7), 1);
}

TEST(MaskPlan, FromTheSideAFanIsAWedgeOfSlantRanges) {
  const Sector sector = map_example::grid().grid.sector(map_example::grid().range);
  const MaskPlan plan = plan_from_side(sector, block(1, 0, 3, 20, 5, 50), 1.0);
  ASSERT_EQ(plan.wedges.size(), 1U);
  EXPECT_NEAR(deg_from_rad(plan.wedges[0].first_rad), -20.0, 1e-9);
  // Samples 20 .. 24: 39 .. 47 m, a metre to each side.
  EXPECT_EQ(plan.wedges[0].first_bin, 38);
  EXPECT_EQ(plan.wedges[0].bins.size(), 10U);
}

class Mosaic : public testing::Test {
 protected:
  [[nodiscard]] static ObservationProduct ship(int pings) { return map_example::product("obs-0001", pings); }
  static constexpr PixelSize kSize{700, 600};
};

TEST_F(Mosaic, TwoPingsByHand) {
  // The ship sails north. Ping 0 and ping 1, 20 m on, see the same beam 270 +- 2.5 degrees: sample 25 lies 49 m to port.
  ObservationProduct p = ship(2);
  const PingMask weak = block(2, 1, 2, 24, 3, 100);
  const PingMask strong = block(2, 1, 2, 24, 3, 250);
  map_example::add_school(p, 1, p.pings[0].transducer, 0, 0, weak);
  map_example::add_school(p, 2, p.pings[0].transducer, 1, 1, strong);
  const auto base = observation_map_base(p, kSize, light_theme(kSize));
  ASSERT_TRUE(base);
  const MaskMosaic mosaic = mask_mosaic(*base, p);
  const auto seen = [&](const Geographic& place) {
    const PixelPoint at = *base->map.at(place);
    return mosaic.at(static_cast<int>(at.x - base->map.place.x), static_cast<int>(at.y - base->map.place.y));
  };
  const MaskMosaic::Cell first = seen(destination(p.pings[0].transducer, 49.0, 270.0));
  EXPECT_EQ(MaskMosaic::confidence(first), 100);
  EXPECT_EQ(MaskMosaic::school(first), 1);
  const MaskMosaic::Cell second = seen(destination(p.pings[1].transducer, 49.0, 270.0));
  EXPECT_EQ(MaskMosaic::confidence(second), 250);
  EXPECT_EQ(MaskMosaic::school(second), 2);
  EXPECT_EQ(seen(destination(p.pings[0].transducer, 49.0, 90.0)), 0);   // starboard
  EXPECT_EQ(seen(destination(p.pings[0].transducer, 80.0, 270.0)), 0);  // too far
}

TEST_F(Mosaic, WhateverTheOrderOfChangesTheRasterIsThatOfTheLastMasks) {
  ObservationProduct p = ship(60);
  const auto base = observation_map_base(p, kSize, light_theme(kSize));
  ASSERT_TRUE(base);
  const Sector sector = p.grid->grid.sector(p.grid->range);
  std::vector<PingMask> masks;
  for (int i = 0; i < 60; ++i) {
    masks.push_back(block(i % 3, i % 3, 1 + i % 2, 10 + i % 40, 5, static_cast<std::uint8_t>(1 + 4 * i)));
  }
  MaskMosaic direct(base->map, 60);
  for (std::size_t i = 0; i < 60; ++i) {
    if (i % 7 == 3) continue;
    const MosaicMask m{static_cast<int>(i % 5), &masks[i]};
    direct.set(i, sector, p.pings[i], std::span(&m, 1));
  }
  MaskMosaic wandering(base->map, 60);
  for (std::size_t step = 0; step < 300; ++step) {
    const std::size_t i = (step * 37) % 60;
    const MosaicMask m{2, &masks[(i + step) % 60]};
    wandering.set(i, sector, p.pings[i], std::span(&m, 1));
  }
  for (std::size_t i = 60; i-- > 0;) {
    const MosaicMask m{static_cast<int>(i % 5), &masks[i]};
    wandering.set(i, sector, p.pings[i], std::span(&m, i % 7 == 3 ? 0U : 1U));
  }
  EXPECT_TRUE(direct.cells() == wandering.cells());
  EXPECT_TRUE(std::any_of(direct.cells().begin(), direct.cells().end(), [](auto c) { return c != 0; }));
}

TEST_F(Mosaic, OneChangedPingCostsTheSameAmongTenPingsAndAmongAThousand) {
  const auto cost = [&](int pings) {
    // A ship that lies still: all masks over one another, the worst case.
    ObservationProduct p = ship(1);
    for (int i = 1; i < pings; ++i) p.pings.push_back(p.pings[0]);
    const auto base = observation_map_base(p, kSize, light_theme(kSize));
    const Sector sector = p.grid->grid.sector(p.grid->range);
    const PingMask mask = block(2, 1, 2, 20, 12, 200);
    const MosaicMask m{0, &mask};
    MaskMosaic mosaic(base->map, static_cast<std::size_t>(pings));
    for (std::size_t i = 0; i < static_cast<std::size_t>(pings); ++i)
      mosaic.set(i, sector, p.pings[i], std::span(&m, 1));
    const std::uint64_t before = mosaic.cells_touched();
    mosaic.set(static_cast<std::size_t>(pings) / 2, sector, p.pings[0], std::span(&m, 1));
    return mosaic.cells_touched() - before;
  };
  const std::uint64_t ten = cost(10);
  const std::uint64_t thousand = cost(1000);
  // Ten pings: ten patches below one root. A thousand: 16 + 16 below two levels, 4 below the root: not a hundred times.
  EXPECT_LE(thousand, 4 * ten);
}

TEST_F(Mosaic, PingsWithoutPlaceShowNothing) {
  ObservationProduct p = ship(3);
  map_example::add_school(p, 1, p.pings[0].transducer, 0, 2, block(2, 1, 2, 24, 3));
  const auto base = observation_map_base(p, kSize, light_theme(kSize));
  for (PingNavigation& n : p.pings) n.heading_deg = std::nan("");
  const MaskMosaic mosaic = mask_mosaic(*base, p);
  EXPECT_TRUE(std::all_of(mosaic.cells().begin(), mosaic.cells().end(), [](auto c) { return c == 0; }));
}

}  // namespace
}  // namespace sonar
