// SPDX-License-Identifier: Apache-2.0
#include "school/track/track.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "base/units.h"
#include "geo/geodesic.h"
#include "model/school.h"
#include "school/test_ball.h"
#include "school/test_water.h"
#include "school/track/motion.h"

namespace sonar {
namespace {

using test::Ball;
using test::ball_mask;
using test::kInterval_s;
using test::ship_at;

struct Voyage {
  Voyage() : sector(test::grid().sector(test::range_axis())), flags({20, 25, 900}) {}

  void sail(const std::vector<Ball>& balls, int pings, const std::set<std::pair<int, int>>& unseen = {},
            Geographic start = {60.0, 4.0}, double heading_deg = 0.0) {
    const std::vector<int> channel = test::grid().channel;
    for (int p = 0; p < pings; ++p) {
      DetectedPing ping{p, p * 5 * kSecondNs, ship_at(p, 3.0, start, heading_deg), {}};
      std::vector<int> who;
      for (std::size_t i = 0; i < balls.size(); ++i) {
        if (unseen.contains({p, static_cast<int>(i)})) continue;
        PingMask mask = ball_mask(balls[i], sector, ping.placement, start, p * kInterval_s);
        if (mask.voxels() < 20) continue;
        ping.detections.push_back(describe_mask(std::move(mask), flags.view(), sector));
        ping.detections.back().reference_db = balls[i].reference_db;
        who.push_back(static_cast<int>(i));
      }
      recorded.push_back(std::move(ping));
      owner.push_back(std::move(who));
    }
    tracks = track(recorded, sector, channel, {});
  }

  /// The balls that a track was made of.
  std::set<int> balls_of(const SchoolTrack& school) const {
    std::set<int> balls;
    for (const TrackedDetection& t : school.pings) {
      for (const int d : t.detections) {
        balls.insert(owner[static_cast<std::size_t>(t.ping_index)][static_cast<std::size_t>(d)]);
      }
    }
    return balls;
  }

  Sector sector;
  Array3<SampleFlags> flags;
  std::vector<DetectedPing> recorded;
  std::vector<std::vector<int>> owner;
  Tracks tracks;
};

// ship sails north, looks to port: schools lie west
const Ball kNear{{-150.0, 40.0, -40.0}, {0.3, 0.2, 0.0}};
const Ball kFar{{-230.0, 60.0, -60.0}, {-0.2, -0.4, 0.0}};

TEST(Track, KeepsTwoSchoolsApart) {
  for (const double heading_deg : {0.0, 90.0}) {
    Voyage voyage;
    std::vector<Ball> balls{kNear, kFar};
    for (Ball& ball : balls) {  // the whole scene turned with the ship
      const double h = rad_from_deg(heading_deg);
      const auto turn = [&](Point<Enu> p) {
        return Point<Enu>{p.x * std::cos(h) + p.y * std::sin(h), -p.x * std::sin(h) + p.y * std::cos(h), p.z};
      };
      ball.start = turn(ball.start);
      ball.velocity = turn(ball.velocity);
    }
    voyage.sail(balls, 14, {}, {60.0, 4.0}, heading_deg);
    ASSERT_EQ(voyage.tracks.schools.size(), 2U);
    for (const SchoolTrack& school : voyage.tracks.schools) EXPECT_EQ(voyage.balls_of(school).size(), 1U);
    EXPECT_EQ(voyage.tracks.schools[0].school_id, 1);
    EXPECT_EQ(voyage.tracks.schools[1].school_id, 2);
  }
}

TEST(Track, IsTheSameAcrossTheDateLineAndFarNorth) {
  Voyage usual;
  usual.sail({kNear, kFar}, 12);
  for (const Geographic start : {Geographic{60.0, 179.9995}, Geographic{70.0, -10.0}}) {
    Voyage voyage;
    voyage.sail({kNear, kFar}, 12, {}, start);
    ASSERT_EQ(voyage.tracks.schools.size(), usual.tracks.schools.size());
    for (std::size_t i = 0; i < usual.tracks.schools.size(); ++i) {
      EXPECT_EQ(voyage.tracks.schools[i].pings.size(), usual.tracks.schools[i].pings.size());
    }
  }
}

TEST(Track, FindsALostSchoolAgain) {
  const Ball ahead{{-150.0, 80.0, -40.0}, {0.3, 0.2, 0.0}};  // in view for 12 pings
  Voyage voyage;
  voyage.sail({ahead}, 14, {{4, 0}, {5, 0}, {6, 0}});
  ASSERT_EQ(voyage.tracks.schools.size(), 1U);
  for (const TrackedDetection& t : voyage.tracks.schools[0].pings) {
    EXPECT_TRUE(t.ping_index < 4 || t.ping_index > 6);  // gaps stay gaps
  }
  Voyage longer;
  longer.sail({ahead}, 14, {{4, 0}, {5, 0}, {6, 0}, {7, 0}});
  EXPECT_EQ(longer.tracks.schools.size(), 2U);
}

/// A ship at anchor sees a school at rest ten times, five seconds apart, with one longer pause in the middle.
std::size_t schools_round_pause(double pause_s, const TrackParams& params) {
  Voyage at_rest;
  const Placement ship = ship_at(0);
  const PingMask mask = ball_mask({{-150.0, 0.0, -40.0}, {}}, at_rest.sector, ship, ship.transducer, 0.0);
  std::vector<DetectedPing> pings;
  for (int p = 0; p < 10; ++p) {
    const double time_s = p * kInterval_s + (p >= 5 ? pause_s - kInterval_s : 0.0);
    pings.push_back({p, static_cast<TimeNs>(time_s) * kSecondNs, ship, {}});
    pings.back().detections.push_back(describe_mask(mask, at_rest.flags.view(), at_rest.sector));
    pings.back().detections.back().reference_db = -40.0;
  }
  return track(pings, at_rest.sector, test::grid().channel, params).schools.size();
}

// Where the upper border cuts a school off nobody knows how high it reaches; it is no reason to go on 100 m below.
TEST(Track, ASchoolCutOffByABorderDoesNotLeapToAnother) {
  Voyage voyage;
  std::set<std::pair<int, int>> unseen;
  for (int p = 0; p < 10; ++p) unseen.insert({p, p < 5 ? 1 : 0});
  voyage.sail({{{-150.0, 60.0, -6.0}, {}}, {{-150.0, 60.0, -105.0}, {}}}, 10, unseen);
  ASSERT_NE(voyage.recorded[4].detections.at(0).edge_flags & kEdgeTopFan, 0);
  ASSERT_EQ(voyage.tracks.schools.size(), 2U);
  for (const SchoolTrack& school : voyage.tracks.schools) EXPECT_EQ(school.pings.size(), 5U);
}

TEST(Track, DoesNotJoinAcrossAPauseOfHours) {
  TrackParams params;
  EXPECT_EQ(schools_round_pause(5.0, params), 1U);
  EXPECT_EQ(schools_round_pause(params.max_lost_s, params), 1U);
  EXPECT_EQ(schools_round_pause(params.max_lost_s + 1.0, params), 2U);
  EXPECT_EQ(schools_round_pause(7200.0, params), 2U);  // no ping between, so none was lost
  params.max_lost_s = 7200.0;
  EXPECT_EQ(schools_round_pause(7200.0, params), 1U);
}

TEST(Track, DropsWhatIsSeenTwice) {
  Voyage voyage;
  std::set<std::pair<int, int>> unseen;
  for (int p = 2; p < 10; ++p) unseen.insert({p, 0});
  voyage.sail({kNear}, 10, unseen);
  EXPECT_TRUE(voyage.tracks.schools.empty());
  EXPECT_TRUE(voyage.tracks.events.empty());
}

TEST(Track, CrossingSchoolsOfDifferentRangeDoNotSwap) {
  // one overtakes the other 60 m farther out, with opposite course
  Voyage voyage;
  voyage.sail({Ball{{-150.0, 80.0, -40.0}, {0.0, 1.0, 0.0}}, Ball{{-210.0, 110.0, -40.0}, {0.0, -1.0, 0.0}}}, 16);
  ASSERT_EQ(voyage.tracks.schools.size(), 2U);
  for (const SchoolTrack& school : voyage.tracks.schools) EXPECT_EQ(voyage.balls_of(school).size(), 1U);
}

TEST(Track, RecordsASplit) {
  // two balls that move as one at first, then part
  Voyage voyage;
  const Array3<SampleFlags>& flags = voyage.flags;
  const Geographic start{60.0, 4.0};
  for (int p = 0; p < 14; ++p) {
    DetectedPing ping{p, p * 5 * kSecondNs, ship_at(p), {}};
    const double apart = p < 5 ? 0.0 : 5.0 * (p - 4);
    const PingMask a = ball_mask({{-150.0, 80.0 - apart, -40.0}, {}}, voyage.sector, ping.placement, start, 0.0);
    const PingMask b = ball_mask({{-150.0, 95.0 + apart, -40.0}, {}, 10.0}, voyage.sector, ping.placement, start, 0.0);
    if (p < 5) {
      ping.detections.push_back(describe_mask(unite(a, b), flags.view(), voyage.sector));
    } else {
      ping.detections.push_back(describe_mask(a, flags.view(), voyage.sector));
      ping.detections.push_back(describe_mask(subtract(b, a), flags.view(), voyage.sector));
    }
    voyage.recorded.push_back(std::move(ping));
  }
  const Tracks tracks = track(voyage.recorded, voyage.sector, test::grid().channel, {});
  ASSERT_EQ(tracks.schools.size(), 2U);
  const auto split = std::find_if(tracks.events.begin(), tracks.events.end(),
                                  [](const TrackEvent& e) { return e.kind == TrackEventKind::split; });
  ASSERT_NE(split, tracks.events.end());
  EXPECT_EQ(split->school_id, 2);
  EXPECT_EQ(split->other_id, 1);
  EXPECT_EQ(to_text(*split), "ping " + std::to_string(split->ping_index) + ": school 2 split from school 1");
}

TEST(Track, RecordsAMergeAndADeath) {
  // two balls that come together and stay so
  Voyage voyage;
  for (int p = 0; p < 14; ++p) {
    DetectedPing ping{p, p * 5 * kSecondNs, ship_at(p), {}};
    const double apart = std::max(0.0, 5.0 * (8 - p));
    const PingMask a = ball_mask({{-150.0, 80.0 - apart, -40.0}, {}}, voyage.sector, ping.placement, {60.0, 4.0}, 0.0);
    const PingMask b =
        ball_mask({{-150.0, 95.0 + apart, -40.0}, {}, 10.0}, voyage.sector, ping.placement, {60.0, 4.0}, 0.0);
    for (const PingMask& mask : p < 8 ? std::vector{a, subtract(b, a)} : std::vector{unite(a, b)}) {
      ping.detections.push_back(describe_mask(mask, voyage.flags.view(), voyage.sector));
    }
    voyage.recorded.push_back(std::move(ping));
  }
  const Tracks tracks = track(voyage.recorded, voyage.sector, test::grid().channel, {.divide_joined = false});
  ASSERT_EQ(tracks.schools.size(), 2U);
  std::set<std::string> said;
  for (const TrackEvent& event : tracks.events) said.insert(to_text(event));
  EXPECT_TRUE(said.contains("ping 8: school 2 merged into school 1"));
  EXPECT_TRUE(said.contains("ping 7: school 2 last seen"));
}

/// Two balls that move towards each other, touch for some pings and part again on their own ways.
Tracks meeting(Voyage& voyage, int alone_before, const TrackParams& params,
               std::vector<std::array<PingMask, 2>>& truth) {
  const Geographic start{60.0, 4.0};
  for (int p = 0; p < 15; ++p) {
    DetectedPing ping{p, p * 5 * kSecondNs, ship_at(p, 2.0), {}};
    const double depth = 28.0 + 3.0 * std::abs(p - 7);
    const PingMask a = ball_mask({{-150.0, 70.0, -depth}, {}}, voyage.sector, ping.placement, start, 0.0);
    const PingMask b =
        ball_mask({{-150.0, 70.0, -80.0 + depth - 28.0 + 8.0}, {}}, voyage.sector, ping.placement, start, 0.0);
    truth.push_back({a, subtract(b, a)});
    const bool joined = p >= alone_before && p <= 9;
    const auto add = [&](const PingMask& mask) {
      if (!mask.empty()) ping.detections.push_back(describe_mask(mask, voyage.flags.view(), voyage.sector));
    };
    if (joined) {
      add(unite(a, b));
    } else {
      add(a);
      add(subtract(b, a));
    }
    voyage.recorded.push_back(std::move(ping));
  }
  return track(voyage.recorded, voyage.sector, test::grid().channel, params);
}

TEST(Track, SchoolsThatMeetShareTheirDetection) {
  Voyage voyage;
  std::vector<std::array<PingMask, 2>> truth;
  const Tracks tracks = meeting(voyage, 5, {}, truth);
  ASSERT_EQ(tracks.schools.size(), 2U);
  for (const SchoolTrack& school : tracks.schools) {
    EXPECT_EQ(school.pings.size(), 15U);
    const PingMask first = mask_of(school.pings[0], voyage.recorded[0]);
    const std::size_t own = dice(first, truth[0][0]) > 0.5 ? 0 : 1;
    for (const TrackedDetection& seen : school.pings) {
      const auto p = static_cast<std::size_t>(seen.ping_index);
      EXPECT_GT(dice(mask_of(seen, voyage.recorded[p]), truth[p][own]), 0.75) << p;
    }
  }
  for (std::size_t p = 5; p <= 9; ++p) {
    EXPECT_EQ(overlap(tracks.schools[0].pings[p].part, tracks.schools[1].pings[p].part), 0U);
    EXPECT_EQ(tracks.schools[0].pings[p].part.voxels() + tracks.schools[1].pings[p].part.voxels(),
              voyage.recorded[p].detections[0].mask.voxels());
  }
}

TEST(Track, TwoPingsAloneAreEnoughWhereTheDetectionIsAsLargeAsBoth) {
  Voyage voyage;
  std::vector<std::array<PingMask, 2>> truth;
  const Tracks tracks = meeting(voyage, 2, {}, truth);
  ASSERT_EQ(tracks.schools.size(), 2U);
  EXPECT_FALSE(tracks.schools[0].pings[2].part.empty());
}

TEST(Track, SchoolsThatSwimThroughEachOtherKeepTheirWays) {
  Voyage voyage;
  const Geographic start{60.0, 4.0};
  const Ball to_north{{-200.0, 0.0, -50.0}, {0.1, 1.2, 0.0}};
  const Ball to_south{{-195.0, 115.0, -50.0}, {0.0, -0.7, 0.0}};
  std::vector<std::array<PingMask, 2>> truth;
  for (int p = 0; p < 26; ++p) {
    DetectedPing ping{p, p * 5 * kSecondNs, ship_at(p, 0.5), {}};
    const auto mask = [&](const Ball& ball) {
      return ball_mask(ball, voyage.sector, ping.placement, start, p * kInterval_s);
    };
    truth.push_back({mask(to_north), mask(to_south)});
    const auto& [a, b] = truth.back();
    const bool meet = std::abs(to_north.start.y - to_south.start.y + 1.9 * p * kInterval_s) < 30.0;
    for (const PingMask& seen : meet ? std::vector{unite(a, b)} : std::vector{a, b}) {
      if (!seen.empty()) ping.detections.push_back(describe_mask(seen, voyage.flags.view(), voyage.sector));
    }
    voyage.recorded.push_back(std::move(ping));
  }
  const Tracks tracks = track(voyage.recorded, voyage.sector, test::grid().channel, {});
  ASSERT_EQ(tracks.schools.size(), 2U);
  for (const SchoolTrack& school : tracks.schools) {
    const PingMask first =
        mask_of(school.pings[0], voyage.recorded[static_cast<std::size_t>(school.pings[0].ping_index)]);
    const std::size_t own = dice(first, truth[static_cast<std::size_t>(school.pings[0].ping_index)][0]) > 0.5 ? 0 : 1;
    int shared = 0;
    for (const TrackedDetection& seen : school.pings) {
      const auto p = static_cast<std::size_t>(seen.ping_index);
      const PingMask mask = mask_of(seen, voyage.recorded[p]);
      shared += seen.part.empty() ? 0 : 1;
      // Where one lies inside the other, half of the water is all that a part can be.
      const bool side_by_side = dice(truth[p][0], truth[p][1]) < 0.3;
      EXPECT_GT(dice(mask, truth[p][own]), side_by_side ? 0.75 : 0.4) << own << " in ping " << p;
    }
    EXPECT_GT(shared, 4);
  }
}

TEST(Track, OneSchoolIsNotDividedWithoutAHistory) {
  Voyage voyage;
  std::vector<std::array<PingMask, 2>> truth;
  for (const SchoolTrack& school : meeting(voyage, 1, {}, truth).schools) {
    for (const TrackedDetection& seen : school.pings) EXPECT_TRUE(seen.part.empty());
  }
  Voyage switched_off;
  TrackParams params;
  params.divide_joined = false;
  for (const SchoolTrack& school : meeting(switched_off, 5, params, truth).schools) {
    for (const TrackedDetection& seen : school.pings) EXPECT_TRUE(seen.part.empty());
  }
}

TEST(Track, NoPingsNoTracks) { EXPECT_TRUE(track({}, Sector(), {}, {}).schools.empty()); }

TEST(Motion, FollowsASteadyTarget) {
  Motion motion({0, 0, 0}, {4, 0, 0, 4, 0, 4}, 2.0);
  for (int i = 1; i <= 30; ++i) {
    motion.predict(5.0, 0.01);
    motion.update({5.0 * i, -2.5 * i, 0.5 * i}, {1, 0, 0, 1, 0, 1});
  }
  EXPECT_NEAR(motion.velocity().x, 1.0, 1e-2);
  EXPECT_NEAR(motion.velocity().y, -0.5, 1e-2);
  EXPECT_NEAR(motion.velocity().z, 0.1, 1e-2);
}

TEST(Motion, CutCoordinatesDoNotMoveIt) {
  // a school at range 100 straight to port of a ship heading north, cut off forward: its centre seems to move north
  const Point<Sonar> centre{0.0, -100.0, 10.0};
  Motion motion({-100.0, 0.0, -10.0}, {4, 0, 0, 4, 0, 4}, 0.5);
  for (int i = 1; i <= 10; ++i) {
    motion.predict(5.0, 0.01);
    motion.update({-100.0 + 1.0 * i, 10.0 * i, -10.0},
                  centre_covariance(centre, {9, 0, 0, 9, 0, 9}, 0.0, 0.1, 1.0, 200.0, kEdgeFore));
  }
  EXPECT_LT(std::abs(motion.velocity().y), 0.15);
  EXPECT_NEAR(motion.velocity().x, 0.2, 0.1);
}

TEST(Motion, FrameGoesThereAndBack) {
  Placement placement;
  placement.transducer = {60.01, 4.01};
  placement.heading_rad = 1.0;
  placement.transducer_depth_m = 7.0;
  const PingFrame frame(placement, {60.0, 4.0});
  const Point<Sonar> p{10.0, -20.0, 30.0};
  const Point<Sonar> back = frame.from_world(frame.to_world(p));
  EXPECT_NEAR(norm(back - p), 0.0, 1e-9);
  EXPECT_NEAR(frame.to_world(p).z, -37.0, 1e-9);
}

}  // namespace
}  // namespace sonar
