// SPDX-License-Identifier: Apache-2.0
#include "school/seabed/seabed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "base/units.h"
#include "school/beam_axes.h"
#include "school/seabed/seabed_echoes.h"
#include "school/seabed/seabed_hits.h"
#include "school/test_scene.h"
#include "school/test_water.h"

namespace sonar {
namespace {

struct BottomScene {
  BottomScene() : sector(test::grid().sector(test::range_axis())), expected(Shape3{20, 25, 900}) {}

  /// A plane z = depth + slope_y y, seen through the beam's vertical pattern, as loud everywhere.
  void add_bottom(double depth_m, double slope_y = 0.0) {
    add_bottom(depth_m, slope_y, [](double) { return 3e-3; });
  }

  /// A level one by Lambert's law: S_b sin^2 over the height of the beam there, 1 / (sqrt(2 pi) sigma r cos).
  void add_lambert_bottom(double depth_m, double lambert_db) {
    const double sigma = rad_from_deg(test::kVerticalWidth_deg) / (4.0 * std::sqrt(std::numbers::ln2));
    add_bottom(depth_m, 0.0, [=](double r) {
      const double sine = depth_m / r;
      const double height_m = std::sqrt(2.0 * std::numbers::pi) * sigma * r * std::sqrt(1.0 - sine * sine);
      return linear_from_db(lambert_db) * sine * sine / height_m;
    });
  }

  template <class SvAtRange>
  void add_bottom(double depth_m, double slope_y, SvAtRange sv) {
    const double sigma = rad_from_deg(test::kVerticalWidth_deg) / (4.0 * std::sqrt(std::numbers::ln2));
    for (int f = 0; f < 20; ++f) {
      for (int b = 0; b < 25; ++b) {
        for (int s = 40; s < 900; ++s) {
          const double r = sector.range().range_m(s);
          // the elevation where this range meets the plane, by a few steps of a fixed point
          double e = sector.elevation_rad(f);
          bool meets = true;
          for (int k = 0; k < 8 && meets; ++k) {
            const double z = depth_m + slope_y * r * std::cos(e) * std::sin(sector.azimuth_rad(b));
            meets = z > 0.0 && z < r;
            if (meets) e = -std::asin(z / r);
          }
          if (!meets) continue;
          const double off = (e - sector.elevation_rad(f)) / sigma;
          expected(f, b, s) += sv(r) * std::exp(-0.5 * off * off);
        }
      }
    }
  }

  /// How many schools are taken for such in it: none, as there is none.
  [[nodiscard]] std::size_t schools(std::uint64_t seed) const {
    test::Scene scene;
    scene.expected = expected;
    return scene.look(seed).size();
  }

  Seabed look(std::uint64_t seed) {
    flags = test::cropped_flags(expected.shape(), sector);
    const Array3<std::int16_t> sv = test::filtered(test::counts_of(expected, seed), flags);
    return find_seabed(sv.view(), flags.view(), {}, sector, test::grid().vertical_width_deg, {});
  }

  Sector sector;
  Array3<double> expected;
  Array3<SampleFlags> flags;
};

TEST(Seabed, FindsALevelBottom) {
  BottomScene scene;
  scene.add_bottom(150.0);
  const Seabed seabed = scene.look(1);
  ASSERT_TRUE(seabed.found);
  Placement placement;
  placement.transducer_depth_m = 7.0;
  EXPECT_NEAR(bottom_depth_m(seabed, {0.0, -200.0, 50.0}, placement, 0.3, 20.0), 157.0, 5.0);
  EXPECT_TRUE(std::isnan(bottom_depth_m(seabed, {5000.0, 0.0, 0.0}, placement, 0.3, 20.0)));
  EXPECT_EQ(scene.schools(1), 0U);
}

// Each beam once, at the depth that was put in; a school above has no hit, and an echo that the record's end cuts none.
TEST(Seabed, HitsLieOnTheBottom) {
  BottomScene scene;
  scene.add_bottom(150.0);
  for (int b = 5; b < 12; ++b) {
    for (int s = 300; s < 380; ++s) scene.expected(8, b, s) += 1e-3;
  }
  const Seabed seabed = scene.look(1);
  const Array3<std::int16_t> sv = test::filtered(test::counts_of(scene.expected, 1), scene.flags);
  const SeabedParams params;
  const Background background;
  const std::vector<SeabedHit> hits =
      seabed_hits(seabed, {sv.view(), std::as_const(scene.flags).view(), background, scene.sector, params});
  ASSERT_GT(hits.size(), 100U);
  const double se_m = depth_se_m(hits, params);
  std::size_t near = 0;
  double sum_m = 0.0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    EXPECT_TRUE(i == 0 || hits[i - 1].row < hits[i].row) << i;
    EXPECT_NEAR(hits[i].place.z, 150.0, 25.0);
    EXPECT_NEAR(norm(hits[i].place), hits[i].range_m, 1e-9);
    sum_m += hits[i].place.z;
    if (std::abs(hits[i].below_m) <= se_m) ++near;
  }
  EXPECT_NEAR(sum_m / static_cast<double>(hits.size()), 150.0, 3.0);
  EXPECT_NEAR(static_cast<double>(near) / static_cast<double>(hits.size()), 0.6827, 0.01) << "one standard error";
  EXPECT_TRUE(std::isnan(depth_se_m({hits.begin(), hits.begin() + 5}, params)));
  EXPECT_TRUE(
      seabed_hits({}, {sv.view(), std::as_const(scene.flags).view(), background, scene.sector, params}).empty());
}

TEST(Seabed, TwoFansSeeItBeforeTheRecordEnds) {
  BottomScene scene;
  const double end_m = scene.sector.range().range_m(899);
  // the second fan meets it at 0.95 of the range, where no beam is expected to see a plane
  const double depth_m = 0.95 * end_m * -std::sin(scene.sector.elevation_rad(1));
  scene.add_bottom(depth_m);
  const Seabed seabed = scene.look(6);
  ASSERT_TRUE(seabed.found);
  const Point<Sonar> place = Sector::direction(scene.sector.elevation_rad(0), rad_from_deg(270.0)) * (0.9 * end_m);
  EXPECT_NEAR(bottom_depth_m(seabed, place, {}, 0.3, 20.0), depth_m, 8.0);
}

// More beams see echo at one depth than see the seabed; but a seabed there all beams would see.
TEST(Seabed, SchoolsAtOneDepthAreNone) {
  BottomScene scene;
  const double end_m = scene.sector.range().range_m(899);
  const double depth_m = 0.95 * end_m * -std::sin(scene.sector.elevation_rad(1));
  scene.add_bottom(depth_m);
  for (int f = 6; f < 12; ++f) {
    for (int b = 0; b < 25; ++b) {
      const double range_m = 60.0 / -std::sin(scene.sector.elevation_rad(f));
      const int at = static_cast<int>(scene.sector.range().sample_at(range_m));
      for (int s = at - 50; s < at + 50; ++s) scene.expected(f, b, s) += 1e-2;
    }
  }
  const Seabed seabed = scene.look(8);
  ASSERT_TRUE(seabed.found);
  const Point<Sonar> place = Sector::direction(scene.sector.elevation_rad(0), rad_from_deg(270.0)) * (0.9 * end_m);
  EXPECT_NEAR(bottom_depth_m(seabed, place, {}, 0.3, 20.0), depth_m, 8.0);
}

// Mud gives -25 to -40 dB by Lambert's law, rock -10: all of it is seabed as far as it would be taken for fish.
TEST(Seabed, WeakAndStrongBottomsAreFound) {
  for (const double depth_m : {80.0, 150.0, 220.0}) {
    for (const double lambert_db : {-10.0, -20.0, -30.0, -36.0}) {
      BottomScene scene;
      scene.add_lambert_bottom(depth_m, lambert_db);
      const Seabed seabed = scene.look(7);
      ASSERT_TRUE(seabed.found) << depth_m << " " << lambert_db;
      const Point<Sonar> place = Sector::direction(rad_from_deg(-45.0), rad_from_deg(270.0)) * (1.4 * depth_m);
      EXPECT_NEAR(bottom_depth_m(seabed, place, {}, 0.3, 20.0), depth_m, 8.0) << lambert_db;
      EXPECT_EQ(scene.schools(7), 0U) << depth_m << " " << lambert_db;
    }
  }
}

// The tail of the transducer's ringing is long, loud and in all beams; but it begins in the crop, and so rises from
// nothing that is known.
TEST(Seabed, TheRingingBehindTheCropIsNone) {
  BottomScene scene;
  for (int row = 0; row < 500; ++row) {
    for (int s = 0; s < 900; ++s) {
      const double r = scene.sector.range().range_m(s);
      const double sv_db = r < 15.0 ? 0.0 : -35.0 - 1.25 * (r - 15.0);
      scene.expected.view().row(row)[static_cast<std::size_t>(s)] += linear_from_db(sv_db);
    }
  }
  EXPECT_FALSE(scene.look(8).found);
}

// Its echo is as long and loud as the seabed's, and to one side.
TEST(Seabed, ASchoolAboveASmoothBottomDoesNotTiltIt) {
  BottomScene scene;
  scene.add_lambert_bottom(83.0, -30.0);
  for (int f = 3; f < 9; ++f) {
    for (int b = 14; b < 24; ++b) {
      for (int s = 40; s < 900; ++s) {
        const double z = -std::sin(scene.sector.elevation_rad(f)) * scene.sector.range().range_m(s);
        if (z > 66.0 && z < 77.0) scene.expected(f, b, s) += linear_from_db(-38.0);
      }
    }
  }
  const Seabed seabed = scene.look(9);
  ASSERT_TRUE(seabed.found);
  for (const double x : {-60.0, 0.0, 60.0}) {
    EXPECT_NEAR(bottom_depth_m(seabed, {x, -100.0, 0.0}, {}, 0.3, 20.0), 83.0, 3.0) << x;
  }
}

TEST(Seabed, FollowsASlope) {
  BottomScene scene;
  scene.add_bottom(120.0, -0.1);  // deeper to port
  const Seabed seabed = scene.look(2);
  ASSERT_TRUE(seabed.found);
  EXPECT_NEAR(bottom_depth_m(seabed, {0.0, -150.0, 0.0}, {}, 0.3, 20.0), 135.0, 6.0);
}

TEST(Seabed, NoBottomNoSeabed) {
  const Seabed seabed = BottomScene().look(3);
  EXPECT_FALSE(seabed.found);
  EXPECT_TRUE(std::isnan(bottom_depth_m(seabed, {0.0, -100.0, 0.0}, {}, 0.3, 20.0)));
  for (const int first : seabed.first_sample) EXPECT_EQ(first, 900);
}

// A wall that stands on the seabed, 80 m high and 200 m away in a third of the beams: what meets it sees no seabed.
TEST(Seabed, AHillIsSeabedToo) {
  BottomScene scene;
  scene.add_bottom(150.0);
  constexpr double kAway_m = 200.0;
  const double sigma = rad_from_deg(test::kVerticalWidth_deg) / (4.0 * std::sqrt(std::numbers::ln2));
  const double top_rad = -std::atan2(70.0, kAway_m);
  const double foot_rad = -std::atan2(150.0, kAway_m);
  const auto hidden = [&](double elevation_rad) { return elevation_rad > foot_rad && elevation_rad < top_rad; };
  for (int f = 0; f < 20; ++f) {
    for (int b = 8; b < 16; ++b) {
      const double axis_rad = scene.sector.elevation_rad(f);
      for (int s = 40; s < 900; ++s) {
        const double r = scene.sector.range().range_m(s);
        // behind the wall lies its shadow
        if (r > kAway_m && r > 150.0 && hidden(-std::asin(150.0 / r))) scene.expected(f, b, s) = 0.0;
        if (r < kAway_m) continue;
        const double e = -std::acos(kAway_m / r);
        const double off = (e - axis_rad) / sigma;
        if (hidden(e)) scene.expected(f, b, s) += 3e-3 * std::exp(-0.5 * off * off);
      }
    }
  }
  const Seabed seabed = scene.look(9);
  ASSERT_TRUE(seabed.found);
  flag_seabed(seabed, scene.flags.view());
  EXPECT_EQ(scene.schools(9), 0U);
  // Its own beams end at it, those on either side at the seabed.
  const auto ends_m = [&](int fan, int beam) {
    return scene.sector.range().range_m(seabed.first_sample[static_cast<std::size_t>(fan * 25 + beam)]);
  };
  EXPECT_LT(ends_m(9, 12), 220.0);
  EXPECT_GT(ends_m(9, 3), 270.0);
}

TEST(Seabed, ASchoolIsNone) {
  for (const auto& [elevation_deg, sv_db] :
       {std::pair{-40.0, -28.0}, {-30.0, -28.0}, {-15.0, -28.0}, {-40.0, -50.0}, {-30.0, -52.0}, {-25.0, -55.0}}) {
    BottomScene scene;
    test::Ellipsoid e;
    e.centre = Sector::direction(rad_from_deg(elevation_deg), rad_from_deg(270.0)) * 150.0;
    e.half_x = 40.0;
    e.half_y = 25.0;
    e.half_z = 10.0;
    e.sv = linear_from_db(sv_db);
    test::add_ellipsoid(scene.expected, scene.sector, e);
    EXPECT_FALSE(scene.look(4).found) << elevation_deg;
  }
}

TEST(Seabed, ASchoolAboveTheBottomStays) {
  BottomScene scene;
  scene.add_bottom(150.0);
  Array3<double> alone(scene.expected.shape());
  test::Ellipsoid e;
  e.centre = Sector::direction(rad_from_deg(-25.0), rad_from_deg(270.0)) * 150.0;
  e.sv = linear_from_db(-35.0);
  test::add_ellipsoid(alone, scene.sector, e);
  const PingMask truth = test::truth_of(alone);
  for (std::size_t i = 0; i < alone.shape().size(); ++i) scene.expected.all()[i] += alone.all()[i];
  const Seabed seabed = scene.look(5);
  ASSERT_TRUE(seabed.found);
  for (const sonar::Run& run : truth.runs) {
    EXPECT_LE(run.end(), seabed.first_sample[static_cast<std::size_t>(run.row)]);
  }
}

/// An ellipsoid of 60 m, so far above a level seabed of 150 m: how many beams end before they do without it.
int beams_ended(double away_m, double above_m, double sv_db) {
  BottomScene scene;
  scene.add_lambert_bottom(150.0, -25.0);
  const Seabed without = scene.look(10);
  test::Ellipsoid e;
  e.half_x = 30.0;
  e.half_y = 15.0;
  e.half_z = 6.0;
  e.centre = Sector::direction(0.0, rad_from_deg(265.0)) * away_m;
  e.centre.z = 150.0 - above_m - e.half_z;
  e.sv = linear_from_db(sv_db);
  test::add_ellipsoid(scene.expected, scene.sector, e);
  const Seabed seabed = scene.look(10);
  EXPECT_TRUE(without.found && seabed.found);
  int nearer = 0;
  for (std::size_t row = 0; row < 500; ++row) {
    nearer += seabed.first_sample[row] < without.first_sample[row] - 40 ? 1 : 0;
  }
  return nearer;
}

// They are no hills: the beams through them see the seabed behind, those below it farther away; and where a school's echo
// goes over into the beam-edge seabed echo, the seabed is smooth.
TEST(Seabed, SchoolsCloseToTheBottomAreNoHills) {
  for (const double away_m : {180.0, 220.0}) {
    for (const double above_m : {8.0, 14.0, 20.0, 35.0}) {
      for (const double sv_db : {-25.0, -35.0, -45.0}) {
        EXPECT_EQ(beams_ended(away_m, above_m, sv_db), 0) << away_m << " " << above_m << " " << sv_db;
      }
    }
  }
}

TEST(BeamAxes, AreThoseOfTheBeamsToTheLastBit) {
  const Sector sector({-0.9, -0.5, -0.1, 0.2}, {1.1, 1.3, 1.6, 2.0, 2.2}, {0.5, 0.5, 100});
  const BeamAxes axes(sector);
  for (const double lower_rad : {0.0, 0.03, -0.03, 1.2, 0.0}) {
    for (int row = 0; row < sector.fans() * sector.beams(); ++row) {
      const Point<Sonar> a = axes.of(row, lower_rad);
      const Point<Sonar> b = beam_axis(sector, row, lower_rad);
      EXPECT_EQ(a.x, b.x) << row;
      EXPECT_EQ(a.y, b.y) << row;
      EXPECT_EQ(a.z, b.z) << row;
    }
  }
}

}  // namespace
}  // namespace sonar
