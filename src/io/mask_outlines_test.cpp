// SPDX-License-Identifier: Apache-2.0
#include "io/mask_outlines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "base/units.h"
#include "geo/geodesic.h"
#include "geo/refraction.h"
#include "io/product_example.h"
#include "model/outline.h"

namespace sonar {
namespace {

double area_m2(const GeoArea& area, const Geographic& origin) {
  double sum = 0.0;
  for (const auto& ring : area.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point<Enu> a = to_enu(ring[i], origin);
      const Point<Enu> b = to_enu(ring[(i + 1) % ring.size()], origin);
      sum += (a.x * b.y - b.x * a.y) / 2.0;
    }
  }
  return std::abs(sum);
}

TEST(MapOutlines, OnePingsFootprintAndMaskByHand) {
  for (const Geographic start : {Geographic{60.0, 5.0}, Geographic{60.0, -179.9999}, Geographic{80.0, 20.0}}) {
    ObservationProduct p = example::empty("obs-0001", 1, start);
    example::add_school(p, 1, 0, 0, example::block(2, 1, 2, 20, 10));
    const ObservationOutlines o = map_outlines(p);
    EXPECT_EQ(o.observation, "obs-0001");
    // A sector of 20 degrees. The upper fan has 58 samples, to 114 m; the next, with cos 10 at its upper bound, 60: out
    // to -1 + 2 * 59 + 1 = 118 m along the beam. Chords of 0.05 rad take 0.05^2 / 6 off a sector.
    const double reach_m = 118.0 * std::cos(rad_from_deg(10.0));
    const double sector = 0.5 * reach_m * reach_m * rad_from_deg(20.0);
    EXPECT_NEAR(area_m2(o.swept, start), sector, 2e-3 * sector);
    // Two beams of 5 degrees; samples 20 .. 29: slant 38 .. 58 m, level 38 cos 10 .. 58.
    const double near_m = 38.0 * std::cos(rad_from_deg(10.0));
    const double mask = 0.5 * (58.0 * 58.0 - near_m * near_m) * rad_from_deg(10.0);
    ASSERT_EQ(o.schools.size(), 1U);
    EXPECT_EQ(o.schools[0].school_id, 1);
    EXPECT_NEAR(area_m2(o.schools[0].area, start), mask, 4e-3 * mask);
  }
}

/// By Rodrigues: how a place fixed to the hull (x bow, y starboard, z down) lies once the hull is turned by roll about the
/// bow (starboard down), then by pitch about starboard (bow up), and seen from above with the bow to a heading.
PlanePoint from_above(const Point<Vessel>& p, double roll_rad, double pitch_rad, double heading_rad) {
  const auto about = [](const Point<Vessel>& v, const Point<Vessel>& axis, double angle) {
    const Point<Vessel> cross{axis.y * v.z - axis.z * v.y, axis.z * v.x - axis.x * v.z, axis.x * v.y - axis.y * v.x};
    const double along = axis.x * v.x + axis.y * v.y + axis.z * v.z;
    return v * std::cos(angle) + cross * std::sin(angle) + axis * (along * (1.0 - std::cos(angle)));
  };
  const Point<Vessel> rolled = about(p, {1.0, 0.0, 0.0}, roll_rad);
  const Point<Vessel> turned = about(rolled, {0.0, 1.0, 0.0}, pitch_rad);
  const double bearing = heading_rad + std::atan2(turned.y, turned.x);
  const double level_m = std::hypot(turned.x, turned.y);
  return {level_m * std::sin(bearing), level_m * std::cos(bearing)};
}

std::vector<Ring> in_plane(const GeoArea& area, const Geographic& origin) {
  std::vector<Ring> out;
  for (const auto& ring : area.rings) {
    out.emplace_back();
    for (const Geographic& place : ring) {
      const Point<Enu> at = to_enu(place, origin);
      out.back().push_back({at.x, at.y});
    }
  }
  return out;
}

bool inside(const std::vector<Ring>& area, const PlanePoint& p) {
  bool in = false;
  for (const Ring& ring : area) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const PlanePoint& a = ring[i];
      const PlanePoint& b = ring[(i + 1) % ring.size()];
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) in = !in;
    }
  }
  return in;
}

// Beams fixed to a hull that rolls and pitches: the outline is the shadow of the cells, worked out point by point.
TEST(MapOutlines, OfFixedBeamsTurnWithTheShip) {
  const Geographic start{60.0, 5.0};
  ObservationProduct p = example::empty("obs-0001", 1, start);
  p.pings[0].heading_deg = 30.0;
  example::add_school(p, 1, 0, 0, example::block(0, 1, 2, 20, 10));
  for (const auto& [roll_deg, pitch_deg] : {std::pair{12.0, 0.0}, {-9.0, 6.0}, {0.0, -7.0}}) {
    const double roll = rad_from_deg(roll_deg);
    const double pitch = rad_from_deg(pitch_deg);
    const auto fixed = [&](const PingNavigation& n) {
      Placement placement = n.placement();
      placement.roll_rad = roll;
      placement.pitch_rad = pitch;
      return placement;
    };
    const ObservationOutlines o = map_outlines(p, fixed);
    const auto school = in_plane(o.schools[0].area, start);
    const auto swept = in_plane(o.swept, start);
    // Fan 0 looks 20 to 30 degrees down, beams 1 and 2 to 265 .. 275 degrees, samples 20 .. 29 from 38 to 58 m.
    const auto grown = [](double share, double low, double high) { return low + share * (high - low); };
    std::set<std::pair<int, int>> shadow;  // cells of 0.5 m
    int outside_rings = 0;
    int outside_swept = 0;
    int beside = 0;
    constexpr int kSteps = 32;
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; j <= kSteps; ++j) {
        for (int k = 0; k <= kSteps; ++k) {
          const double e = rad_from_deg(grown(static_cast<double>(i) / kSteps, -30.0, -20.0));
          const double a = rad_from_deg(grown(static_cast<double>(j) / kSteps, 265.0, 275.0));
          const double r = grown(static_cast<double>(k) / kSteps, 38.0, 58.0);
          const Point<Vessel> at{r * std::cos(e) * std::cos(a), r * std::cos(e) * std::sin(a), -r * std::sin(e)};
          const PlanePoint seen = from_above(at, roll, pitch, rad_from_deg(30.0));
          shadow.insert({static_cast<int>(std::floor(2.0 * seen.x)), static_cast<int>(std::floor(2.0 * seen.y))});
          // Chords and the near arc's hull leave 0.03 % of the range: the rim itself is not asked for.
          if (i == 0 || j == 0 || k == 0 || i == kSteps || j == kSteps || k == kSteps) continue;
          outside_rings += inside(school, seen) ? 0 : 1;
          outside_swept += inside(swept, seen) ? 0 : 1;
        }
      }
    }
    for (double x = -70.0; x < 70.0; x += 0.5) {
      for (double y = -70.0; y < 70.0; y += 0.5) {
        if (!inside(school, {x + 0.25, y + 0.25})) continue;
        bool near = false;
        for (const int dx : {-1, 0, 1}) {
          for (const int dy : {-1, 0, 1}) {
            near = near || shadow.contains({static_cast<int>(2.0 * x) + dx, static_cast<int>(2.0 * y) + dy});
          }
        }
        beside += near ? 0 : 1;
      }
    }
    EXPECT_EQ(outside_rings, 0) << roll_deg << " " << pitch_deg;
    EXPECT_EQ(outside_swept, 0) << roll_deg << " " << pitch_deg;
    EXPECT_EQ(beside, 0) << roll_deg << " " << pitch_deg;
    // It is to be seen.
    EXPECT_FALSE(map_outlines(p).schools[0].area == o.schools[0].area);
  }
}

TEST(MapOutlines, AnUnknownAttitudeOfFixedBeamsGivesNone) {
  ObservationProduct p = example::empty("obs-0001", 1);
  example::add_school(p, 1, 0, 0, example::block(0, 1, 2, 20, 10));
  const auto outlined = [&](double roll_rad, double depth_of_rays_m) {
    const auto rays = std::make_shared<const Refraction>(SoundProfile{{0.0, 1500.0}}, depth_of_rays_m, 1500.0, 120.0);
    return map_outlines(p, [&](const PingNavigation& n) {
      Placement placement = n.placement();
      placement.roll_rad = roll_rad;
      placement.rays = rays;
      return placement;
    });
  };
  EXPECT_FALSE(outlined(0.1, 7.0).schools[0].area.rings.empty());
  EXPECT_TRUE(outlined(std::nan(""), 7.0).schools[0].area.rings.empty());
  EXPECT_TRUE(outlined(0.1, std::nan("")).schools[0].area.rings.empty()) << "rays from nowhere";
}

TEST(MapOutlines, PingsWithoutPlaceAreLeftOut) {
  ObservationProduct p = example::empty("obs-0001", 3);
  example::add_school(p, 1, 1, 1, example::block(2, 1, 2, 20, 10));
  for (PingNavigation& n : p.pings) n.transducer.latitude_deg = std::nan("");
  ObservationOutlines o = map_outlines(p);
  EXPECT_TRUE(o.swept.rings.empty());
  EXPECT_TRUE(o.schools[0].area.rings.empty());
  p.grid.reset();
  o = map_outlines(p);
  EXPECT_EQ(o.schools.size(), 1U);
}

}  // namespace
}  // namespace sonar
