// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "base/units.h"
#include "geo/geodesic.h"
#include "model/school.h"
#include "school/detect/thresholder.h"
#include "school/grow/grow.h"
#include "school/grow/propagate_paper.h"
#include "school/grow/propagate_tracked.h"
#include "school/measure/edges.h"
#include "school/test_water.h"

namespace sonar {
namespace {

/// A ship that sails north past a school to port.
struct Passage {
  explicit Passage(double ship_mps = 3.0) : sector(test::grid().sector(test::range_axis(700))), speed(ship_mps) {}

  Result<FilteredPing> ping(std::int64_t i) const {
    if (i < 0 || i >= pings) return fail(ErrorCode::not_found, "there is no such ping");
    FilteredPing out;
    out.time = i * 5 * kSecondNs;
    const double north = speed * 5.0 * static_cast<double>(i);
    out.placement.transducer = to_geographic(Point<Enu>{0.0, north, 0.0}, Geographic{60.0, 4.0});
    auto volume = std::make_shared<Volume>();
    volume->flags = test::cropped_flags({20, 25, 700}, sector);
    Array3<double> expected(Shape3{20, 25, 700});
    if (i != hidden) {
      test::Ellipsoid e;
      e.centre = {school_north - north + 0.4 * 5.0 * static_cast<double>(i), -160.0, 50.0};
      e.half_x = 16.0 * scale;
      e.half_y *= scale;
      e.half_z = 6.0 * scale;
      e.sv = linear_from_db(school_db);
      test::add_ellipsoid(expected, sector, e, 700);
    }
    for (double& sv : expected.all()) sv += linear_from_db(noise_db);
    volume->counts = test::filtered(test::counts_of(expected, static_cast<std::uint64_t>(i) + 1), volume->flags);
    if (noise_known) {
      const double level_db = db_from_linear(linear_from_db(noise_db) + linear_from_db(test::kNoise_db));
      out.above_background = [volume, level_db](double margin_db, Above /*above*/) {
        test::FlatBackground flat(volume->counts.shape());
        flat.power_db.assign(flat.power_db.size(), level_db);
        const Background background{flat.power_db, flat.calibration.view()};
        return Thresholder(std::as_const(volume->counts).view(), std::as_const(volume->flags).view(), background,
                           nullptr)
            .above_background(margin_db);
      };
    }
    out.volume = std::move(volume);
    return out;
  }
  PingProvider provider() const {
    return [this](std::int64_t i) { return ping(i); };
  }
  /// One click on the brightest voxel.
  PingMask click(std::int64_t i, const GrowParams& params) const {
    const FilteredPing at = *ping(i);
    VoxelIndex brightest;
    std::int16_t most = kNoData;
    for (int row = 0; row < 500; ++row) {
      for (int s = 0; s < 700; ++s) {
        const std::int16_t count = at.volume->counts.view().row(row)[static_cast<std::size_t>(s)];
        if (count <= most) continue;
        most = count;
        brightest = {row, s};
      }
    }
    return *grow_from_click(at.volume->counts.view(), at.volume->flags.view(), brightest, TransferFunction(), params);
  }

  Sector sector;
  double speed;
  double school_north = 75.0;
  double school_db = -40.0;
  double scale = 1.0;        ///< of the school's extents
  double noise_db = -400.0;  ///< beside the water's
  bool noise_known = true;
  int pings = 16;
  int hidden = -1;
};

TEST(Tracked, FollowsASchoolThroughItsWholePassage) {
  const Passage passage;
  const PingMask selection = passage.click(5, {});
  const auto result = propagate_tracked(passage.provider(), passage.sector, 5, selection, {0, 14}, {});
  ASSERT_TRUE(result);
  // 13 m per ping from 75 m ahead to 107 m astern: the sector's borders lie at 96 m there
  EXPECT_EQ(result->pings.size(), 15U);
  int cut = 0;
  for (const PropagatedPing& p : result->pings) {
    const FilteredPing ping = *passage.ping(p.ping_index);
    if ((mask_edges(p.mask, ping.volume->flags.view(), passage.sector).flags & kTouchesEdge) != 0) ++cut;
  }
  EXPECT_GT(cut, 0);
  EXPECT_TRUE(result->note_backward.empty());
}

TEST(Tracked, FindsALostSchoolAgain) {
  Passage passage;
  passage.hidden = 7;
  const auto result = propagate_tracked(passage.provider(), passage.sector, 5, passage.click(5, {}), {0, 11}, {});
  ASSERT_TRUE(result);
  std::vector<std::int64_t> seen;
  for (const PropagatedPing& p : result->pings) seen.push_back(p.ping_index);
  EXPECT_EQ(seen, (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5, 6, 8, 9, 10, 11}));
}

TEST(Tracked, EndsWithANoteWhenTheSchoolIsGone) {
  Passage passage(12.0);
  passage.pings = 40;
  const auto result = propagate_tracked(passage.provider(), passage.sector, 1, passage.click(1, {}), {0, 30}, {});
  ASSERT_TRUE(result);
  EXPECT_FALSE(result->note_forward.empty());
  EXPECT_LT(result->pings.back().ping_index, 10);
}

// The reference follows the school, and would follow it down into the noise when it has left.
TEST(Tracked, IsNotFollowedIntoTheNoise) {
  Passage passage;
  passage.pings = 30;
  passage.school_db = -60.0;
  passage.scale = 2.0;
  passage.noise_db = -72.0;
  const PingMask selection = passage.click(5, {.tolerance_db = 6.0});
  const PingReach reach{5, 29};
  for (const double margin_db : {5.0, 0.0}) {
    TrackedPropagationParams params;
    params.margin_db = margin_db;
    const auto result = propagate_tracked(passage.provider(), passage.sector, 5, selection, reach, params);
    ASSERT_TRUE(result);
    const std::int64_t last = result->pings.back().ping_index;
    EXPECT_TRUE(margin_db > 0.0 ? last < 18 : last > 22) << last;
  }
}

TEST(Tracked, DoesNotTakeOthersVoxels) {
  const Passage passage;
  const PingMask selection = passage.click(5, {});
  const PingMask other = passage.click(6, {});
  const auto result = propagate_tracked(
      [&](std::int64_t i) {
        auto ping = passage.ping(i);
        if (i == 6) ping->taken = other;
        return ping;
      },
      passage.sector, 5, selection, {5, 6}, {});
  ASSERT_TRUE(result);
  for (const PropagatedPing& p : result->pings) {
    EXPECT_TRUE(p.ping_index != 6 || overlap(p.mask, other) == 0U);
  }
}

TEST(Paper, RangeIsComputedOnceFromTheSelection) {
  Array3<std::int16_t> sv({1, 1, 3});
  const auto count = [](double db) { return static_cast<std::int16_t>(std::lround(counts_from_db(db))); };
  sv.all()[0] = count(-50.0);  // opacity 0.5
  sv.all()[1] = count(-40.0);  // 0.75
  sv.all()[2] = count(-46.0);
  PingMask mask;
  mask.runs = {{0, 0, 3}};
  mask.confidence = {255, 255, 255};
  const PaperRange range = paper_range(sv.view(), mask, TransferFunction().table_i16());
  EXPECT_NEAR(range.centre_opacity, 0.625, 1e-3);
  EXPECT_NEAR(range.tolerance, 0.125, 1e-3);
}

/// What an observer that stops after so many steps sees, and what is kept.
struct Watched {
  std::vector<std::int64_t> seen;
  std::vector<PingMask> masks;
  PropagationObserver stop_after(std::size_t steps) {
    return [this, steps](std::int64_t ping_index, const PingMask& mask) {
      seen.push_back(ping_index);
      masks.push_back(mask);
      return seen.size() < steps;
    };
  }
};

TEST(Tracked, ObserverSeesEveryPingAndWhatItKeepsIsWhatTheReachGives) {
  Passage passage;
  passage.hidden = 7;
  const PingMask selection = passage.click(5, {});
  std::vector<FilteredPing> made;
  for (std::int64_t i = 0; i < 10; ++i) made.push_back(*passage.ping(i));
  const PingProvider pings = [&](std::int64_t i) -> Result<FilteredPing> { return made[static_cast<std::size_t>(i)]; };
  const std::vector<std::int64_t> order{4, 3, 6, 7, 8, 9};
  for (std::size_t steps = 1; steps <= order.size() + 1; ++steps) {
    Watched watched;
    const auto stopped = propagate_tracked(pings, passage.sector, 5, selection, {3, 9}, {}, watched.stop_after(steps));
    ASSERT_TRUE(stopped);
    const std::size_t taken = std::min(steps, order.size());
    EXPECT_EQ(watched.seen,
              std::vector<std::int64_t>(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(taken)));
    const std::int64_t end = order[taken - 1];
    EXPECT_EQ(stopped->stopped_at, steps > order.size() ? std::nullopt : std::optional(end));
    const PingReach reached{end < 5 ? end : 3, end < 5 ? 5 : end};
    const auto reach = propagate_tracked(pings, passage.sector, 5, selection, reached, {});
    ASSERT_TRUE(reach);
    ASSERT_EQ(stopped->pings.size(), reach->pings.size()) << "after " << steps << " steps";
    for (std::size_t i = 0; i < reach->pings.size(); ++i) {
      EXPECT_EQ(stopped->pings[i].ping_index, reach->pings[i].ping_index);
      EXPECT_EQ(stopped->pings[i].mask, reach->pings[i].mask);
    }
    EXPECT_EQ(stopped->note_backward + stopped->note_forward, reach->note_backward + reach->note_forward);
    for (std::size_t i = 0; i < taken; ++i) EXPECT_EQ(watched.masks[i].empty(), watched.seen[i] == 7);
  }
}

TEST(Paper, StopsAtTheBorderWithANote) {
  const Passage passage;
  GrowParams params;
  params.mode = GrowMode::paper;
  params.tolerance_opacity = 0.25;
  const auto result = propagate_paper(passage.provider(), 5, passage.click(5, params), {0, 15}, TransferFunction(), {});
  ASSERT_TRUE(result);
  ASSERT_FALSE(result->note_forward.empty());
  EXPECT_NE(result->note_forward.find("stopped at ping"), std::string::npos);
  EXPECT_LT(result->pings.size(), 16U);
  for (std::size_t i = 1; i < result->pings.size(); ++i) {
    EXPECT_EQ(result->pings[i].ping_index, result->pings[i - 1].ping_index + 1);
  }
}

TEST(Paper, StopsWhereTheCentreIsOutOfRange) {
  Passage passage(0.5);
  passage.school_north = 0.0;
  passage.hidden = 7;
  GrowParams params;
  params.mode = GrowMode::paper;
  params.tolerance_opacity = 0.25;
  PaperPropagationParams narrow;
  narrow.enlarge_fans = 1;
  narrow.enlarge_beams = 1;
  const auto result =
      propagate_paper(passage.provider(), 5, passage.click(5, params), {5, 9}, TransferFunction(), narrow);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->pings.back().ping_index, 6);
  EXPECT_NE(result->note_forward.find("stopped at ping 7: the centre's voxel"), std::string::npos);
}

// Law: a bad ping is as if it had never been made. Without the mark the school, which is not in it, ends there (above).
TEST(Paper, PassesOverABadPing) {
  Passage passage(0.5);
  passage.school_north = 0.0;
  passage.hidden = 7;
  GrowParams params;
  params.mode = GrowMode::paper;
  params.tolerance_opacity = 0.25;
  PaperPropagationParams narrow;
  narrow.enlarge_fans = 1;
  narrow.enlarge_beams = 1;
  const PingProvider marked = [&](std::int64_t i) {
    auto ping = passage.ping(i);
    if (ping) ping->bad = i == 7;
    return ping;
  };
  const PingProvider without = [&](std::int64_t i) { return passage.ping(i < 7 ? i : i + 1); };
  const PingMask selection = passage.click(5, params);
  const auto over = propagate_paper(marked, 5, selection, {5, 9}, TransferFunction(), narrow);
  const auto never = propagate_paper(without, 5, selection, {5, 8}, TransferFunction(), narrow);
  ASSERT_TRUE(over && never);
  EXPECT_EQ(over->note_forward.find("stopped at ping 7"), std::string::npos);
  ASSERT_EQ(over->pings.size(), never->pings.size());
  for (std::size_t i = 0; i < over->pings.size(); ++i) EXPECT_EQ(over->pings[i].mask, never->pings[i].mask) << i;
}

// More bad pings in a row than a school may be lost for.
TEST(Tracked, BadPingsDoNotCountAsLost) {
  const Passage passage(0.5);
  const PingProvider pings = [&](std::int64_t i) {
    auto ping = passage.ping(i);
    if (ping) ping->bad = i >= 6 && i <= 10;
    return ping;
  };
  const auto result = propagate_tracked(pings, passage.sector, 5, passage.click(5, {}), {5, 12}, {});
  ASSERT_TRUE(result);
  std::vector<std::int64_t> reached;
  for (const PropagatedPing& ping : result->pings) reached.push_back(ping.ping_index);
  EXPECT_EQ(reached, (std::vector<std::int64_t>{5, 11, 12}));
}

TEST(Propagate, RefusesAnEmptySelection) {
  const Passage passage;
  EXPECT_FALSE(propagate_paper(passage.provider(), 5, {}, {0, 15}, TransferFunction(), {}));
  EXPECT_FALSE(propagate_tracked(passage.provider(), passage.sector, 5, {}, {0, 15}, {}));
  EXPECT_FALSE(propagate_tracked(passage.provider(), passage.sector, 50, passage.click(5, {}), {0, 60}, {}));
}

}  // namespace
}  // namespace sonar
