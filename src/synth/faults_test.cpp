// SPDX-License-Identifier: Apache-2.0
#include "synth/faults.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/units.h"
#include "synth/sonar.h"

namespace sonar::synth {
namespace {

TEST(Faults, StandWhereTheyWerePut) {
  Scene scene = empty_scene(3);
  scene.corrupted_packets = {{1, 260, 500, 100, -110.0}};
  scene.interference = {{1, 900, 3, -120.0, -1}, {2, 900, 3, -120.0, 4}};
  const SyntheticSonar sonar(scene);
  const auto power_db = [&](const Volume& v, int fan, int beam, int sample) {
    return db_from_counts(v.counts(fan, beam, sample));
  };
  const Volume first = sonar.ping(1).power;
  EXPECT_NEAR(power_db(first, 10, 10, 500), -110.0, 0.01);
  EXPECT_NEAR(power_db(first, 10, 10, 599), -110.0, 0.01);
  EXPECT_LT(power_db(first, 10, 10, 600), -200.0);
  EXPECT_LT(power_db(first, 10, 11, 550), -200.0);
  EXPECT_NEAR(power_db(first, 0, 0, 900), -120.0, 0.01);
  EXPECT_NEAR(power_db(first, 19, 24, 902), -120.0, 0.01);
  EXPECT_LT(power_db(first, 19, 24, 903), -200.0);
  const Volume second = sonar.ping(2).power;
  EXPECT_NEAR(power_db(second, 4, 7, 901), -120.0, 0.01);
  EXPECT_LT(power_db(second, 5, 7, 901), -200.0);
}

TEST(Faults, ComeAtTheirRateAndDoubleWithTheNoise) {
  Scene scene = empty_scene(400);
  scene.noise.dropouts = 0.5;
  const Layout layout = make_layout(scene.beams);
  const auto lost_in_all = [&] {
    std::ptrdiff_t lost = 0;
    for (int ping = 0; ping < scene.pings; ++ping) {
      const auto recorded = recorded_rows(layout, scene, ping);
      lost += std::count(recorded.begin(), recorded.end(), false);
    }
    return static_cast<double>(lost) / scene.pings;
  };
  // 0.5 events a ping, 1 to 10 channels each (5.5), for 1 to 3 pings (2).
  EXPECT_NEAR(lost_in_all(), 0.5 * 5.5 * 2.0, 1.2);
  scene.noise.scale = 2.0;
  EXPECT_NEAR(lost_in_all(), 2.0 * 0.5 * 5.5 * 2.0, 2.0);
}

TEST(Faults, ALostChannelHasNoDataInItsRow) {
  Scene scene = empty_scene(20);
  scene.noise.dropouts = 1.0;
  const SyntheticSonar sonar(scene);
  int lost = 0;
  for (int ping = 0; ping < scene.pings; ++ping) {
    const SyntheticPing made = sonar.ping(ping);
    for (int row = 0; row < 500; ++row) {
      if (made.recorded[static_cast<std::size_t>(row)]) continue;
      ++lost;
      EXPECT_EQ(made.power.counts.view().row(row)[100], kNoData);
      EXPECT_EQ(made.power.flags.view().row(row)[100], SampleFlags::dropout);
    }
  }
  EXPECT_GT(lost, 0);
}

}  // namespace
}  // namespace sonar::synth
