// SPDX-License-Identifier: Apache-2.0
// What is known of the ship and of its pings, and what becomes of schools where it is not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "base/units.h"
#include "geo/frames.h"
#include "observed_survey.h"
#include "pipeline/stages/engine.h"

namespace sonar {
namespace {

using ObservedShip = test::ObservedSurvey;

// Law: what the ship's sentences say nothing of for a while, in the middle or from the start, is no other sea: the same
// schools in the same pings, but no place where there was none.
TEST_F(ObservedShip, AGapInTheNavigationBreaksNoTrack) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [first, last] : {std::pair{9, 15}, std::pair{0, 7}}) {
    ObservationFiles silent = observation();
    for (int i = first; i <= last; ++i) {
      PingNavigation& at = silent.navigation[static_cast<std::size_t>(i)];
      at.transducer = {unknown, unknown};
      at.heading_deg = at.speed_mps = at.course_deg = unknown;
    }
    Work work(2);
    const auto product = observe(*survey_, silent, {}, {{}, {}, "test"}, work);
    ASSERT_TRUE(product);
    EXPECT_EQ(count(*product, DiagnosticCode::dead_reckoned), 1);
    EXPECT_EQ(count(*product_, DiagnosticCode::dead_reckoned), 0);
    ASSERT_EQ(product->school_pings.size(), product_->school_pings.size());
    for (std::size_t i = 0; i < product->school_pings.size(); ++i) {
      const SchoolPingRow& row = product->school_pings[i];
      const SchoolPingRow& whole = product_->school_pings[i];
      EXPECT_EQ(row.school_id, whole.school_id);
      EXPECT_EQ(row.ping_index, whole.ping_index);
      // where the ship was tells where neighbouring sightings look at the school: some voxels of its border
      EXPECT_NEAR(static_cast<double>(row.n_voxels) / static_cast<double>(whole.n_voxels), 1.0, 0.02);
      EXPECT_NEAR(row.range_m, whole.range_m, 0.05);
      const bool lost = row.ping_index >= first && row.ping_index <= last;
      for (const double place : {row.latitude, row.longitude, row.bearing_deg, row.axis_deg}) {
        EXPECT_EQ(std::isnan(place), lost) << row.ping_index;
      }
    }
  }
}

// Pings that were made without transmitting are passed over: no rows there, and no track that ends at them.
TEST_F(ObservedShip, SilentPingsAreNeitherMeasuredNorInTheWay) {
  ObservationFiles listening = observation();
  const auto silent = [](std::int64_t ping_index) { return ping_index % 4 == 3; };
  for (std::size_t i = 0; i < listening.navigation.size(); ++i) {
    listening.navigation[i].bad = silent(static_cast<std::int64_t>(i));
  }
  Work work(2);
  const auto product = observe(*survey_, listening, {}, {{}, {}, "test"}, work);
  ASSERT_TRUE(product);
  EXPECT_EQ(product->schools.size(), product_->schools.size());
  std::map<std::int64_t, std::size_t> rows;
  for (const SchoolPingRow& row : product->school_pings) {
    EXPECT_FALSE(silent(row.ping_index));
    ++rows[row.ping_index];
  }
  std::map<std::int64_t, std::size_t> heard;
  for (const SchoolPingRow& row : product_->school_pings) {
    if (!silent(row.ping_index)) ++heard[row.ping_index];
  }
  EXPECT_EQ(rows, heard);
  Recipe by_hand;
  by_hand.automatic = false;
  const JournalLine line = click(GrowMode::tracked);
  const auto clicked = ping_at(*survey_, listening, line.ping_time);
  ASSERT_TRUE(clicked);
  for (std::size_t i = 0; i < listening.navigation.size(); ++i) {
    listening.navigation[i].bad = static_cast<std::int64_t>(i) == *clicked + 1;
  }
  const auto carried = observe(*survey_, listening, by_hand, {{}, std::span(&line, 1), "test"}, work);
  ASSERT_TRUE(carried);
  const auto has = [&](std::int64_t ping_index) {
    return std::any_of(carried->masks.begin(), carried->masks.end(),
                       [&](const SchoolMask& mask) { return mask.ping_index == ping_index; });
  };
  EXPECT_TRUE(has(*clicked));
  EXPECT_FALSE(has(*clicked + 1));
  EXPECT_TRUE(has(*clicked + 2));
}

// Beams of less than their spacing: the filter looks along each alone, and detection takes nothing of it for a peak.
TEST_F(ObservedShip, SeparateBeamsTellNoPeak) {
  ObservationFiles narrow = observation();
  for (double& width_deg : narrow.grid->vertical_width_deg) width_deg = 2.0;
  for (double& width_deg : narrow.grid->horizontal_width_deg) width_deg = 2.0;
  const auto peaked = [&](const ObservationFiles& of) {
    Engine engine(*survey_, of, {});
    const auto ping = engine.staged(0);
    EXPECT_TRUE(ping);
    const WaterLevels water = engine.own_water(*ping);
    return engine.echo(*ping, water).peaked;
  };
  EXPECT_TRUE(peaked(observation()));
  EXPECT_FALSE(peaked(narrow));
}

// By hand from each row of the stabilised sonar: its place relative to the ship, turned by a roll of 5 degrees port up and
// a pitch of 0, has the depth and the bearing that a hull-fixed sonar with the same samples must tell. Masks that pings
// tell each other over ground are rounded to other voxels: a few differ.
TEST_F(ObservedShip, BeamsThatAreNotStabilisedTurnWithTheShip) {
  constexpr double roll = 5.0 * std::numbers::pi / 180.0;
  ObservationFiles rolled = observation();
  for (PingNavigation& at : rolled.navigation) {
    at.roll_deg = 5.0;
    at.pitch_deg = 0.0;
  }
  Recipe hull;
  hull.navigation.beams_stabilised = false;
  Work work(2);
  const auto stabilised = observe(*survey_, rolled, {}, {{}, {}, "test"}, work);
  const auto fixed = observe(*survey_, rolled, hull, {{}, {}, "test"}, work);
  ASSERT_TRUE(stabilised && fixed);
  ASSERT_EQ(fixed->school_pings.size(), stabilised->school_pings.size());
  for (std::size_t i = 0; i < fixed->school_pings.size(); ++i) {
    const SchoolPingRow& was = stabilised->school_pings[i];
    const SchoolPingRow& is = fixed->school_pings[i];
    const PingNavigation& at = rolled.navigation[static_cast<std::size_t>(was.ping_index)];
    const double down = was.depth_m - at.transducer_depth_m;
    const double level = std::sqrt(was.range_m * was.range_m - down * down);
    const double bow = level * std::cos(rad_from_deg(was.bearing_deg - at.heading_deg));
    const double starboard = level * std::sin(rad_from_deg(was.bearing_deg - at.heading_deg));
    const double rolled_starboard = starboard * std::cos(roll) - down * std::sin(roll);
    EXPECT_NEAR(is.range_m, was.range_m, 0.05);
    EXPECT_NEAR(is.depth_m, at.transducer_depth_m + starboard * std::sin(roll) + down * std::cos(roll), 0.05);
    EXPECT_NEAR(wrap_180(is.bearing_deg - at.heading_deg - deg_from_rad(std::atan2(rolled_starboard, bow))), 0.0, 0.02);
    const auto voxels = static_cast<double>(was.n_voxels);
    EXPECT_NEAR(static_cast<double>(is.n_voxels), voxels, 0.02 * voxels);
  }
}

}  // namespace
}  // namespace sonar
