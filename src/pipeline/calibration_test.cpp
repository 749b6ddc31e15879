// SPDX-License-Identifier: Apache-2.0
#include "pipeline/calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "io/simrad/test_bytes.h"
#include "pipeline/load_volume.h"

namespace sonar {
namespace {

constexpr double kUnknownGain = std::numeric_limits<double>::quiet_NaN();

/// Six beams whose gain table has a pulse of 2 ms alone, with -1.5 dB of sa correction.
SurveyFiles pinged_with(double pulse_s, float absorption_db_per_m = test::Raw0Spec{}.absorption_db_per_m) {
  const test::TemporaryFolder folder;
  folder.write("a.raw",
               test::small_file(1, test::kStart,
                                {.pulse_s = static_cast<float>(pulse_s), .absorption_db_per_m = absorption_db_per_m}));
  Work work(1);
  const std::vector<std::filesystem::path> paths{folder.path()};
  return open_survey(paths, {}, {}, IndexCache{}, work).value();
}

Diagnostics notes(const SurveyFiles& survey, const CalibrationParams& params = {}) {
  return CalibrationTables(survey.observations.at(0), params).diagnostics();
}

TEST(Calibration, APulseOfTheTableHasItsGainAndNoNote) {
  const SurveyFiles survey = pinged_with(0.002);
  EXPECT_TRUE(notes(survey).empty());
}

TEST(Calibration, AnAbsorptionThatTheFilesDoNotTellIsNoted) {
  CalibrationParams by_formula;
  by_formula.absorption = AbsorptionSource::ainslie_mccolm;
  for (const float none : {0.0F, std::numeric_limits<float>::quiet_NaN()}) {
    const SurveyFiles survey = pinged_with(0.002, none);
    const Diagnostics found = notes(survey);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].code, DiagnosticCode::absorption_computed);
    EXPECT_THAT(found[0].text, testing::HasSubstr("6 of 6 channels"));
    EXPECT_TRUE(notes(survey, by_formula).empty());  // nobody asked the files
  }
}

TEST(Calibration, APulseThatNoTableHasIsNoted) {
  const SurveyFiles survey = pinged_with(0.004);
  const Diagnostics found = notes(survey);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].code, DiagnosticCode::gain_not_matched);
  EXPECT_THAT(found[0].text,
              testing::StartsWith("6 of 6 channels, the first 0: a pulse of 4 ms, the gain table has 2 ms"));
  ChannelPing head;
  head.pulse_length_s = 0.004;
  const ChannelCalibration taken = channel_calibration(survey.observations[0].config.beams[0], head, {}, nullptr);
  EXPECT_EQ(taken.gain_db, 20.0);
  EXPECT_EQ(taken.sa_correction_db, 0.0);
}

// Whoever gives both numbers of a channel needs no table; half of them does not do.
TEST(Calibration, AUsersValuesStandInForTheTable) {
  const SurveyFiles survey = pinged_with(0.004);
  CalibrationParams params;
  for (int channel = 0; channel < 6; ++channel) params.beams.push_back({channel, 21.0, -0.3, 0.0});
  EXPECT_TRUE(notes(survey, params).empty());
  params.beams[4].sa_correction_db = kUnknownGain;
  ASSERT_EQ(notes(survey, params).size(), 1U);
  EXPECT_THAT(notes(survey, params)[0].text, testing::StartsWith("1 of 6 channels, the first 4:"));
}

}  // namespace
}  // namespace sonar
