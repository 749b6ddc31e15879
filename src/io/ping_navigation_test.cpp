// SPDX-License-Identifier: Apache-2.0
#include "io/ping_navigation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/units.h"
#include "geo/geodesic.h"
#include "io/simrad/test_bytes.h"

namespace sonar {
namespace {

using test::kStart;

TimeNs at(double seconds) { return kStart + static_cast<TimeNs>(std::llround(seconds * 1e9)); }

NavSeries series(NavQuantity quantity, std::string talker, std::string sentence, std::vector<NavSample> samples) {
  return {quantity, std::move(talker), std::move(sentence), std::move(samples)};
}

Navigation run(const std::vector<NavSeries>& all, const std::vector<PingMotion>& pings,
               const NavigationParams& params = {}, const SounderConfig& config = {}) {
  std::vector<const NavSeries*> pointers;
  for (const NavSeries& s : all) pointers.push_back(&s);
  return navigate(pointers, pings, config, params);
}

bool has(const Navigation& n, DiagnosticCode code) {
  for (const Diagnostic& note : n.diagnostics) {
    if (note.code == code) return true;
  }
  return false;
}

TEST(Navigation, PositionIsInterpolatedInTime) {
  const auto n = run({series(NavQuantity::position, "GP", "GGA", {{at(0), 60.0, 5.0}, {at(10), 60.001, 5.0}})},
                     {{.time = at(2.5)}});
  EXPECT_NEAR(n.pings[0].transducer.latitude_deg, 60.00025, 1e-9);
  EXPECT_NEAR(n.pings[0].transducer.longitude_deg, 5.0, 1e-9);
  EXPECT_EQ(n.talkers.at("position"), "GP");
}

TEST(Navigation, PositionCrossesTheAntimeridian) {
  const auto n = run({series(NavQuantity::position, "GP", "GGA", {{at(0), 0.0, 179.9999}, {at(10), 0.0, -179.9997}})},
                     {{.time = at(5)}, {.time = at(1)}});
  // 0.0004 degrees along the equator; half of it lies at -179.9999, a quarter of it would be on the line.
  EXPECT_NEAR(n.pings[0].transducer.longitude_deg, -179.9999, 1e-9);
  EXPECT_NEAR(n.pings[1].transducer.longitude_deg, 179.99994, 1e-9);
}

TEST(Navigation, HeadingTakesTheShorterArc) {
  const auto n = run({series(NavQuantity::heading, "IN", "HDT", {{at(0), 350.0, 0}, {at(10), 20.0, 0}})},
                     {{.time = at(5)}, {.time = at(2)}});
  EXPECT_NEAR(n.pings[0].heading_deg, 5.0, 1e-12);
  EXPECT_NEAR(n.pings[1].heading_deg, 356.0, 1e-12);
}

TEST(Navigation, MostFrequentTalkerIsTakenAndNotMixed) {
  const auto gp = series(NavQuantity::heading, "GP", "HDT", {{at(0), 100.0, 0}, {at(9), 100.0, 0}});
  const auto in = series(NavQuantity::heading, "IN", "HDT", {{at(1), 10.0, 0}, {at(4), 10.0, 0}, {at(8), 10.0, 0}});
  const auto compass = series(NavQuantity::heading, "HC", "HDG", std::vector<NavSample>(50, {at(3), 200.0, 0}));
  const auto n = run({gp, in, compass}, {{.time = at(0)}, {.time = at(5)}});
  EXPECT_EQ(n.talkers.at("heading"), "IN");
  EXPECT_EQ(n.pings[0].heading_deg, 10.0);
  EXPECT_EQ(n.pings[1].heading_deg, 10.0);
  NavigationParams wanted;
  wanted.heading_talker = "GP";
  EXPECT_EQ(run({gp, in, compass}, {{.time = at(5)}}, wanted).pings[0].heading_deg, 100.0);
}

TEST(Navigation, HeadingFallsBackToThePingsOwn) {
  const auto n = run({}, {{.time = at(0), .heading_deg = 96.3}, {.time = at(1)}});
  EXPECT_EQ(n.pings[0].heading_deg, 96.3);
  EXPECT_TRUE(std::isnan(n.pings[1].heading_deg));
  EXPECT_EQ(n.talkers.at("heading"), "RAW0");
  EXPECT_TRUE(has(n, DiagnosticCode::no_heading));
}

TEST(Navigation, NothingIsKnownFarFromAnyFix) {
  const auto n = run({series(NavQuantity::position, "GP", "GGA", {{at(0), 60.0, 5.0}, {at(200), 60.0, 5.0}}),
                      series(NavQuantity::heading, "IN", "HDT", {{at(0), 90.0, 0}})},
                     {{.time = at(20)}, {.time = at(100)}, {.time = at(229)}, {.time = at(231)}});
  EXPECT_TRUE(n.pings[0].has_position());
  EXPECT_FALSE(n.pings[1].has_position());
  EXPECT_TRUE(n.pings[2].has_position());
  EXPECT_FALSE(n.pings[3].has_position());
  ASSERT_TRUE(has(n, DiagnosticCode::no_position));
  EXPECT_EQ(n.diagnostics[0].ping_index, 1);
}

TEST(Navigation, PositionGoesOnBeyondTheLastFix) {
  const auto n = run({series(NavQuantity::position, "GP", "GGA", {{at(0), 0.0, 5.0}, {at(10), 0.0, 5.001}})},
                     {{.time = at(15)}, {.time = at(-5)}});
  EXPECT_NEAR(n.pings[0].transducer.longitude_deg, 5.0015, 1e-9);
  EXPECT_NEAR(n.pings[1].transducer.longitude_deg, 4.9995, 1e-9);
}

TEST(Navigation, SpeedOutOfPositions) {
  // 0.001 degrees of longitude on the equator are 111.3195 m; in 10 s, 11.13195 m/s to the east.
  const auto n = run({series(NavQuantity::position, "GP", "GGA", {{at(-20), 0.0, -0.002}, {at(20), 0.0, 0.002}})},
                     {{.time = at(0)}});
  EXPECT_NEAR(n.pings[0].speed_mps, 11.13195, 1e-4);
  EXPECT_NEAR(n.pings[0].course_deg, 90.0, 1e-6);
  EXPECT_EQ(n.talkers.at("speed"), "positions");
}

TEST(Navigation, LeverArmTurnsWithTheShip) {
  // Transducer 10 m ahead of the antenna; the ship heads east.
  NavigationParams params;
  params.lever_arm = LeverArmSource::settings;
  params.lever_arm_x_m = 10.0;
  const std::vector<NavSeries> nav{series(NavQuantity::position, "GP", "GGA", {{at(0), 0.0, 0.0}}),
                                   series(NavQuantity::heading, "IN", "HDT", {{at(0), 90.0, 0}})};
  const auto east = run(nav, {{.time = at(0)}}, params);
  EXPECT_NEAR(east.pings[0].transducer.longitude_deg, 10.0 / 111319.4908, 1e-10);
  EXPECT_NEAR(east.pings[0].transducer.latitude_deg, 0.0, 1e-10);

  // The same out of CON0: antenna 10 m abaft the transducer.
  SounderConfig config;
  config.gps_offset_m = {-10.0, 0.0, 0.0};
  const auto con0 = run(nav, {{.time = at(0)}}, {}, config);
  EXPECT_EQ(con0.pings[0].transducer, east.pings[0].transducer);

  // 30 m below the antenna, bow up 5 degrees: the transducer swings 30 sin 5 m ahead.
  params.lever_arm_x_m = 0.0;
  params.lever_arm_z_m = 30.0;
  const auto pitched = run(nav, {{.time = at(0), .pitch_deg = 5.0}}, params);
  EXPECT_NEAR(pitched.pings[0].transducer.longitude_deg, 30.0 * std::sin(rad_from_deg(5.0)) / 111319.4908, 1e-10);
}

TEST(Navigation, ImpossibleOffsetsAreNotApplied) {
  SounderConfig config;
  config.gps_offset_m = {1e9, 0.0, 0.0};
  const auto n = run({series(NavQuantity::position, "GP", "GGA", {{at(0), 0.0, 0.0}}),
                      series(NavQuantity::heading, "IN", "HDT", {{at(0), 90.0, 0}})},
                     {{.time = at(0)}}, {}, config);
  EXPECT_TRUE(has(n, DiagnosticCode::bad_lever_arm));
  EXPECT_EQ(n.pings[0].transducer, (Geographic{0.0, 0.0}));
}

TEST(Navigation, DepthAndHeave) {
  const PingMotion zero{.time = at(0), .heave_m = 0.5};
  PingMotion stated = zero;
  stated.transducer_depth_m = 3.0;
  NavigationParams params;
  EXPECT_EQ(run({}, {zero}, params).pings[0].transducer_depth_m, 7.0);
  EXPECT_EQ(run({}, {stated}, params).pings[0].transducer_depth_m, 3.0);
  params.heave = HeaveSign::down;
  EXPECT_EQ(run({}, {zero}, params).pings[0].transducer_depth_m, 7.5);
  params.heave = HeaveSign::up;
  EXPECT_EQ(run({}, {zero}, params).pings[0].transducer_depth_m, 6.5);
}

// By hand: 5 m/s north, so 2 s are 10 m, and 4 degrees where the heading turns 2 degrees a second; speed and log as well.
TEST(Navigation, ATimeOffsetMovesThePingsAgainstTheSentences) {
  const std::vector<NavSeries> said{
      series(NavQuantity::position, "GP", "GGA", {{at(0), 60.0, 5.0}, {at(10), 60.0 + 50.0 / 111412.9, 5.0}}),
      series(NavQuantity::heading, "IN", "HDT", {{at(0), 10.0, 0}, {at(10), 30.0, 0}}),
      series(NavQuantity::velocity, "GP", "VTG", {{at(0), 4.0, 0.0}, {at(10), 6.0, 20.0}}),
      series(NavQuantity::log, "SD", "VLW", {{at(0), 100.0, 0}, {at(10), 101.0, 0}})};
  NavigationParams params;
  const PingNavigation recorded = run(said, {{.time = at(5)}}, params).pings[0];
  params.time_offset_s = 2.0;
  const PingNavigation shifted = run(said, {{.time = at(5)}}, params).pings[0];
  EXPECT_EQ(shifted.time, at(7));
  EXPECT_NEAR((shifted.transducer.latitude_deg - recorded.transducer.latitude_deg) * 111412.9, 10.0, 0.01);
  EXPECT_NEAR(shifted.heading_deg - recorded.heading_deg, 4.0, 1e-9);
  EXPECT_NEAR(shifted.speed_mps - recorded.speed_mps, 0.4, 1e-9);
  EXPECT_NEAR(shifted.course_deg - recorded.course_deg, 4.0, 1e-9);
  EXPECT_NEAR(shifted.distance_nmi - recorded.distance_nmi, 0.2, 1e-9);
}

TEST(Navigation, ClockDifferenceIsStoredAndNeverApplied) {
  NavigationParams params;
  params.time_offset_s = 2.0;
  const auto n = run({series(NavQuantity::clock, "GP", "ZDA", {{at(0), -35.0, 0}, {at(10), -36.0, 0}})},
                     {{.time = at(5)}}, params);
  EXPECT_EQ(n.pings[0].time, at(7));
  EXPECT_NEAR(n.pings[0].gps_minus_clock_s, -35.5, 1e-9);
  EXPECT_EQ(n.gps_minus_clock_s, -36.0);  // of two values the lower
}

TEST(Navigation, LogIsInterpolated) {
  const auto n = run({series(NavQuantity::log, "SD", "VLW", {{at(0), 100.0, 0}, {at(600), 101.0, 0}})},
                     {{.time = at(300)}, {.time = at(5000)}});
  EXPECT_NEAR(n.pings[0].distance_nmi, 100.5, 1e-12);
  EXPECT_TRUE(std::isnan(n.pings[1].distance_nmi));
}

/// North at 5 m/s from 60 N, a fix each 3 s; 1 degree of latitude there is 111412.9 m.
NavSeries northwards(int fixes) {
  std::vector<NavSample> samples;
  for (int i = 0; i < fixes; ++i) samples.push_back({at(3.0 * i), 60.0 + 15.0 * i / 111412.9, 5.0});
  return series(NavQuantity::position, "GP", "GGA", std::move(samples));
}

std::int64_t notes_of(const Navigation& n, DiagnosticCode code) {
  return std::count_if(n.diagnostics.begin(), n.diagnostics.end(), [&](const Diagnostic& d) { return d.code == code; });
}

// A law: with the wild fixes the places are those without them.
TEST(Navigation, FixesThatJumpAwayAndBackAreLeftOut) {
  std::vector<PingMotion> pings;
  for (int i = 0; i < 40; ++i) pings.push_back({.time = at(3.0 * i + 1.0), .heading_deg = 10.0});
  const Navigation sound = run({northwards(40)}, pings);
  EXPECT_EQ(notes_of(sound, DiagnosticCode::position_jump), 0);
  // 300 m for one fix, for three fixes, and for two fixes that lie apart from each other as well.
  const std::vector<std::vector<std::size_t>> places{{13}, {20, 21, 22}, {7, 8}, {5, 30}};
  for (const auto& wild : places) {
    NavSeries bad = northwards(40);
    double offset_m = 300.0;
    for (const std::size_t i : wild) {
      bad.samples[i].first += offset_m / 111412.9;
      if (wild.size() == 2) offset_m = -offset_m;
    }
    const Navigation n = run({northwards(0), bad}, pings);
    for (std::size_t i = 0; i < pings.size(); ++i) {
      EXPECT_NEAR(n.pings[i].transducer.latitude_deg, sound.pings[i].transducer.latitude_deg, 1e-9) << i;
      EXPECT_NEAR(n.pings[i].speed_mps, 5.0, 0.01) << i;
    }
    ASSERT_EQ(notes_of(n, DiagnosticCode::position_jump), 1);
    for (const Diagnostic& d : n.diagnostics) {
      if (d.code != DiagnosticCode::position_jump) continue;
      EXPECT_EQ(d.text.find(std::to_string(wild.size()) + " fixes"), 0U) << d.text;
      EXPECT_EQ(d.ping_index, static_cast<std::int64_t>(wild.front()));
    }
    EXPECT_EQ(n.first_jump, 1U);
    NavigationParams fast;
    fast.max_speed_mps = 1000.0;
    EXPECT_EQ(notes_of(run({bad}, pings, fast), DiagnosticCode::position_jump), 0);
  }
}

TEST(Navigation, AShipThatWasMovedKeepsItsFixes) {
  // 40 fixes, then 10 s of nothing and 40 more 5 km away; and back again after two minutes.
  NavSeries moved = northwards(120);
  for (std::size_t i = 40; i < 80; ++i) moved.samples[i].second = 5.09;
  for (std::size_t i = 0; i < moved.samples.size(); ++i) {
    moved.samples[i].time += static_cast<TimeNs>(i / 40) * 10 * kSecondNs;
  }
  std::vector<PingMotion> pings;
  for (const NavSample& fix : moved.samples) pings.push_back({.time = fix.time, .heading_deg = 10.0});
  const Navigation n = run({moved}, pings);
  EXPECT_EQ(notes_of(n, DiagnosticCode::position_jump), 0);
  for (std::size_t i = 0; i < pings.size(); ++i) {
    EXPECT_NEAR(n.pings[i].transducer.latitude_deg, moved.samples[i].first, 1e-12) << i;
    EXPECT_NEAR(n.pings[i].transducer.longitude_deg, moved.samples[i].second, 1e-12) << i;
  }
  // A wild first fix has one neighbour only: the others stay whatever it says.
  NavSeries begin = northwards(40);
  begin.samples[0].first += 300.0 / 111412.9;
  begin.samples[20].first += 300.0 / 111412.9;
  const Navigation b = run({begin}, pings);
  ASSERT_EQ(notes_of(b, DiagnosticCode::position_jump), 1);
  EXPECT_NEAR(b.pings[10].transducer.latitude_deg, begin.samples[10].first, 1e-12);
  EXPECT_NEAR(b.pings[20].transducer.latitude_deg, northwards(40).samples[20].first, 1e-9);
}

TEST(Navigation, CourseStandsForAHeadingThatNobodyGives) {
  // 5 m/s on course 350, drifting with a senseless course from 20 to 40 s, then 5 m/s on course 10.
  const auto rmc = series(NavQuantity::velocity, "GP", "RMC",
                          {{at(0), 5.0, 350.0},
                           {at(10), 5.0, 350.0},
                           {at(20), 0.2, 120.0},
                           {at(30), 0.1, 200.0},
                           {at(40), 5.0, 10.0},
                           {at(50), 0.3, 90.0}});
  const auto fixes = series(NavQuantity::position, "GP", "RMC", {{at(0), 60.0, 5.0}, {at(50), 60.001, 5.0}});
  const std::vector<PingMotion> pings{{.time = at(0)},  {.time = at(10)}, {.time = at(20)},
                                      {.time = at(30)}, {.time = at(40)}, {.time = at(50)}};
  NavigationParams params;
  params.lever_arm = LeverArmSource::settings;
  params.lever_arm_x_m = 10.0;
  const Navigation n = run({fixes, rmc}, pings, params);
  const std::vector<double> wanted{350.0, 350.0, 350.0 + 20.0 / 3.0, 350.0 + 40.0 / 3.0 - 360.0, 10.0};
  for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(n.pings[i].heading_deg, wanted[i], 1e-9) << i;
  EXPECT_TRUE(std::isnan(n.pings[5].heading_deg));  // a drifting ship's last ping lies nobody knows how
  EXPECT_EQ(n.talkers.at("heading"), "course");
  ASSERT_EQ(notes_of(n, DiagnosticCode::heading_from_course), 1);
  EXPECT_EQ(notes_of(n, DiagnosticCode::no_heading), 2);  // of the last ping, and of its lever arm
  // The lever arm turns with it: 10 m on course 350 are 9.848 m to the north.
  EXPECT_NEAR((n.pings[0].transducer.latitude_deg - 60.0) * 111412.9, 10.0 * std::cos(rad_from_deg(10.0)), 0.01);

  NavigationParams off;
  off.heading_from_course = false;
  EXPECT_TRUE(std::isnan(run({fixes, rmc}, pings, off).pings[0].heading_deg));
  EXPECT_EQ(notes_of(run({fixes, rmc}, pings, off), DiagnosticCode::heading_from_course), 0);
  // Sources are not mixed: a compass, or one ping's own heading, is all there is.
  const auto hdt = series(NavQuantity::heading, "IN", "HDT", {{at(0), 77.0, 0}});
  EXPECT_EQ(run({fixes, rmc, hdt}, pings).pings[0].heading_deg, 77.0);
  EXPECT_EQ(notes_of(run({fixes, rmc, hdt}, pings), DiagnosticCode::heading_from_course), 0);
  auto one = pings;
  one[0].heading_deg = 33.0;
  EXPECT_TRUE(std::isnan(run({fixes, rmc}, one).pings[1].heading_deg));
  // Without any speed, the way between the fixes tells it: 111 m to the north in 50 s.
  EXPECT_NEAR(run({fixes}, pings).pings[2].heading_deg, 0.0, 1e-6);
}

TEST(NavSeriesTable, EachSentenceGoesWhereItBelongs) {
  std::vector<NavSeries> all;
  for (const char* text : {"$GPRMC,000010,A,6000.0,N,00500.0,E,5.0,45.0,010120,,", "$GPRMC,000010,V,,,,,,,010120,,",
                           "$PSXN,1,2", "$INHDT,12,T"}) {
    add_sentence(all, *parse_nmea(text), kStart);
  }
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[0].quantity, NavQuantity::position);
  EXPECT_EQ(all[1].quantity, NavQuantity::velocity);
  EXPECT_EQ(all[2].quantity, NavQuantity::clock);
  EXPECT_EQ(all[2].samples.at(0).first, 10.0);
  EXPECT_EQ(all[3].quantity, NavQuantity::heading);
}

TEST(Navigation, TalkersThatSayNothingAreNamed) {
  NavigationParams wanted;
  wanted.heading_talker = "HE";
  wanted.log_talker = "VD";
  const auto n = run({series(NavQuantity::position, "GP", "GGA", {{at(0), 60.0, 5.0}}),
                      series(NavQuantity::heading, "IN", "HDT", {{at(0), 90.0, 0}})},
                     {{.time = at(0), .heading_deg = 12.0}}, wanted);
  int named = 0;
  for (const Diagnostic& note : n.diagnostics) {
    if (note.code != DiagnosticCode::no_talker) continue;
    const bool heading = note.text.find("HE") != std::string::npos;
    const bool log = note.text.find("VD") != std::string::npos;
    named += heading || log ? 1 : 0;
  }
  EXPECT_EQ(named, 2);
  EXPECT_EQ(n.pings[0].heading_deg, 12.0);  // the sample data's own
  wanted.heading_talker = "IN";
  wanted.log_talker = "";
  EXPECT_TRUE(run({series(NavQuantity::position, "GP", "GGA", {{at(0), 60.0, 5.0}}),
                   series(NavQuantity::heading, "IN", "HDT", {{at(0), 90.0, 0}})},
                  {{.time = at(0)}}, wanted)
                  .diagnostics.empty());
}

TEST(Navigation, LeverArmWithoutAHeadingIsNotAppliedAndNoted) {
  NavigationParams params;
  params.lever_arm = LeverArmSource::settings;
  params.lever_arm_x_m = 10.0;
  const std::vector<NavSeries> all{series(NavQuantity::position, "GP", "GGA", {{at(0), 60.0, 5.0}})};
  const auto unmoved = [](const Navigation& n) {
    return std::count_if(n.diagnostics.begin(), n.diagnostics.end(),
                         [](const Diagnostic& d) { return d.text.find("antenna's") != std::string::npos; });
  };
  const auto n = run(all, {{.time = at(0)}}, params);
  EXPECT_EQ(n.pings[0].transducer.latitude_deg, 60.0);
  EXPECT_EQ(unmoved(n), 1);
  EXPECT_EQ(unmoved(run(all, {{.time = at(0), .heading_deg = 90.0}}, params)), 0);
  params.lever_arm_x_m = 0.0;
  EXPECT_EQ(unmoved(run(all, {{.time = at(0)}}, params)), 0);
}

}  // namespace
}  // namespace sonar
