// SPDX-License-Identifier: Apache-2.0
#include "school/track/inseparable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "school/test_ball.h"
#include "school/test_water.h"

// Bodies whose parts are known beforehand: balls of 12 m radius, 150 m away from a ship that sails at 3 m/s.
namespace sonar {
namespace {

using test::Ball;
using test::ball_mask;
using test::kInterval_s;
using test::ship_at;

constexpr int kPings = 14;

struct Voyage {
  Voyage() : sector(test::grid().sector(test::range_axis())), flags({20, 25, 900}) {}

  /// unseen  (ping, ball); whole  pings in which both balls are one detection
  Tracks sail(const Ball& a, const Ball& b, const std::set<std::pair<int, int>>& unseen = {},
              const std::set<int>& whole = {}) {
    for (int p = 0; p < kPings; ++p) {
      DetectedPing ping{p, p * 5 * kSecondNs, ship_at(p), {}};
      PingMask first = ball_mask(a, sector, ping.placement, {60.0, 4.0}, p * kInterval_s);
      PingMask second = subtract(ball_mask(b, sector, ping.placement, {60.0, 4.0}, p * kInterval_s), first);
      if (unseen.contains({p, 0})) first = {};
      if (unseen.contains({p, 1})) second = {};
      if (whole.contains(p)) {
        first = unite(first, second);
        second = {};
      }
      seen.push_back(unite(first, second));
      for (PingMask* mask : {&first, &second}) {
        if (mask->voxels() >= 20) ping.detections.push_back(describe_mask(std::move(*mask), flags.view(), sector));
      }
      pings.push_back(std::move(ping));
    }
    return track(pings, sector, test::grid().channel, {});
  }

  Sector sector;
  Array3<SampleFlags> flags;
  std::vector<DetectedPing> pings;
  std::vector<PingMask> seen;
};

constexpr Point<Enu> kSwims{0.3, 0.2, 0.0};
const Ball kHead{{-150.0, 80.0, -40.0}, kSwims};
const Ball kTail{{-150.0, 105.0, -40.0}, kSwims};  // 1 m beyond: a waist

/// Each sighting of the only school is all that was seen of it.
void expect_whole(const Tracks& tracks, const Voyage& voyage) {
  ASSERT_EQ(tracks.schools.size(), 1U);
  EXPECT_EQ(tracks.schools[0].school_id, 1);
  for (const TrackedDetection& sighting : tracks.schools[0].pings) {
    const auto p = static_cast<std::size_t>(sighting.ping_index);
    EXPECT_EQ(mask_of(sighting, voyage.pings[p]), voyage.seen[p]) << "ping " << p;
  }
  const auto is_birth = [](const TrackEvent& event) { return event.kind == TrackEventKind::birth; };
  EXPECT_EQ(std::ranges::count_if(tracks.events, is_birth), 1);
  EXPECT_TRUE(std::ranges::all_of(tracks.events, [](const TrackEvent& event) { return event.other_id == 0; }))
      << "nothing happens between the parts of one school";
}

TEST(Inseparable, ABodyWithAWaistIsOneSchool) {
  Voyage voyage;
  const Tracks tracks = voyage.sail(kHead, kTail);
  expect_whole(tracks, voyage);
  EXPECT_EQ(tracks.schools.at(0).pings.size(), std::size_t{kPings});
}

TEST(Inseparable, AlsoWhereOnePartIsMissedNowAndThen) {
  Voyage voyage;
  const Tracks tracks = voyage.sail(kHead, kTail, {{5, 0}, {9, 1}});
  expect_whole(tracks, voyage);
  EXPECT_EQ(tracks.schools.at(0).pings.size(), std::size_t{kPings});
}

TEST(Inseparable, AlsoWhereTheFilterJoinsThemNowAndThen) {
  Voyage voyage;
  expect_whole(voyage.sail(kHead, kTail, {}, {7, 8}), voyage);
}

TEST(Inseparable, SchoolsThatSwimAlongSideAreTwo) {
  Voyage voyage;
  EXPECT_EQ(voyage.sail(kHead, {{-150.0, 140.0, -40.0}, kSwims}).schools.size(), 2U) << "36 m of water between them";
}

// 25 m apart after 35 s, when they touch; 100 m apart before.
TEST(Inseparable, SchoolsThatMeetAndHadBeenApartAreTwo) {
  Voyage voyage;
  EXPECT_EQ(voyage.sail(kHead, {{-150.0, 180.0, -40.0}, {0.3, -1.0, 0.0}}).schools.size(), 2U);
}

// What touches twice has not been seen often enough to be called one.
TEST(Inseparable, TwoPingsTellNothing) {
  Voyage voyage;
  std::set<std::pair<int, int>> unseen;
  for (int p = 0; p < kPings; ++p) unseen.insert({p, p < 6 ? 1 : 0});
  unseen.erase({4, 1});
  unseen.erase({5, 1});
  const Tracks tracks = voyage.sail(kHead, kTail, unseen);
  ASSERT_FALSE(tracks.schools.empty());
  for (const SchoolTrack& school : tracks.schools) EXPECT_LT(school.pings.size(), std::size_t{kPings});
}

}  // namespace
}  // namespace sonar
