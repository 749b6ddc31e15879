// SPDX-License-Identifier: Apache-2.0
#include "view/volume/school_trails.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <vector>

#include "base/units.h"
#include "geo/geodesic.h"
#include "view/slices/slice_example.h"
#include "view/volume/mask_sections.h"

namespace sonar {
namespace {

constexpr PixelSize kSize{1200, 900};
constexpr int kPings = 13;
const Camera kCamera{{250.0, -500.0, -250.0}, {0.0, -120.0, 40.0}, {0.0, 0.0, -1.0}, 0.7};

/// A fine sector to port: 2 degrees and 1 m.
Sector fine_sector() {
  return Sector(slice_example::radians(slice_example::even_deg(-60, 2, 30)),
                slice_example::radians(slice_example::even_deg(210, 2, 60)), {0.0, 1.0, 301});
}

/// A ship that sails 8 m a ping past a school that stays where it is, and turns a little.
class StillSchool {
 public:
  StillSchool() {
    auto pings = std::make_shared<std::vector<PingNavigation>>();
    for (int i = 0; i < kPings; ++i) {
      PingNavigation ping;
      ping.transducer = destination({62.0, -4.0}, 8.0 * i, 20.0);
      ping.heading_deg = 20.0 + 1.5 * i;
      ping.transducer_depth_m = 6.0;
      pings->push_back(ping);
    }
    subject.pings = pings;
    there = destination(ping(6).transducer, 120.0, 295.0);
    masks_ = std::make_shared<std::vector<PingMask>>();
    for (int i = 0; i < kPings; ++i) masks_->push_back(mask_of(i));
    TrailSchool school{masks_, {200, 30, 60, 255}, false, {}};
    for (int i = 0; i < kPings; ++i) school.pings.push_back({i, &(*masks_)[static_cast<std::size_t>(i)]});
    subject.schools.push_back(school);
  }

  [[nodiscard]] const PingNavigation& ping(int i) const { return (*subject.pings)[static_cast<std::size_t>(i)]; }
  /// The school's middle, 50 m below the sea, in the frame of a ping.
  [[nodiscard]] Point<Sonar> place(int i) const {
    Point<Sonar> out = to_sonar(to_enu(there, ping(i).transducer), rad_from_deg(ping(i).heading_deg));
    out.z = 50.0 - ping(i).transducer_depth_m;
    return out;
  }
  [[nodiscard]] std::vector<SceneLine> lines(int shown, const TrailParams& params) {
    return trails.lines(sector, subject, shown, ping(shown), params, light_theme(kSize));
  }

  Sector sector = fine_sector();
  TrailSubject subject;
  Geographic there;
  SchoolTrails trails;

 private:
  /// The voxels round the place: 3 fans, 3 beams, 9 samples.
  [[nodiscard]] PingMask mask_of(int i) const {
    const SectorIndex at = sector.index_of(place(i));
    const int fan = static_cast<int>(std::lround(at.fan));
    const int beam = static_cast<int>(std::lround(at.beam));
    const int sample = static_cast<int>(std::lround(at.sample));
    PingMask mask;
    for (int f = fan - 1; f <= fan + 1; ++f) {
      for (int b = beam - 1; b <= beam + 1; ++b) mask.runs.push_back({f * sector.beams() + b, sample - 4, 9});
    }
    mask.confidence.assign(81, 255);
    return mask;
  }
  std::shared_ptr<std::vector<PingMask>> masks_;
};

TrailParams trail_of(int pings) { return {false, false, pings}; }

double away(PixelPoint a, PixelPoint b) { return std::hypot(a.x - b.x, a.y - b.y); }

PixelPoint pixel_of(const Camera& camera, const Point<Sonar>& place) {
  const auto seen = basis(camera, kSize).project(place);
  EXPECT_TRUE(seen);
  return seen ? seen->pixel : PixelPoint{};
}

// The school lies between two voxels at most: 2 degrees at 150 m are 5 m, half of that and of its own extent is allowed.
TEST(SchoolTrails, OfASchoolThatStaysLieInOnePlace) {
  StillSchool scene;
  const Point<Sonar> school = scene.place(12);
  const std::vector<SceneLine> lines = scene.lines(12, trail_of(12));
  ASSERT_EQ(lines.size() % 12, 0U);
  double farthest = 0.0;
  for (const SceneLine& line : lines) farthest = std::max(farthest, norm(line.from - school));
  EXPECT_LT(farthest, 16.0) << "the ship has sailed 96 m";
  for (const SceneLine& line : scene.lines(12, {false, true, 0})) {
    EXPECT_LT(norm(line.from - school), 4.5) << "half a voxel";
  }
}

// Law: seen by an eye that stands still on the earth a trail stays where it is in the picture; by one that sails with the
// ship it goes aft.
TEST(SchoolTrails, StandStillInTheEarthFixedViewAloneAndMoveInTheShips) {
  StillSchool scene;
  scene.subject.schools[0].pings.resize(3);
  const std::vector<SceneLine> early = scene.lines(3, trail_of(12));
  const Camera stood = kCamera;
  for (int shown = 4; shown < kPings; ++shown) {
    const std::vector<SceneLine> now = scene.lines(shown, trail_of(12));
    ASSERT_EQ(now.size(), early.size());
    const Camera still = *standing_still(stood, scene.ping(3), scene.ping(shown));
    for (std::size_t i = 0; i < now.size(); ++i) {
      EXPECT_LT(away(pixel_of(still, now[i].from), pixel_of(stood, early[i].from)), 0.5);
      EXPECT_GT(away(pixel_of(stood, now[i].from), pixel_of(stood, early[i].from)), 4.0 * (shown - 3));
    }
  }
}

TEST(SchoolTrails, ReachSoManyPingsBackAndFadeWithAge) {
  StillSchool scene;
  EXPECT_TRUE(scene.lines(10, {}).empty());
  const std::size_t each = scene.lines(10, trail_of(1)).size();
  ASSERT_GT(each, 8U);
  EXPECT_EQ(scene.lines(10, trail_of(4)).size(), 4 * each);
  EXPECT_EQ(scene.lines(2, trail_of(4)).size(), 2 * each) << "there were two pings before";
  EXPECT_TRUE(scene.lines(0, trail_of(4)).empty());
  // Oldest first.
  const std::vector<SceneLine> lines = scene.lines(10, trail_of(8));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    EXPECT_GT(lines[i].colour.a, 0);
    EXPECT_EQ(lines[i].colour.r, 200) << "in the school's colour";
    if (i < each) continue;
    EXPECT_GT(lines[i].colour.a, lines[i - each].colour.a);
  }
  for (int age = 2; age <= 200; ++age) EXPECT_LT(trail_strength(age, 200), trail_strength(age - 1, 200));
  EXPECT_EQ(trail_strength(1, 200), 1.0);
  EXPECT_GT(trail_strength(200, 200), 0.0);
}

TEST(SchoolTrails, AMasksOutlinesAreMadeOnce) {
  StillSchool scene;
  const auto count = [&] { return scene.trails.outlines_made(); };
  (void)scene.lines(10, trail_of(5));
  EXPECT_EQ(count(), 5);
  (void)scene.lines(10, trail_of(5));
  (void)scene.lines(11, trail_of(5));
  EXPECT_EQ(count(), 6) << "one ping on, one mask more";
  scene.subject.schools[0].owner = std::make_shared<int>(0);
  (void)scene.lines(11, trail_of(5));
  EXPECT_EQ(count(), 11) << "a school that was changed is looked at again";
}

TEST(SchoolTrails, TheShipsTrackLiesOnTheSeaAndBreaksWhereThePlaceIsNotKnown) {
  StillSchool scene;
  const auto track = [&] { return scene.lines(6, {true, false, 0}); };
  const std::vector<SceneLine> whole = track();
  ASSERT_FALSE(whole.empty());
  double length = 0.0;
  for (const SceneLine& line : whole) {
    EXPECT_NEAR(line.from.z, -6.0, 1e-9);
    length += norm(line.to - line.from);
  }
  EXPECT_NEAR(length, 8.0 * (kPings - 1), 0.01);
  EXPECT_LT(norm(Point<Sonar>{whole.front().from.x, whole.front().from.y, 0.0} - Point<Sonar>{-48.0, 0.0, 0.0}), 10.0);
  EXPECT_GT(whole.front().colour.a, whole.back().colour.a) << "what has still to be sailed is paler";
  auto pings = std::make_shared<std::vector<PingNavigation>>(*scene.subject.pings);
  (*pings)[3].heading_deg = std::nan("");
  scene.subject.pings = pings;
  length = 0.0;
  for (const SceneLine& line : track()) length += norm(line.to - line.from);
  EXPECT_NEAR(length, 8.0 * (kPings - 3), 0.01);
  (*pings)[6].transducer.latitude_deg = std::nan("");
  EXPECT_TRUE(track().empty());
}

// By hand: the ship's starboard side 10 degrees down lifts what lies 100 m level to port by 100 sin 10 = 17.4 m.
TEST(SchoolTrails, FollowTheAttitudeWhereBeamsDoNot) {
  const Sector sector(slice_example::radians({-1.0, 0.0, 1.0}), slice_example::radians({269.0, 270.0, 271.0}),
                      {0.0, 1.0, 201});
  auto pings = std::make_shared<std::vector<PingNavigation>>(2);
  for (PingNavigation& ping : *pings) {
    ping.transducer = {60.0, 5.0};
    ping.heading_deg = 0.0;
  }
  (*pings)[0].roll_deg = 10.0;
  const auto mask = std::make_shared<PingMask>(PingMask{{{4, 100, 1}}, {255}});
  TrailSubject subject{pings, true, {{mask, {1, 2, 3, 255}, false, {{0, mask.get()}}}}};
  const auto mean_z = [&] {
    SchoolTrails trails;
    double sum = 0.0;
    const auto lines = trails.lines(sector, subject, 1, (*pings)[1], trail_of(1), light_theme(kSize));
    for (const SceneLine& line : lines) sum += line.from.z / static_cast<double>(lines.size());
    return sum;
  };
  EXPECT_NEAR(mean_z(), 0.0, 0.01);
  subject.beams_stabilised = false;
  EXPECT_NEAR(mean_z(), -100.0 * std::sin(rad_from_deg(10.0)), 0.05);
}

// By hand: fan 4 (30 degrees down) and beam 3 (270) have most voxels; samples 10 to 13 of 5 m reach from 47.5 to 67.5 m.
TEST(MaskSections, GoRoundTheLargestFanAndBeam) {
  const Sector sector = slice_example::hand_sector();
  PingMask mask;
  for (const auto& [fan, beam] : std::vector<std::pair<int, int>>{{3, 3}, {4, 2}, {4, 3}, {4, 4}}) {
    mask.runs.push_back({fan * sector.beams() + beam, 10, 4});
  }
  mask.confidence.assign(16, 255);
  const auto sections = mask_sections(sector, mask);
  ASSERT_EQ(sections.size(), 2U);
  for (const auto& outline : sections) {
    EXPECT_EQ(outline.front(), outline.back());
    std::set<long> ranges;
    for (const Point<Sonar>& place : outline) ranges.insert(std::lround(10.0 * norm(place)));
    EXPECT_EQ(ranges, (std::set<long>{475, 675}));
  }
  double first = 1e9;
  double last = -1e9;
  for (const Point<Sonar>& place : sections[0]) {
    EXPECT_NEAR(place.z, 0.5 * norm(place), 1e-9) << "30 degrees down";
    const double azimuth = wrap_360(deg_from_rad(std::atan2(place.y, place.x)));
    first = std::min(first, azimuth);
    last = std::max(last, azimuth);
  }
  EXPECT_NEAR(first, 255.0, 1e-9);
  EXPECT_NEAR(last, 285.0, 1e-9);
  for (const Point<Sonar>& place : sections[1]) EXPECT_NEAR(place.x, 0.0, 1e-9) << "abeam";
  EXPECT_TRUE(mask_sections(sector, {}).empty());
}

}  // namespace
}  // namespace sonar
