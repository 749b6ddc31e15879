// SPDX-License-Identifier: Apache-2.0
#include "synth/array/company.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace sonar::synth::array {
namespace {

Voyage voyage() {
  Voyage v;
  v.pings = 40;
  v.ship.course_deg = 60.0;
  v.ship.yaw_deg = 5.0;
  return v;
}

struct Cloud {
  Point<Enu> in_scene;
  Point<Vessel> on_ship;
  double backscatter_m2 = 0.0;
};

/// Mean place of the first thing of a kind in a ping.
Cloud cloud_of(const Sea& sea, CompanyKind kind, int ping) {
  const View view = view_of(voyage(), ping, 0.0, 0.0);
  Cloud cloud;
  for_each_company(sea, FishParams{}, 390.0, view, 1, 0, ping, 500.0, [&](const CompanyEchoes& thing) {
    if (thing.kind != kind || cloud.backscatter_m2 > 0.0) return;
    Point<Enu> sum;
    for (std::size_t i = 0; i < thing.places.size(); ++i) {
      sum = sum + thing.places[i];
      cloud.backscatter_m2 += thing.echoes[i].expected_m2;
    }
    sum = sum * (1.0 / static_cast<double>(thing.places.size()));
    cloud.in_scene = view.in_scene(sum);
    cloud.on_ship = view.along_ship(sum);
  });
  return cloud;
}

double level(const Point<Enu>& a, const Point<Enu>& b) { return std::hypot(a.x - b.x, a.y - b.y); }

TEST(Company, HullCloudsStayWithTheShip) {
  Sea sea;
  sea.hull.push_back({5.0, 40.0, 6.0, 4.0, 3.0, 1.5, 1e-3, 60.0, 0.0});
  const Cloud first = cloud_of(sea, CompanyKind::hull_bubbles, 0);
  for (const int ping : {7, 20, 33}) {
    const Cloud now = cloud_of(sea, CompanyKind::hull_bubbles, ping);
    // 250 echoes with 4 and 3 m of spread: a mean place is known to 0.25 m; 4 of those.
    EXPECT_NEAR(now.on_ship.x, 5.0, 1.1) << ping;
    EXPECT_NEAR(now.on_ship.y, -40.0, 0.8) << ping;
    // The ship has gone 15.4 m a ping.
    EXPECT_NEAR(level(now.in_scene, first.in_scene), 15.4 * ping, 8.0) << ping;
  }
}

TEST(Company, PlumesStayInTheWaterAndFade) {
  Sea sea;
  const View view = view_of(voyage(), 10, 0.0, 0.0);
  const Point<Enu> there = view.in_scene(view.from_ship(0.0, 120.0, 0.0));
  sea.plumes.push_back({there.x, there.y, 12.0, 3.0, 2.0, 1e-3, -10.0, 80.0});
  const Cloud early = cloud_of(sea, CompanyKind::plume, 6);
  const Cloud late = cloud_of(sea, CompanyKind::plume, 14);
  for (const Cloud& c : {early, late}) {
    EXPECT_LT(level(c.in_scene, there), 2.5);  // 60 echoes over 12 m
    EXPECT_LT(c.in_scene.z, 0.0);
    EXPECT_GT(c.in_scene.z, -5.0);
  }
  EXPECT_GT(std::abs(late.on_ship.x - early.on_ship.x), 80.0);
  // 40 s apart, fading by e in 80 s: exp(-1/2); its growth in the first seconds is over.
  EXPECT_NEAR(late.backscatter_m2 / early.backscatter_m2, std::exp(-0.5), 0.01);
}

TEST(Company, TheSurfacesPatchesAreAlikeForAWhileAndThenNot) {
  ArrayParams params;
  params.waters = Waters::stated;
  Sea sea = make_sea(params, voyage(), 0, 20);
  sea.patches_mps = 0.0;
  const auto likeness = [&](double seconds) {
    double both = 0.0;
    double one = 0.0;
    double other = 0.0;
    for (int i = 0; i < 4000; ++i) {
      const double east = 37.0 * i;
      const double a = sea.surface_patch_db(east, 11.0 * i, 0.0);
      const double b = sea.surface_patch_db(east, 11.0 * i, seconds);
      both += a * b;
      one += a * a;
      other += b * b;
    }
    return both / std::sqrt(one * other);
  };
  // cos of a quarter turn in patches_last_s, by the law that it states; 4000 places.
  EXPECT_NEAR(likeness(sea.patches_last_s / 3.0), std::cos(std::acos(-1.0) / 6.0), 0.1);
  EXPECT_NEAR(likeness(sea.patches_last_s), 0.0, 0.15);
}

TEST(Company, EachSeedAndObservationHasItsOwnWater) {
  ArrayParams params;
  std::map<double, int> depths;
  int without_layers = 0;
  for (int seed = 1; seed <= 40; ++seed) {
    params.seed = seed;
    for (int observation = 0; observation < 3; ++observation) {
      const Company c = company_of(params, observation);
      ++depths[c.seabed_depth_m];
      without_layers += c.layers <= 0.0 ? 1 : 0;
    }
  }
  EXPECT_EQ(depths.size(), 120U);
  // Three of ten: 36 of 120, standard deviation 5.
  EXPECT_GT(without_layers, 16);
  EXPECT_LT(without_layers, 56);
  params.waters = Waters::stated;
  params.company.layers = 0.77;
  EXPECT_EQ(company_of(params, 1).layers, 0.77);
}

}  // namespace
}  // namespace sonar::synth::array
