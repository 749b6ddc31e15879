// SPDX-License-Identifier: Apache-2.0
#include "synth/array/fish_school.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/units.h"

namespace sonar::synth::array {
namespace {

constexpr double kWaveNumber = 390.0;  // 92 kHz

School school_of(FormKind kind, const FishParams& fish = {}) {
  School s(Form(kind, {40.0, 30.0, 16.0}, RandomStream(3, Purpose::school, 0, 1)));
  s.id = 1;
  s.fish_length_cm = 28.0;
  s.per_m3 = 1.0;
  fill_school(s, fish, kWaveNumber, 3, 0);
  return s;
}

// The ellipsoid that fills the box is counted beside each body, on a grid that the school's own probes do not know.
TEST(School, NoKindIsAnEllipsoidAndAllLieInTheirBox) {
  constexpr int kSteps = 48;
  const auto at = [](int i) { return 2.0 * (i + 0.5) / kSteps - 1.0; };
  for (std::size_t k = 0; k < kFormNames.size(); ++k) {
    const School s = school_of(static_cast<FormKind>(k));
    int body = 0;
    int ellipsoid = 0;
    int both = 0;
    for (int n = 0; n < kSteps * kSteps * kSteps; ++n) {
      const double x = at(n % kSteps);
      const double y = at(n / kSteps % kSteps);
      const double z = at(n / kSteps / kSteps);
      const bool in_body = s.form.density({20.0 * x, 15.0 * y, 8.0 * z}) > 0.05;
      const bool in_ellipsoid = x * x + y * y + z * z < 1.0;
      body += in_body ? 1 : 0;
      ellipsoid += in_ellipsoid ? 1 : 0;
      both += in_body && in_ellipsoid ? 1 : 0;
    }
    EXPECT_GT(s.echoes.size(), 300U) << kFormNames[k];
    EXPECT_LT(2.0 * both / (body + ellipsoid), 0.9) << kFormNames[k];
    const double box_m3 = 40.0 * 30.0 * 16.0;
    EXPECT_NEAR(s.volume_m3, box_m3 * body / (kSteps * kSteps * kSteps), 0.02 * box_m3) << kFormNames[k];
    for (const SchoolEcho& e : s.echoes) {
      ASSERT_LE(std::abs(e.at_rest.x), 20.0);
      ASSERT_LE(std::abs(e.at_rest.y), 15.0);
      ASSERT_LE(std::abs(e.at_rest.z), 8.0);
    }
  }
}

TEST(School, ARingIsEmptyInTheMiddleAndAnHourglassParts) {
  const School ring = school_of(FormKind::ring);
  EXPECT_TRUE(std::none_of(ring.echoes.begin(), ring.echoes.end(), [](const SchoolEcho& e) {
    return std::hypot(e.at_rest.x / 20.0, e.at_rest.y / 15.0) < 0.35;
  }));
  const School glass = school_of(FormKind::hourglass);
  const auto length_at = [&](double seconds) {
    double most = 0.0;
    for (const SchoolEcho& e : glass.echoes) most = std::max(most, std::abs(glass.form.place(e.at_rest, seconds).x));
    return 2.0 * most;
  };
  EXPECT_GT(length_at(400.0), length_at(0.0) + 10.0);
}

TEST(School, ManyFishAreGatheredAndKeepTheirSum) {
  FishParams few;
  few.most_echoes = 500;
  const School gathered = school_of(FormKind::vacuolated, few);
  const School apart = school_of(FormKind::vacuolated);
  EXPECT_EQ(apart.together, 1);
  EXPECT_GT(gathered.together, 3);
  EXPECT_LE(gathered.echoes.size(), 500U);
  EXPECT_NEAR(gathered.fish() / apart.fish(), 1.0, 0.01);
  const auto sum = [](const School& s) {
    double m2 = 0.0;
    for (const SchoolEcho& e : s.echoes) m2 += e.broadside_m2;
    return m2;
  };
  EXPECT_NEAR(sum(gathered) / sum(apart), 1.0, 0.01);
}

TEST(Fish, BroadsideIsTheTargetStrengthOfItsLength) {  // 20 log10 30 - 68 = -38.458, by hand
  EXPECT_NEAR(db_from_linear(broadside_m2(FishParams{}, 30.0)), -38.4576, 1e-3);
}

TEST(Fish, AspectIsALineOverAFloor) {
  FishParams p;
  p.any_aspect_share = 0.1;
  p.bladder = 0.25;
  EXPECT_NEAR(aspect(p, kWaveNumber, 30.0, 0.0), 1.0, 1e-9);
  // First null of sin x / x: k l along = pi.
  EXPECT_NEAR(aspect(p, kWaveNumber, 30.0, std::numbers::pi / (kWaveNumber * 0.25 * 0.30)), 0.1, 1e-9);
}

TEST(Fish, TheMeanAspectIsTheMeanOfManyFish) {
  FishParams p;
  const MeanAspect table(p, kWaveNumber, 28.0);
  const double heading = 0.7;
  RandomStream random(9, Purpose::fish);
  for (const double bearing : {0.7, 1.6, 2.27}) {
    const Point<Enu> seen = fish_axis(bearing, -0.35);
    double sum = 0.0;
    constexpr int kFish = 40000;
    for (int i = 0; i < kFish; ++i) {
      const double turned = heading + rad_from_deg(p.heading_sd_deg) * random.normal();
      const Point<Enu> axis = fish_axis(turned, rad_from_deg(p.tilt_sd_deg) * random.normal());
      sum += aspect(p, kWaveNumber, 28.0, axis.x * seen.x + axis.y * seen.y + axis.z * seen.z);
    }
    EXPECT_NEAR(table.at(seen, heading) / (sum / kFish), 1.0, 0.04) << bearing;
  }
}

}  // namespace
}  // namespace sonar::synth::array
