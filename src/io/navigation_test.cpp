// SPDX-License-Identifier: Apache-2.0
#include "io/navigation.h"

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
