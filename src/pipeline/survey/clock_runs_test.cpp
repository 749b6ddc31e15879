// SPDX-License-Identifier: Apache-2.0
#include "pipeline/survey/clock_runs.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "io/simrad/test_bytes.h"
#include "pipeline/survey/test_opened.h"

namespace sonar {
namespace {

using test::Bytes;
using test::count;
using test::kStart;
using test::opened;

// Ten pings a second apart on a ship that sails 5 m/s north; behind the fifth the clock is set back by 3.5 s, so that
// fixes of both clocks bear the same times.
TEST(ClockRuns, PositionsOfTwoClocksDoNotMix) {
  const auto latitude = [](int k) { return 60.0 + 5.0 * k / 111'400.0; };
  const auto fix = [&](int k) {
    return test::with_checksum(
        fmt::format("GPGGA,,60{:08.5f},N,00400.000,E,1,09,1.0,0,M,0,M,,", 60.0 * (latitude(k) - 60.0)));
  };
  const test::TemporaryFolder folder;
  Bytes bytes = test::con0(test::small_ms70());
  for (int k = 0; k < 10; ++k) {
    const TimeNs time = kStart + k * kSecondNs - (k < 5 ? 0 : 7 * kSecondNs / 2);
    bytes.add(test::nme0(time, fix(k))).add(test::small_ping(time));
  }
  folder.write("a.raw", bytes);
  const SurveyFiles survey = opened(folder);
  ASSERT_EQ(survey.observations.size(), 2U);
  for (int o = 0; o < 2; ++o) {
    const ObservationFiles& observation = survey.observations[static_cast<std::size_t>(o)];
    EXPECT_EQ(count(observation.diagnostics, DiagnosticCode::position_jump), 0);
    ASSERT_EQ(observation.navigation.size(), 5U);
    for (int k = 0; k < 5; ++k) {
      const PingNavigation& at = observation.navigation[static_cast<std::size_t>(k)];
      EXPECT_NEAR(at.transducer.latitude_deg, latitude(5 * o + k), 2e-7) << o << " " << k;
    }
  }
}

}  // namespace
}  // namespace sonar
