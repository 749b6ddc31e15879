// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <set>
#include <string_view>
#include <vector>

#include "base/units.h"
#include "geo/geodesic.h"
#include "school/judge/judges.h"
#include "school/test_scene.h"
#include "school/track/track.h"

// Each judge with the scene in which it matters: without it the scene shows a school that is none.
namespace sonar {
namespace {

using test::Scene;

std::vector<RefusedDetection> refused_in(Scene& scene, const DetectParams& params = {}) {
  std::vector<RefusedDetection> refused;
  scene.refused = &refused;
  EXPECT_TRUE(scene.look(4, params).empty());
  return refused;
}

Scene noisy() {
  Scene scene;
  std::fill(scene.expected.all().begin(), scene.expected.all().end(), linear_from_db(-75.0));
  std::fill(scene.flat.power_db.begin(), scene.flat.power_db.end(), -75.0);
  return scene;
}

/// A strong fish near by: heard by some beams, and hardly longer than its pulse.
Scene single_fish() {
  Scene scene = noisy();
  for (int fan = 8; fan < 13; ++fan) {
    for (int beam = 8; beam < 13; ++beam) {
      for (int s = 400; s < 413; ++s) scene.expected(fan, beam, s) = 1e-4;
    }
  }
  return scene;
}

TEST(JudgeSize, ASingleFishIsNoSchool) {
  Scene scene = single_fish();
  const auto refused = refused_in(scene);
  ASSERT_EQ(refused.size(), 1U);
  EXPECT_EQ(refused[0].reason.judge, "size");
  EXPECT_LT(refused[0].reason.figure, 5.0);
  EXPECT_EQ(refused[0].reason.limit, 5.0);
  EXPECT_EQ(refused[0].reason.unit, "m along range");
  EXPECT_TRUE(refused[0].detection.box.contains(10, 10, 407));
  EXPECT_NEAR(refused[0].detection.loudest.first_sample, 407, 8);
}

TEST(JudgeSize, WithoutItTheFishIsASchool) {
  Scene scene = single_fish();
  EXPECT_EQ(scene.look(4, {.size = {.min_range_m = 0.0, .min_beams = 1, .min_fans = 1}}).size(), 1U);
}

TEST(JudgeSize, LeftOutTheFishIsASchool) {
  Scene scene = single_fish();
  EXPECT_EQ(scene.look(4, {.left_out = "size"}).size(), 1U);
}

/// A loud body with a fainter lobe, 14 m farther and 8 degrees aside: beams hear a hump in its skirt.
Scene with_a_lobe() {
  Scene scene = noisy();
  scene.add(150.0, -15.0, 262.0, -40.0, {9, 9, 9});
  scene.add(164.0, -15.0, 270.0, -56.0, {10, 5, 5});
  return scene;
}

TEST(JudgeProminence, AHumpInASchoolsSkirtIsNoSchool) {
  for (const std::uint64_t seed : {0U, 1U, 2U, 3U}) {
    Scene scene = with_a_lobe();
    EXPECT_EQ(scene.look(seed).size(), 1U) << seed;
  }
}

TEST(JudgeProminence, WithoutItItIsASchool) {
  for (const std::uint64_t seed : {0U, 1U, 2U, 3U}) {
    Scene scene = with_a_lobe();
    EXPECT_EQ(scene.look(seed, {.left_out = "prominence"}).size(), 2U) << seed;
  }
}

constexpr double kInterval_s = 5.0;

/// An echo at one place of the sonar's frame in some pings of a ship that sails at 5 m/s, and what the tracker makes of it.
Tracks seen_in(const std::vector<int>& pings, const TrackParams& params, double ship_mps = 5.0, int first_fan = 10,
               double level_db = -60.0, double evidence = 20.0, const std::vector<int>& unread = {}) {
  const Sector sector = test::grid().sector(test::range_axis());
  const Array3<SampleFlags> flags({20, 25, 900});
  std::vector<DetectedPing> detected;
  for (int p = 0; p < 12; ++p) {
    if (std::ranges::count(unread, p) > 0) continue;
    DetectedPing ping;
    ping.ping_index = p;
    ping.time = static_cast<TimeNs>(p * kInterval_s) * kSecondNs;
    ping.placement.transducer = to_geographic(Point<Enu>{0.0, ship_mps * kInterval_s * p, 0.0}, Geographic{60.0, 4.0});
    if (std::ranges::count(pings, p) > 0) {
      PingMask mask;
      for (const int fan : {first_fan, first_fan + 1}) {
        for (int beam = 10; beam < 13; ++beam) mask.runs.push_back({fan * 25 + beam, first_fan == 18 ? 160 : 400, 30});
      }
      mask.confidence.assign(180, 255);
      ping.detections.push_back(describe_mask(std::move(mask), flags.view(), sector));
      ping.detections.back().evidence = evidence;
      ping.detections.back().reference_db = level_db;
    }
    detected.push_back(std::move(ping));
  }
  TrackParams asked = params;
  asked.confirmation.evidence = 15.0;
  return track(detected, sector, test::grid().channel, asked);
}

// Another ship's sounder, or an impulse: one ping, or two.
TEST(JudgeConfirmation, WhatOnePingShowsIsNoSchool) {
  const Tracks tracks = seen_in({4, 5}, {}, 0.0);
  EXPECT_TRUE(tracks.schools.empty());
  ASSERT_EQ(tracks.refused.size(), 1U);
  EXPECT_EQ(tracks.refused[0].reason.judge, "confirmation");
  EXPECT_EQ(tracks.refused[0].reason.figure, 2.0);
  EXPECT_EQ(tracks.refused[0].reason.limit, 3.0);
}

TEST(JudgeConfirmation, WithoutItItIsASchool) {
  EXPECT_EQ(seen_in({4, 5}, {.confirmation = {.pings = 1}}, 0.0).schools.size(), 1U);
}

TEST(JudgeConfirmation, SightingsMustLieNearEachOther) {
  EXPECT_EQ(seen_in({2, 4, 6}, {}, 0.0).schools.size(), 1U) << "three in five pings";
  EXPECT_TRUE(seen_in({2, 5, 8}, {}, 0.0).schools.empty());
}

// 5 above nothing is 2.5 above what chance gives: nine sightings have 22.5 together, three 7.5.
TEST(JudgeConfirmation, ManyFaintSightingsAreASchoolAndFewAreNot) {
  EXPECT_EQ(seen_in({2, 3, 4, 5, 6, 7, 8, 9, 10}, {}, 0.0, 10, -60.0, 5.0).schools.size(), 1U);
  const Tracks few = seen_in({2, 3, 4}, {}, 0.0, 10, -60.0, 5.0);
  EXPECT_TRUE(few.schools.empty());
  ASSERT_EQ(few.refused.size(), 1U);
  EXPECT_EQ(few.refused[0].reason.judge, "confirmation");
  EXPECT_NEAR(few.refused[0].reason.figure, 7.5, 1e-9);
  EXPECT_EQ(few.refused[0].reason.limit, 15.0);
}

// Each ping between that shows nothing takes 2.5: six sightings with 15 together, and five such pings.
TEST(JudgeConfirmation, PingsThatShowNothingCountAgainstIt) {
  EXPECT_EQ(seen_in({1, 2, 3, 4, 5, 6}, {}, 0.0, 10, -60.0, 5.0).schools.size(), 1U);
  EXPECT_TRUE(seen_in({1, 3, 5, 7, 9, 11}, {}, 0.0, 10, -60.0, 5.0).schools.empty());
}

TEST(JudgeConfirmation, PingsThatNobodyCouldReadDoNot) {
  EXPECT_EQ(seen_in({1, 3, 5, 7, 9, 11}, {}, 0.0, 10, -60.0, 5.0, {2, 4, 6, 8, 10}).schools.size(), 1U);
}

// Another sounder's pulse in two pings is a school to those who ask no more.
TEST(JudgeConfirmation, AsManyClearSightingsAsAreAskedForAreEnough) {
  EXPECT_EQ(seen_in({4}, {.confirmation = {.pings = 1}}, 0.0).schools.size(), 1U);
}

// Bubbles that the hull carries along.
TEST(JudgeShip, WhatStaysWithTheShipIsNoSchool) {
  const Tracks tracks = seen_in({2, 3, 4, 5, 6, 7}, {});
  EXPECT_TRUE(tracks.schools.empty());
  ASSERT_EQ(tracks.refused.size(), 1U);
  EXPECT_EQ(tracks.refused[0].reason.judge, "ship");
  EXPECT_LT(tracks.refused[0].reason.figure, 0.05);
}

TEST(JudgeShip, WithoutItItIsASchool) {
  EXPECT_EQ(seen_in({2, 3, 4, 5, 6, 7}, {.ship = {.drift_share = 0.0}}).schools.size(), 1U);
}

// A few fish far from each other in quiet water: as clear as can be.
TEST(JudgeLevel, WhatIsFainterThanFishTogetherIsNoSchool) {
  const Tracks tracks = seen_in({2, 3, 4, 5, 6, 7}, {}, 0.0, 10, -82.0);
  EXPECT_TRUE(tracks.schools.empty());
  ASSERT_EQ(tracks.refused.size(), 1U);
  EXPECT_EQ(tracks.refused[0].reason.judge, "level");
  EXPECT_EQ(tracks.refused[0].reason.figure, -82.0);
  EXPECT_EQ(tracks.refused[0].reason.limit, -77.0);
}

TEST(JudgeLevel, WithoutItItIsASchool) {
  EXPECT_EQ(seen_in({2, 3, 4, 5, 6, 7}, {.level = {.min_level_db = -90.0}}, 0.0, 10, -82.0).schools.size(), 1U);
}

// Bubbles under the surface, 60 m away, as a ship at rest sees them: in the two top fans, 7 to 14 m deep.
TEST(JudgeSurface, WhatHangsFromTheSurfaceIsNoSchool) {
  const Tracks tracks = seen_in({2, 3, 4, 5, 6, 7}, {}, 0.0, 18);
  EXPECT_TRUE(tracks.schools.empty());
  ASSERT_EQ(tracks.refused.size(), 1U);
  EXPECT_EQ(tracks.refused[0].reason.judge, "surface");
  EXPECT_LT(tracks.refused[0].reason.figure, 16.0);
  EXPECT_EQ(tracks.refused[0].reason.limit, 20.0);
}

TEST(JudgeSurface, WhatIsTooLoudForBubblesIsASchool) {
  EXPECT_EQ(seen_in({2, 3, 4, 5, 6, 7}, {}, 0.0, 18, -42.0).schools.size(), 1U) << "a school that swims at the surface";
}

TEST(JudgeSurface, LeftOutItIsASchool) {
  EXPECT_EQ(seen_in({2, 3, 4, 5, 6, 7}, {.left_out = "ship, surface"}, 0.0, 18).schools.size(), 1U);
  EXPECT_TRUE(seen_in({2, 3, 4, 5, 6, 7}, {.left_out = "ship, level"}, 0.0, 18).schools.empty());
}

TEST(Judges, ListsOfThem) {
  EXPECT_TRUE(names_judge("size,ship", "ship"));
  EXPECT_TRUE(names_judge(" ship ,size", "ship"));
  EXPECT_FALSE(names_judge("ships", "ship"));
  EXPECT_FALSE(names_judge("", "ship"));
  EXPECT_EQ(no_judge_in(""), "");
  EXPECT_EQ(no_judge_in("size, prominence,confirmation ,ship,level,surface,"), "");
  EXPECT_EQ(no_judge_in("size, no one"), "no one");
  std::set<std::string_view> names{kSizeJudge.name, kProminenceJudge.name};
  for (const TrackJudge& judge : kTrackJudges) names.insert(judge.name);
  EXPECT_EQ(names, std::set<std::string_view>(kJudgeNames.begin(), kJudgeNames.end()));
}

TEST(JudgeSurface, WhatHasWaterAboveItIsASchool) {
  EXPECT_EQ(seen_in({2, 3, 4, 5, 6, 7}, {}, 0.0, 17).schools.size(), 1U) << "one fan deeper";
}

}  // namespace
}  // namespace sonar
