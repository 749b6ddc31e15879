// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/placed_events.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/product_example.h"

namespace sonar {
namespace {

SchoolMasks school(std::int64_t number, std::int64_t first, std::int64_t last, const PingMask& mask) {
  SchoolMasks made;
  made.track_id = made.decided.school_id = number;
  for (std::int64_t ping = first; ping <= last; ++ping) made.pings.push_back({ping, mask, kUnknown});
  return made;
}

std::string told(const std::vector<TrackEvent>& events) {
  std::string text;
  for (const TrackEvent& event : events) text += to_text(event) + "; ";
  return text;
}

/// 1 is there in pings 0 to 9; 2 splits from it in ping 6; 3 merges into it after ping 3.
class PlacedEvents : public testing::Test {
 protected:
  const PingMask a_ = example::block(0, 0, 3, 10, 12);
  const PingMask b_ = example::block(0, 0, 3, 20, 22);
  const PingMask c_ = example::block(0, 0, 3, 30, 32);
  const std::vector<SchoolMasks> found_{school(1, 0, 9, a_), school(2, 6, 9, b_), school(3, 0, 3, c_)};
  const std::vector<PlacedEvent> placed_ = placed_events(
      std::vector<TrackEvent>{
          {TrackEventKind::birth, 0, 1, 0}, {TrackEventKind::split, 6, 2, 1}, {TrackEventKind::merge, 4, 3, 1}},
      found_);
};

TEST_F(PlacedEvents, WithoutAHumanTheyAreAsTheyWereNoted) {
  EXPECT_EQ(told(events_now(placed_, found_)),
            "ping 0: school 1 first seen; ping 6: school 2 split from school 1; "
            "ping 4: school 3 merged into school 1; ");
}

TEST_F(PlacedEvents, OfATrackThatWasCutTheyAreThoseOfThePieceWhereTheyHappened) {
  std::vector<SchoolMasks> cut{school(1, 0, 4, a_), found_[1], found_[2], school(7, 5, 9, a_)};
  cut[3].track_id = 0;
  EXPECT_EQ(told(events_now(placed_, cut)),
            "ping 0: school 1 first seen; ping 6: school 2 split from school 7; "
            "ping 4: school 3 merged into school 1; ");
}

TEST_F(PlacedEvents, WithinOneSchoolNothingHappens) {
  // 2 was joined to 1, and 3 was deleted.
  std::vector<SchoolMasks> joined{found_[0]};
  for (std::size_t i = 6; i <= 9; ++i) joined[0].pings[i].mask = unite(a_, b_);
  EXPECT_EQ(told(events_now(placed_, joined)), "ping 0: school 1 first seen; ");
}

TEST_F(PlacedEvents, OfATrackThatWasHandedOverTheyAreThoseOfWhoeverHasIt) {
  // 2 has all of 1 in pings 0 to 5, and 1 is what split off.
  const std::vector<SchoolMasks> changed{school(1, 6, 9, b_), school(2, 0, 9, a_), found_[2]};
  EXPECT_EQ(told(events_now(placed_, changed)),
            "ping 0: school 1 first seen; ping 6: school 1 split from school 2; "
            "ping 4: school 3 merged into school 2; ");
}

}  // namespace
}  // namespace sonar
