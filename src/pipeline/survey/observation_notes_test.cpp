// SPDX-License-Identifier: Apache-2.0
#include "pipeline/survey/observation_notes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "io/simrad/test_bytes.h"
#include "pipeline/survey/test_opened.h"

namespace sonar {
namespace {

using test::Bytes;
using test::count;
using test::kStart;
using test::opened;

TEST(ObservationNotes, MissingChannelsAreCounted) {
  const test::TemporaryFolder folder;
  Bytes bytes = test::small_file(2);
  for (int k = 2; k < 4; ++k) {
    for (int channel = 1; channel <= 5; ++channel) {
      bytes.add(test::raw0(kStart + k * kSecondNs, {.channel = channel}, {1, 2, 3, 4}));
    }
  }
  folder.write("a.raw", bytes);
  const SurveyFiles survey = opened(folder);
  ASSERT_EQ(survey.observations.size(), 1U);
  const auto& notes = survey.observations[0].diagnostics;
  ASSERT_EQ(count(notes, DiagnosticCode::channels_missing), 1);
  const auto note = std::find_if(notes.begin(), notes.end(),
                                 [](const Diagnostic& d) { return d.code == DiagnosticCode::channels_missing; });
  EXPECT_EQ(note->ping_index, 2);
  EXPECT_EQ(note->text, "2 of 4 pings lack channels, 2 in all, the first here");
}

}  // namespace
}  // namespace sonar
