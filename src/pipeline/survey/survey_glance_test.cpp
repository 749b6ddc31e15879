// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include "io/simrad/test_bytes.h"
#include "pipeline/survey/survey.h"
#include "pipeline/survey/test_opened.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using test::Bytes;
using test::kStart;
using test::opened;

// Three recordings of 40 minutes each, their pings too small to fill what is read of a file's beginning; the third begins
// after a gap.
TEST(Survey, AGlanceTellsTimesPlacesAndRunsOfFiles) {
  const test::TemporaryFolder folder;
  const auto recording = [](TimeNs start) {
    Bytes bytes = test::con0(test::small_ms70(), start);
    const std::vector<std::int16_t> counts(2000, 7);
    for (int i = 0; i < 60; ++i) {
      const TimeNs time = start + i * 40 * kSecondNs;
      bytes.add(test::nme0(time, test::with_checksum("GPGGA,000000,6000.0000,N,00500.0000,E,1,,,,,,,,")));
      for (int channel = 1; channel <= 6; ++channel) bytes.add(test::raw0(time, {.channel = channel}, counts));
    }
    return bytes;
  };
  constexpr TimeNs kLasts = 2400 * kSecondNs;
  folder.write("a.raw", recording(kStart));
  folder.write("b.raw", recording(kStart + kLasts));
  folder.write("c.raw", recording(kStart + 2 * kLasts + 500 * kSecondNs));
  const std::vector<fs::path> paths{folder.path()};
  Work work(2);
  const auto glance = glance_at_survey(paths, {}, {}, work);
  ASSERT_TRUE(glance);
  EXPECT_TRUE(glance->from_ends);
  ASSERT_EQ(glance->observations.size(), 2U);
  EXPECT_EQ(glance->observations[0].name, "a");
  EXPECT_EQ(glance->observations[0].files.size(), 2U);
  EXPECT_EQ(glance->observations[1].name, "c");
  const SurveyFiles whole = opened(folder);  // cut where an hour is full
  const auto first = [](const SurveyFiles& survey) { return survey.observations.front().navigation.front(); };
  const auto last = [](const SurveyFiles& survey) { return survey.observations.back().navigation.back(); };
  EXPECT_EQ(first(*glance).time, first(whole).time);
  EXPECT_EQ(last(*glance).time, last(whole).time);
  EXPECT_TRUE(first(*glance).has_position() && last(*glance).has_position());
  EXPECT_LT(glance->files[0].index.pings.size(), whole.files[0].index.pings.size());
  EXPECT_TRUE(glance->files[0].index.diagnostics.empty());
}

}  // namespace
}  // namespace sonar
