// SPDX-License-Identifier: Apache-2.0
#include "io/mask_outlines.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/units.h"
#include "geo/geodesic.h"
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
