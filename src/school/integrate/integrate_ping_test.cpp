// SPDX-License-Identifier: Apache-2.0
#include "school/integrate/integrate_ping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "base/units.h"
#include "geo/refraction.h"
#include "school/integrate/depth_parts.h"
#include "school/integrate/test_integration.h"

namespace sonar {
namespace {

using Scene = test::IntegratedScene;
using test::kSamples;
using test::kTransducer_m;
using test::sv_db;

/// Of Sv counts: half a step, and the steps of a voxel's mean over many.
constexpr double kStep_db = 0.006;

double whole_volume_m3(const Sector& sector) {
  double volume = 0.0;
  for (int row = 0; row < 500; ++row) {
    for (int s = 0; s < kSamples; ++s) volume += sector.volume_m3(row / 25, row % 25, s);
  }
  return volume;
}

TEST(IntegratePing, homogeneous_water_gives_its_sv_in_every_cell) {
  Scene scene;
  scene.fill([](int, int) { return 1e-7; });
  for (const double channel_m : {5.0, 10.0, 37.0}) {
    CellLayout layout;
    layout.channel_m = channel_m;
    const PingCells cells = scene.integrated(layout);
    double volume = 0.0;
    for (const CellSums& cell : cells.cells) {
      if (cell.heard_m3 > 0.0) {
        EXPECT_NEAR(sv_db(cell), -70.0, kStep_db);
      }
      volume += cell.heard_m3;
      EXPECT_EQ(cell.heard_m3, cell.water_m3);
    }
    // What lies above the first channel is the air over the top fan, half a cell of it at all ranges.
    EXPECT_GT(volume, 0.97 * whole_volume_m3(scene.sector));
    EXPECT_LE(volume, whole_volume_m3(scene.sector) * (1 + 1e-12));
  }
}

TEST(IntegratePing, a_channel_within_the_sector_is_as_high_as_it_is) {
  Scene scene;
  scene.fill([](int, int) { return 1e-7; });
  const PingCells cells = scene.integrated({});
  // 100 to 150 m: the sector reaches from the transducer down to 78 m and more at all of these ranges.
  for (int channel = 1; channel < 7; ++channel) {
    EXPECT_NEAR(cells.at(2, channel).water_m3 / cells.area_m2[2], 10.0, 0.01) << channel;
  }
  // 30 degrees from the stated azimuths' half spacing to either side, 62.5 in all.
  double area = 0.0;
  for (const double of_bin : cells.area_m2) area += of_bin;
  const double reach = scene.sector.range().range_m(kSamples - 0.5);
  EXPECT_NEAR(area, rad_from_deg(62.5) * reach * reach / 2.0, 0.001 * area);
}

TEST(IntegratePing, beams_that_roll_reach_the_depths_they_roll_to) {
  Scene scene;
  scene.fill([](int, int) { return 1e-7; });
  scene.placement.roll_rad = rad_from_deg(-8.0);  // starboard up: a sonar that looks to port looks deeper
  const PingCells rolled = scene.integrated({});
  const PingCells level = [&] {
    scene.placement.roll_rad = 0.0;
    return scene.integrated({});
  }();
  const auto deepest = [](const PingCells& cells) {
    int last = 0;
    for (int channel = 0; channel < cells.channels; ++channel) {
      if (cells.at(4, channel).heard_m3 > 0.0) last = channel;
    }
    return last;
  };
  EXPECT_NE(deepest(rolled), deepest(level));
  for (const CellSums& cell : rolled.cells) {
    if (cell.heard_m3 > 0.0) {
      EXPECT_NEAR(sv_db(cell), -70.0, kStep_db);
    }
  }
}

TEST(IntegratePing, background_is_taken_off_and_tells_noise_and_limit) {
  Scene scene;
  scene.fill([](int, int) { return 3e-9 + 1e-9; });
  scene.background_db.assign(500, -90.0);
  const PingCells cells = scene.integrated({});
  const CellSums& cell = cells.at(2, 3);
  EXPECT_NEAR(sv_db(cell), db_from_linear(3e-9), 0.01);
  EXPECT_NEAR(cell.noise_m2 / cell.heard_m3, 1e-9, 1e-15);
  // Exponential: of one voxel the standard deviation of noise is its mean; half the mean square of what was heard is its
  // variance, here without fading, so of both the ratio is that of the squares.
  EXPECT_NEAR(cell.variance_m4 / cell.noise_m4, 0.5 * 16.0, 0.1);
}

TEST(IntegratePing, faults_and_boundaries_take_no_part_whatever_they_hold) {
  Scene scene;
  scene.fill([](int, int) { return 1e-7; });
  const PingCells sound = scene.integrated({});
  const auto spoil = [&](int row, int sample, SampleFlags flag) {
    const auto s = static_cast<std::size_t>(sample);
    scene.sv.view().row(row)[s] = count_from_linear(1.0);
    scene.flags.view().row(row)[s] = flag;
  };
  for (int s = 300; s < kSamples; s += 3) {
    spoil(230, s, SampleFlags::interference);
    spoil(240, s, SampleFlags::seabed);
  }
  scene.sv.view().row(250)[400] = kNoData;
  const PingCells spoilt = scene.integrated({});
  double water = 0.0;
  double heard = 0.0;
  double before = 0.0;
  for (std::size_t i = 0; i < sound.cells.size(); ++i) {
    if (spoilt.cells[i].heard_m3 > 0.0) {
      EXPECT_NEAR(sv_db(spoilt.cells[i]), -70.0, kStep_db);
    }
    water += spoilt.cells[i].water_m3;
    heard += spoilt.cells[i].heard_m3;
    before += sound.cells[i].water_m3;
  }
  EXPECT_LT(heard, water);
  EXPECT_LT(water, before);
}

TEST(IntegratePing, schools_and_the_rest_are_the_whole) {
  Scene scene;
  scene.fill([](int fan, int sample) { return fan == 9 && sample >= 300 && sample < 350 ? 1e-4 : 1e-8; });
  PingMask school;
  for (int beam = 5; beam < 10; ++beam) school.runs.push_back({9 * 25 + beam, 300, 50});
  school.confidence.assign(250, 255);
  scene.schools = {&school};
  const PingCells cells = scene.integrated({});
  double members = 0.0;
  double school_m2 = 0.0;
  for (const CellSums& cell : cells.cells) {
    members += cell.school_m3;
    school_m2 += cell.school_m2;
  }
  double volume = 0.0;
  for (const sonar::Run& run : school.runs) {
    for (int s = run.first_sample; s < run.end(); ++s) volume += scene.sector.volume_m3(9, run.row % 25, s);
  }
  EXPECT_NEAR(members, volume, 1e-9 * volume);
  EXPECT_NEAR(school_m2, 1e-4 * volume, 0.002 * 1e-4 * volume);
}

TEST(IntegratePing, beyond_the_beam_edge_echo_of_the_seabed_only_schools_count) {
  Scene scene;
  scene.fill([](int fan, int sample) { return fan == 5 && sample >= 400 ? 1e-2 : 1e-8; });
  scene.seabed.heard_sample.assign(500, kSamples);
  for (int beam = 0; beam < 25; ++beam) scene.seabed.heard_sample[static_cast<std::size_t>(5 * 25 + beam)] = 400;
  PingMask school;
  school.runs.push_back({5 * 25 + 3, 400, 20});
  school.confidence.assign(20, 255);
  scene.schools = {&school};
  const PingCells cells = scene.integrated({});
  double loud = 0.0;
  double members = 0.0;
  for (const CellSums& cell : cells.cells) {
    loud += cell.echo_m2 - 1e-8 * cell.heard_m3;
    members += cell.school_m2;
  }
  EXPECT_GT(members, 0.0);
  EXPECT_NEAR(loud / members, 1.0, 0.01);
}

TEST(IntegratePing, a_voxel_counts_in_the_bin_of_its_centre_as_far_as_the_reach) {
  Scene scene;
  scene.fill([](int, int) { return 1e-7; });
  CellLayout layout;
  layout.max_range_m = 120.0;
  const PingCells cells = scene.integrated(layout);
  EXPECT_EQ(cells.bins(), 3);
  double area = 0.0;
  for (const double of_bin : cells.area_m2) area += of_bin;
  EXPECT_NEAR(area, rad_from_deg(62.5) * 120.0 * 120.0 / 2.0, 0.01 * area);
}

/// s_v that a beam hears of a layer of 1e-5 between two depths: its two-way pattern summed over angles, with code of this
/// test's own.
double heard_of_layer(const Scene& scene, int fan, int sample, double from_m, double to_m) {
  const double r = scene.sector.range().range_m(sample);
  const double sigma = rad_from_deg(test::kVerticalWidth_deg) / (4.0 * std::sqrt(std::numbers::ln2));
  double inside = 0.0;
  double whole = 0.0;
  for (int i = -100; i <= 100; ++i) {
    const double off = i * 0.05;
    const double depth = kTransducer_m - r * std::sin(scene.sector.elevation_rad(fan) + off * sigma);
    const double weight = std::exp(-0.5 * off * off);
    whole += weight;
    if (depth >= from_m && depth < to_m) inside += weight;
  }
  return 1e-5 * inside / whole + 1e-15;
}

TEST(IntegratePing, a_layer_of_known_height_comes_back_where_the_beam_is_higher_than_it) {
  for (const double height_m : {3.0, 8.0, 20.0}) {
    Scene scene;
    const double from_m = 50.0;
    scene.fill([&](int fan, int s) { return heard_of_layer(scene, fan, s, from_m, from_m + height_m); });
    CellLayout layout;
    layout.depth_from_m = from_m;
    layout.channel_m = height_m;
    layout.max_channels = 1;
    const PingCells cells = scene.integrated(layout);
    ASSERT_EQ(cells.channels, 1);
    for (int bin = 2; bin < 5; ++bin) {  // from 100 m on beams look at it from above and below
      const CellSums& cell = cells.at(bin, 0);
      const double filling = cell.beam_m3 / cell.heard_m3;
      EXPECT_NEAR(sv_db(cell) - db_from_linear(filling), -50.0, 0.1) << height_m << " m, bin " << bin;
      EXPECT_NEAR(cell.water_m3 / cells.area_m2[static_cast<std::size_t>(bin)], height_m, 0.01 * height_m);
    }
    // Far off, a layer lower than the beam sounds weaker than it is.
    if (height_m < 10.0) {
      EXPECT_LT(sv_db(cells.at(4, 0)), -52.0);
    }
  }
}

TEST(IntegratePing, the_echo_of_a_layer_is_kept_over_all_channels_however_thin) {
  Scene scene;
  scene.fill([&](int fan, int s) { return heard_of_layer(scene, fan, s, 50.0, 55.0); });
  for (const double channel_m : {4.0, 10.0, 25.0}) {
    CellLayout layout;
    layout.channel_m = channel_m;
    const PingCells cells = scene.integrated(layout);
    for (int bin = 3; bin < 5; ++bin) {
      double echo = 0.0;
      for (int channel = 0; channel < cells.channels; ++channel) echo += cells.at(bin, channel).echo_m2;
      EXPECT_NEAR(db_from_linear(echo / cells.area_m2[static_cast<std::size_t>(bin)]), db_from_linear(1e-5 * 5.0), 0.1);
    }
  }
}

/// Depth that sound comes from in water whose speed changes evenly with depth, by gradient 1/s, and is kSpeed_mps at the
/// transducer, where ranges are counted at that speed: the arc of a circle, worked out with this test's own code. Sound
/// leaves at a dip of sine s; with u = artanh(s) - gradient t its sine is tanh u, and by Snell's law its speed is the first
/// one times cosh(artanh s) / cosh u.
constexpr double kSpeed_mps = 1500.0;
double depth_on_arc(double range_m, double elevation_rad, double gradient) {
  const double u = std::atanh(-std::sin(elevation_rad));
  const double then = u - gradient * range_m / kSpeed_mps;
  const double speed = kSpeed_mps * std::cosh(u) / std::cosh(then);
  return kTransducer_m + (speed - kSpeed_mps) / gradient;
}

// A layer from 50 to 58 m in water that gets slower downwards: sound bends by 4 m and more at 250 m. Bent, the layer lies in
// its channel, is as strong as it is, and little of it is heard beside it; straight paths put it elsewhere.
TEST(IntegratePing, where_sound_bends_a_layer_lies_in_its_depth_channel) {
  constexpr double kGradient = -0.25;
  EXPECT_NEAR(depth_on_arc(250.0, -0.2, kGradient), kTransducer_m + 250.0 * std::sin(0.2), 6.0)
      << "not far off straight";
  EXPECT_GT(depth_on_arc(250.0, -0.2, kGradient), kTransducer_m + 250.0 * std::sin(0.2) + 3.0);
  Scene scene;
  const double sigma = rad_from_deg(test::kVerticalWidth_deg) / (4.0 * std::sqrt(std::numbers::ln2));
  scene.fill([&](int fan, int s) {
    const double r = scene.sector.range().range_m(s);
    double inside = 0.0;
    double whole = 0.0;
    for (int i = -60; i <= 60 && r > 1.0; ++i) {
      const double off = i * 0.07;
      const double depth = depth_on_arc(r, scene.sector.elevation_rad(fan) + off * sigma, kGradient);
      const double weight = std::exp(-0.5 * off * off);
      whole += weight;
      if (depth >= 50.0 && depth < 58.0) inside += weight;
    }
    return whole > 0.0 ? 1e-5 * inside / whole + 1e-15 : 1e-15;
  });
  const SoundProfile profile{{0.0, kSpeed_mps - kGradient * kTransducer_m},
                             {400.0, kSpeed_mps + kGradient * (400.0 - kTransducer_m)}};
  CellLayout layout;
  layout.depth_from_m = 50.0;
  layout.channel_m = 8.0;
  layout.max_channels = 1;
  const auto found_db = [&](bool bent, int bin) {
    scene.placement.rays =
        bent ? std::make_shared<const Refraction>(profile, kTransducer_m, kSpeed_mps, 270.0) : nullptr;
    const PingCells cells = scene.integrated(layout);
    const CellSums& cell = cells.at(bin, 0);
    return sv_db(cell) - db_from_linear(cell.beam_m3 / cell.heard_m3);
  };
  for (int bin = 2; bin < 5; ++bin) EXPECT_NEAR(found_db(true, bin), -50.0, 0.1) << bin;
  EXPECT_LT(found_db(false, 4), -50.3) << "straight, what is heard is not where it is looked for";
}

// Law: rays of a profile that bends nothing change nothing; all water is still there in one that bends.
TEST(IntegratePing, bending_keeps_the_water) {
  Scene scene;
  scene.fill([](int, int) { return 1e-7; });
  const auto water = [&](const SoundProfile& profile) {
    scene.placement.rays = profile.empty() ? nullptr : std::make_shared<const Refraction>(profile, 7.0, 1500.0, 270.0);
    const PingCells cells = scene.integrated({});
    double sum = 0.0;
    for (const CellSums& cell : cells.cells) sum += cell.water_m3;
    return std::pair{sum, cells.at(3, 5).water_m3};
  };
  const auto straight = water({});
  const auto even = water({{0.0, 1500.0}});
  const auto bent = water({{0.0, 1505.0}, {40.0, 1480.0}, {200.0, 1483.0}});
  EXPECT_NEAR(even.first / straight.first, 1.0, 1e-4);
  EXPECT_NEAR(even.second / straight.second, 1.0, 1e-3);
  // Near the surface more or less of the uppermost fan is in the air.
  EXPECT_NEAR(bent.first / straight.first, 1.0, 0.03);
}

TEST(TwoWayShare, is_that_of_a_gaussian_beam) {
  // Half the -3 dB width off its axis a two-way beam has a quarter; within that lie 90.3 % (1.665 standard deviations).
  EXPECT_NEAR(two_way_share(-0.05, 0.05, 0.1), 0.9041, 5e-4);
  EXPECT_NEAR(two_way_share(-10.0, 10.0, 0.1), 1.0, 1e-12);
  EXPECT_NEAR(two_way_share(0.0, 10.0, 0.1), 0.5, 1e-12);
  EXPECT_TRUE(std::isnan(two_way_share(0.0, 0.1, std::numeric_limits<double>::quiet_NaN())));
}

}  // namespace
}  // namespace sonar
