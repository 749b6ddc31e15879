// SPDX-License-Identifier: Apache-2.0
#include "school/measure/tortuosity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

#include "geo/geodesic.h"
#include "school/test_water.h"

namespace sonar {
namespace {

/// A ping every 5 s; place (metres east and north) by time.
CentreTrack track_of(int pings, const std::function<Point<Enu>(double)>& place, double noise_m = 0.0,
                     std::uint64_t seed = 0) {
  std::vector<SchoolPingRow> rows;
  for (int i = 0; i < pings; ++i) {
    SchoolPingRow row;
    row.ping_index = i;
    row.time_utc = 1'600'000'000 * kSecondNs + i * 5 * kSecondNs;
    const std::uint64_t number = 2 * (seed * 1000 + static_cast<std::uint64_t>(i));
    const Point<Enu> off{noise_m * test::normal(number), noise_m * test::normal(number + 1), 0.0};
    const Geographic at = to_geographic(place(5.0 * i) + off, {60, 4});
    row.latitude = at.latitude_deg;
    row.longitude = at.longitude_deg;
    row.depth_m = 50.0;
    rows.push_back(row);
  }
  return uncut_track(rows);
}

double naive(const CentreTrack& track) {
  const auto& [t, x, y] = track.places;
  double path = 0.0;
  for (std::size_t i = 1; i < t.size(); ++i) path += std::hypot(x[i] - x[i - 1], y[i] - y[i - 1]);
  return path / std::hypot(x.back() - x.front(), y.back() - y.front());
}

TEST(Tortuosity, OfAStraightWayIsOne) {
  const auto found = tortuosity(track_of(40, [](double t) { return Point<Enu>{0.6 * t, 0.8 * t, 0.0}; }), 30.0);
  EXPECT_NEAR(found.ratio, 1.0, 1e-6);
  EXPECT_NEAR(found.se, 0.0, 1e-4);
}

// A right angle between two equal legs: path 2, distance sqrt(2). 60 s a leg, windows of 30 s: the turn is at a border.
TEST(Tortuosity, OfARightAngleIsRootTwo) {
  const auto corner = [](double t) { return t < 60.0 ? Point<Enu>{t, 0.0, 0.0} : Point<Enu>{60.0, t - 60.0, 0.0}; };
  EXPECT_NEAR(tortuosity(track_of(25, corner), 30.0).ratio, std::numbers::sqrt2, 0.01);
}

// Half a circle: pi / 2, of ten chords ten times 2 sin(pi / 20) over 2, 0.4 % less.
TEST(Tortuosity, OfHalfACircleIsHalfPi) {
  const auto circle = [](double t) {
    const double angle = std::numbers::pi * t / 300.0;
    return Point<Enu>{100.0 * std::cos(angle), 100.0 * std::sin(angle), 0.0};
  };
  EXPECT_NEAR(tortuosity(track_of(61, circle), 30.0).ratio, std::numbers::pi / 2.0, 0.03);
}

// Noise of 4 m each way, as the centres of schools have, on a straight way at 1 m/s.
TEST(Tortuosity, NoiseMakesNoWindingWay) {
  constexpr int kTracks = 200;
  double mean = 0.0;
  double of_places = 0.0;
  for (std::uint64_t seed = 0; seed < kTracks; ++seed) {
    const CentreTrack track = track_of(
        41,
        [](double t) {
          return Point<Enu>{0.6 * t, 0.8 * t, 0.0};
        },
        4.0, seed);
    mean += tortuosity(track, 30.0).ratio / kTracks;
    of_places += naive(track) / kTracks;
  }
  EXPECT_GT(of_places, 1.5) << "the path from place to place";
  EXPECT_LT(mean, 1.05);
}

// The share within one standard error of sqrt(2), of right angles seen with noise.
TEST(Tortuosity, ItsErrorIsWhatItSays) {
  constexpr int kTracks = 300;
  const auto corner = [](double t) { return t < 120.0 ? Point<Enu>{t, 0.0, 0.0} : Point<Enu>{120.0, t - 120.0, 0.0}; };
  const double exact = tortuosity(track_of(49, corner), 30.0).ratio;
  int covered = 0;
  for (std::uint64_t seed = 0; seed < kTracks; ++seed) {
    const auto found = tortuosity(track_of(49, corner, 2.0, seed), 30.0);
    if (std::abs(found.ratio - exact) <= found.se) ++covered;
  }
  EXPECT_NEAR(covered / double{kTracks}, 0.68, 0.12);
}

TEST(Tortuosity, UnknownWhereItIsNoFigure) {
  const auto still = [](double) { return Point<Enu>{}; };
  EXPECT_TRUE(std::isnan(tortuosity(track_of(40, still, 4.0), 30.0).ratio)) << "no way at all";
  const auto ahead = [](double t) { return Point<Enu>{t, 0.0, 0.0}; };
  EXPECT_TRUE(std::isnan(tortuosity(track_of(11, ahead), 30.0).ratio)) << "one window";
  EXPECT_TRUE(std::isnan(tortuosity(track_of(40, ahead), 10.0).ratio)) << "two places a window";
  EXPECT_TRUE(std::isnan(tortuosity(CentreTrack{}, 30.0).ratio));
  CentreTrack stopped = track_of(40, ahead);
  for (std::size_t i = 0; i < 8; ++i) stopped.places.t[i] = 0.0;
  EXPECT_TRUE(std::isnan(tortuosity(stopped, 30.0).ratio)) << "a clock that stood still for the first window";
}

}  // namespace
}  // namespace sonar
