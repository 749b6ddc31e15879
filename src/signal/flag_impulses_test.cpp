// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "signal/flags.h"
#include "signal/test_data.h"
#include "signal/test_schools.h"

namespace sonar {
namespace {

TEST(flag_impulses, are_found_and_school_fronts_are_not) {
  auto ping = noise_ping(kMs70, -125, 50);
  add_school(ping, {200, 0, -20, 40, 25, 15}, -95, 51);
  TestRandom random(52);
  Array3<std::uint8_t> hit(kMs70);
  const auto clean = ping;
  std::size_t hits = 0;
  for (int n = 0; n < 600; ++n) {
    const int f = random.below(20);
    const int b = random.below(25);
    const int s = 10 + random.below(1300);
    const int width = 1 + random.below(3);
    for (int i = 0; i < width; ++i) {
      if (hit(f, b, s + i) == 0) ++hits;
      ping(f, b, s + i) = counts_of_power(1e-5);
      hit(f, b, s + i) = 1;
    }
  }
  for (const bool with_neighbours : {false, true}) {
    Array3<SampleFlags> flags(kMs70);
    const auto before = noise_ping(kMs70, -125, 53);
    NeighbourPings neighbours;
    if (with_neighbours) neighbours = {before.view(), before.view()};
    flag_impulses(ping.view(), neighbours, {}, flags.view());
    std::size_t found = 0;
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < flags.all().size(); ++i) {
      const bool flagged = any(flags.all()[i]);
      found += flagged && hit.all()[i] != 0 ? 1U : 0U;
      wrong += flagged && hit.all()[i] == 0 ? 1U : 0U;
    }
    EXPECT_GT(static_cast<double>(found), 0.9 * static_cast<double>(hits));
    EXPECT_LE(wrong, 8U);
  }
}

TEST(flag_impulses, a_peak_that_the_next_ping_shows_too_is_no_impulse) {
  auto ping = noise_ping({5, 5, 200}, -125, 60);
  ping(2, 2, 100) = counts_of_power(1e-8);
  auto next = noise_ping({5, 5, 200}, -125, 61);
  Array3<SampleFlags> alone(ping.shape());
  flag_impulses(ping.view(), {}, {}, alone.view());
  EXPECT_TRUE(any(alone(2, 2, 100)));
  next(2, 2, 102) = counts_of_power(1e-8);
  Array3<SampleFlags> flags(ping.shape());
  flag_impulses(ping.view(), {.before = {}, .after = next.view()}, {}, flags.view());
  EXPECT_FALSE(any(flags(2, 2, 100)));
}

TEST(flag_impulses, interference_of_the_ping_before_hides_none) {
  auto ping = noise_ping({5, 9, 200}, -125, 62);
  ping(2, 4, 100) = counts_of_power(1e-8);
  auto before = noise_ping({5, 9, 200}, -125, 63);
  for (int beam = 0; beam < 9; ++beam) {
    for (int sample = 99; sample < 103; ++sample) before(2, beam, sample) = counts_of_power(1e-7);
  }
  Array3<SampleFlags> flags(ping.shape());
  flag_impulses(ping.view(), {.before = before.view(), .after = {}}, {}, flags.view());
  EXPECT_TRUE(any(flags(2, 4, 100)));
}

}  // namespace
}  // namespace sonar
