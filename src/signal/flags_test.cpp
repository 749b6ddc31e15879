// SPDX-License-Identifier: Apache-2.0
#include "signal/flags.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/describe.h"
#include "base/units.h"
#include "signal/test_data.h"
#include "signal/test_schools.h"

namespace sonar {
namespace {

// By hand: sample i lies at -0.755 + 0.3776 i; 15 m is reached at i = 41.72.
TEST(flags, near_field_ends_at_its_range) {
  Array3<SampleFlags> flags({2, 3, 100});
  flag_near_field(ms70_geometry(), {}, flags.view());
  EXPECT_EQ(count_flag(flags, SampleFlags::near_field), 6U * 42U);
  EXPECT_TRUE(any(flags(1, 2, 41)));
  EXPECT_FALSE(any(flags(1, 2, 42)));
}

TEST(flags, surface_mode_fan_takes_the_top_fan_wherever_it_stands) {
  auto geometry = ms70_geometry();
  std::swap(geometry.elevation_deg[3], geometry.elevation_deg[19]);
  Array3<SampleFlags> flags(kMs70);
  flag_surface(geometry, {.enabled = true, .mode = SurfaceMode::fan, .fans = 1, .margin_m = 2.0}, flags.view());
  EXPECT_EQ(count_flag(flags, SampleFlags::surface), 25U * 1320U);
  EXPECT_TRUE(any(flags(3, 0, 0)));
}

// By hand: the top fan's upper edge rises 3.5 degrees; 7 m deep less 2 m: 5 / sin(3.5 deg) = 81.90 m, sample 218.9.
// The next fan's edge rises 1.132 deg: 5 / sin = 253.1 m, sample 672.4; the third looks down.
TEST(flags, surface_mode_edge_keeps_upper_fans_near_the_ship) {
  Array3<SampleFlags> flags(kMs70);
  flag_surface(ms70_geometry(), {}, flags.view());
  EXPECT_FALSE(any(flags(19, 7, 218)));
  EXPECT_TRUE(any(flags(19, 7, 219)));
  EXPECT_FALSE(any(flags(18, 7, 672)));
  EXPECT_TRUE(any(flags(18, 7, 673)));
  EXPECT_EQ(count_flag(flags, SampleFlags::surface), 25U * (1320U - 219U) + 25U * (1320U - 673U));
}

// A hull that rolls turns one beam 5 degrees further up than the other: by hand, r = (7 - 2) / sin(e + w / 2).
TEST(flags, surface_follows_beams_that_roll_with_the_hull) {
  PingGeometry geometry = ms70_geometry();
  const Shape3 shape{20, 2, 1320};
  geometry.vertical_width_deg.assign(40, 7.0);
  for (int row = 0; row < 40; ++row) {
    geometry.level_elevation_deg.push_back(geometry.elevation_deg[static_cast<std::size_t>(row / 2)] +
                                           (row % 2 == 0 ? 5.0 : 0.0));
  }
  Array3<SampleFlags> flags(shape);
  flag_surface(geometry, {}, flags.view());
  const auto first_of = [&](int fan, int beam) {
    const auto row = flags.view().row(fan, beam);
    return std::find(row.begin(), row.end(), SampleFlags::surface) - row.begin();
  };
  const auto by_hand = [&](double elevation_deg) {
    const double range_m = 5.0 / std::sin(rad_from_deg(elevation_deg + 3.5));
    return std::min(1320.0, std::ceil((range_m - geometry.first_range_m) / kSpacing_m));
  };
  EXPECT_NEAR(static_cast<double>(first_of(19, 0)), by_hand(5.0), 1.0);
  EXPECT_NEAR(static_cast<double>(first_of(19, 1)), by_hand(0.0), 1.0);
  EXPECT_NEAR(static_cast<double>(first_of(17, 0)), by_hand(5.0 - 2.0 * 45.0 / 19.0), 1.0);
  EXPECT_EQ(first_of(17, 1), 1320);
  geometry.level_elevation_deg.pop_back();  // of no such ping
  Array3<SampleFlags> none(shape);
  flag_surface(geometry, {}, none.view());
  EXPECT_EQ(std::count(none.all().begin(), none.all().end(), SampleFlags::surface), 0);
}

// A sonar 7 m deep that looks 30 degrees up meets the water line at 14 m. What lies above is air under any parameters.
TEST(flags, no_parameters_make_air_into_water) {
  PingGeometry geometry;
  geometry.first_range_m = 0.0;
  geometry.spacing_m = 1.0;
  geometry.transducer_depth_m = 7.0;
  geometry.elevation_deg = {-30.0, 0.0, 30.0};
  for (const SurfaceParams& params :
       {SurfaceParams{.enabled = false}, SurfaceParams{.mode = SurfaceMode::fan, .fans = 0}}) {
    Array3<SampleFlags> flags({3, 2, 40});
    flag_surface(geometry, params, flags.view());
    EXPECT_EQ(count_flag(flags, SampleFlags::surface), 2U * 25U);
    EXPECT_FALSE(any(flags(2, 1, 14)));  // on the line
    EXPECT_TRUE(any(flags(2, 1, 15)));
  }
}

TEST(flags, unknown_geometry_leaves_the_surface_alone) {
  Array3<SampleFlags> flags({1, 1, 10});
  flag_surface({}, {}, flags.view());
  flag_surface({.first_range_m = 0,
                .spacing_m = 1,
                .transducer_depth_m = 5,
                .elevation_deg = {std::numeric_limits<double>::quiet_NaN()},
                .vertical_width_deg = {},
                .level_elevation_deg = {}},
               {}, flags.view());
  flag_near_field({}, {}, flags.view());
  EXPECT_EQ(count_flag(flags, kNotFiltered), 0U);
}

TEST(flags, dropouts_constant_and_repeated_stretches) {
  auto ping = noise_ping({3, 4, 500}, -120, 1);
  for (int s = 100; s < 200; ++s) ping(1, 2, s) = -9000;
  for (int s = 300; s < 400; ++s) ping(2, 2, s) = ping(2, 1, s);
  for (int s = 250; s < 290; ++s) ping(0, 3, s) = -9000;  // too short
  for (int s = 480; s < 500; ++s) ping(0, 0, s) = kNoData;
  Array3<SampleFlags> flags(ping.shape());
  flag_dropouts(ping.view(), {}, flags.view());
  EXPECT_NEAR(static_cast<double>(count_flag(flags, SampleFlags::dropout)), 220.0, 3.0);
  EXPECT_TRUE(any(flags(1, 2, 150)) && any(flags(2, 2, 350)) && any(flags(0, 0, 499)));
}

TEST(flags, noise_of_unequal_beams_holds_no_fault) {
  for (const double level_db : {-160.0, -120.0, -20.0}) {
    auto ping = noise_ping(kMs70, level_db, 2);
    tilt_beams(ping);
    EXPECT_EQ(faults(ping, SampleFlags::corrupted | SampleFlags::interference | SampleFlags::dropout), 0U);
    EXPECT_LE(faults(ping, SampleFlags::impulse), 10U);
  }
}

TEST(flags, a_permanently_noisy_beam_is_not_corrupted_packets) {
  auto ping = noise_ping(kMs70, -130, 3);
  const auto louder = static_cast<std::int16_t>(counts_from_db(14.0));
  for (auto& v : ping.row(9, 9)) v = static_cast<std::int16_t>(v + louder);
  EXPECT_EQ(faults(ping, SampleFlags::corrupted), 0U);
}

TEST(flags, hot_stretches_are_found_with_their_ends) {
  auto ping = noise_ping(kMs70, -125, 4);
  tilt_beams(ping);
  add_school(ping, {200, 0, -20, 40, 25, 15}, -100, 5);
  TestRandom random(6);
  struct Hot {
    int fan, beam, begin, end;
  };
  // One in open water, one through the school, one at the end of the data, one at a corner of the grid, a whole beam.
  for (const Hot& hot :
       {Hot{3, 4, 300, 500}, {10, 12, 400, 700}, {15, 20, 1100, 1320}, {0, 0, 500, 700}, {5, 9, 0, 1320}}) {
    for (int s = hot.begin; s < hot.end; ++s) add_power(ping(hot.fan, hot.beam, s), -70, random);
    Array3<SampleFlags> flags(kMs70);
    flag_corrupted_packets(ping.view(), {}, flags.view());
    int missed = 0;
    int beyond = 0;
    for (int s = 0; s < kMs70.samples; ++s) {
      const bool is_hot = s >= hot.begin && s < hot.end;
      const bool flagged = any(flags(hot.fan, hot.beam, s) & SampleFlags::corrupted);
      missed += is_hot && !flagged ? 1 : 0;
      beyond += !is_hot && flagged ? 1 : 0;
    }
    EXPECT_LE(missed, 2) << hot.fan;
    EXPECT_LE(beyond, 6) << hot.fan;
  }
  Array3<SampleFlags> flags(kMs70);
  flag_corrupted_packets(ping.view(), {}, flags.view());
  EXPECT_LE(count_flag(flags, SampleFlags::corrupted), 200U + 300U + 220U + 200U + 1320U + 30U);
}

TEST(flags, interference_is_found_in_all_fans_and_in_one) {
  for (const int thickness : {2, 3, 6, 12}) {
    auto ping = noise_ping(kMs70, -125, 7);
    tilt_beams(ping);
    add_school(ping, {200, 0, -20, 60, 30, 25}, -95, 8);
    TestRandom random(9);
    // Through the school's middle (sample 530), in open water, and one in fan 4 alone.
    for (int f = 0; f < kMs70.fans; ++f) {
      for (int b = 0; b < kMs70.beams; ++b) {
        for (int n = 0; n < thickness; ++n) {
          add_power(ping(f, b, 520 + n), -75, random);
          add_power(ping(f, b, 900 + n), -90, random);
          if (f == 4) add_power(ping(f, b, 1100 + n), -90, random);
        }
      }
    }
    Array3<SampleFlags> flags(kMs70);
    flag_interference(ping.view(), {}, flags.view());
    for (int f = 0; f < kMs70.fans; ++f) {
      for (int n = 0; n < thickness; ++n) {
        EXPECT_TRUE(any(flags(f, 12, 520 + n))) << f << ' ' << thickness;
        EXPECT_TRUE(any(flags(f, 3, 900 + n))) << f << ' ' << thickness;
      }
    }
    EXPECT_TRUE(any(flags(4, 20, 1100)));
    const auto wall = static_cast<std::size_t>(thickness);
    EXPECT_LE(count_flag(flags, SampleFlags::interference), 2 * 500 * (wall + 3) + 25 * (wall + 3));
  }
}

// No school is interference or a beam with corrupted packets, however big or near: spheres, flat and long ones, some wider than the sector.
TEST(flags, schools_are_no_faults) {
  const Ellipsoid bodies[] = {{30, 0, -20, 25, 5, 15},   {40, 0, -22, 60, 4, 30},   {60, 0, -25, 100, 20, 60},
                              {25, 0, -20, 100, 2, 100}, {150, 10, -10, 12, 80, 6}, {400, -20, -5, 8, 60, 8},
                              {80, 0, -20, 200, 3, 5},   {300, 0, -3, 150, 40, 20}, {100, 0, -40, 60, 60, 3},
                              {50, 5, -15, 6, 40, 6}};
  std::uint64_t seed = 10;
  for (const Ellipsoid& body : bodies) {
    const auto echo = echo_of(body, kMs70);
    for (const double level_db : {-108.0, -65.0}) {
      auto ping = noise_ping(kMs70, -125, ++seed);
      tilt_beams(ping);
      const auto before = ping;
      add_echo(ping, echo, level_db, ++seed);
      Array3<SampleFlags> flags(kMs70);
      flag_ping(ping.view(), {}, {}, {}, flags.view());
      std::size_t members = 0;
      for (std::size_t i = 0; i < ping.all().size(); ++i) members += ping.all()[i] != before.all()[i] ? 1U : 0U;
      const std::size_t lost = count_flag(flags, kFault);
      EXPECT_LE(lost, 12U + members / 1000) << body.range_m << " m, " << level_db << " dB, of " << members << ", hot "
                                            << count_flag(flags, SampleFlags::corrupted) << ", interference "
                                            << count_flag(flags, SampleFlags::interference);
    }
  }
}

// A flat seabed meets every beam of a fan at one range, D / sin(tilt), smeared by a 7 degree beam.
TEST(flags, margins_round_faults_are_parameters) {
  auto ping = noise_ping(kMs70, -125, 17);
  TestRandom random(18);
  for (int f = 0; f < kMs70.fans; ++f) {
    for (int b = 0; b < kMs70.beams; ++b) {
      for (int n = 0; n < 6; ++n) add_power(ping(f, b, 900 + n), -80, random);
    }
  }
  const auto flagged = [&](int margin_samples) {
    InterferenceParams params;
    params.margin_samples = margin_samples;
    Array3<SampleFlags> flags(kMs70);
    flag_interference(ping.view(), params, flags.view());
    std::vector<int> samples;
    for (int s = 0; s < kMs70.samples; ++s) {
      if (any(flags(7, 12, s))) samples.push_back(s);
    }
    return samples;
  };
  EXPECT_EQ(flagged(0), (std::vector<int>{900, 901, 902, 903, 904, 905}));
  EXPECT_EQ(flagged(2).front(), 898);
  EXPECT_EQ(flagged(2).back(), 907);
}

TEST(flags, the_seabed_is_no_interference) {
  for (const double depth_m : {25.0, 50.0, 100.0, 200.0}) {
    auto ping = noise_ping(kMs70, -125, 40);
    TestRandom random(41);
    for (int f = 0; f < kMs70.fans; ++f) {
      const double tilt_deg = 45.0 - f * 45.0 / 19.0;
      for (int s = 1; s < kMs70.samples; ++s) {
        const double range_m = s * kSpacing_m;
        if (depth_m >= range_m) continue;
        const double angle_deg = deg_from_rad(std::asin(depth_m / range_m)) - tilt_deg;
        const double echo_db = -60.0 - 30.0 * std::log10(range_m / 100.0) - 2 * 12.0 * std::pow(angle_deg / 7.0, 2);
        if (echo_db < -140.0) continue;
        for (int b = 0; b < kMs70.beams; ++b) add_power(ping(f, b, s), echo_db, random);
      }
    }
    EXPECT_EQ(faults(ping, SampleFlags::interference), 0U) << depth_m;
    EXPECT_EQ(faults(ping, SampleFlags::corrupted), 0U) << depth_m;
  }
}

TEST(flags, any_size_is_taken) {
  for (const Shape3 shape : {Shape3{0, 0, 0},
                             Shape3{1, 1, 1},
                             {1, 1, 5},
                             {1, 1, 3000},
                             {1, 12, 7},
                             {3, 1, 64},
                             {1, 30, 900},
                             {2, 9, 13},
                             {60, 40, 20}}) {
    const auto ping = noise_ping(shape, -125, 70);
    Array3<SampleFlags> flags(shape);
    PingGeometry geometry{.first_range_m = 0,
                          .spacing_m = 0.4,
                          .transducer_depth_m = 7,
                          .elevation_deg = {},
                          .vertical_width_deg = {},
                          .level_elevation_deg = {}};
    geometry.elevation_deg.assign(static_cast<std::size_t>(shape.fans), -10.0);
    flag_ping(ping.view(), geometry, {}, {ping.view(), ping.view()}, flags.view());
    EXPECT_EQ(count_flag(flags, kFault), 0U);
  }
}

TEST(flags, each_has_its_switch_and_its_parameters_are_checked) {
  FlagParams off;
  off.near_field.enabled = off.surface.enabled = off.dropouts.enabled = false;
  off.corrupted_packets.enabled = off.interference.enabled = off.impulse_noise.enabled = false;
  auto ping = noise_ping({4, 9, 400}, -125, 80);
  for (auto& v : ping.row(2, 3)) v = 0;
  Array3<SampleFlags> flags(ping.shape());
  PingGeometry geometry = ms70_geometry();
  geometry.elevation_deg.resize(4, 5.0);
  flag_ping(ping.view(), geometry, off, {}, flags.view());
  EXPECT_EQ(count_flag(flags, kNotFiltered), 0U);
  EXPECT_TRUE(validate(FlagParams{}).has_value());
  FlagParams bad;
  bad.interference.beam_fraction = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(validate(bad).has_value());
}

}  // namespace
}  // namespace sonar
