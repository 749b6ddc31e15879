// SPDX-License-Identifier: Apache-2.0
#include "pipeline/survey/calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "io/simrad/test_bytes.h"
#include "model/beam_angles.h"
#include "pipeline/stages/load_volume.h"
#include "pipeline/survey/beam_figures.h"

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
              testing::StartsWith("6 of 6 channels, the first 0: the pulse is 4 ms, the gain table has 2 ms"));
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

BeamConfig beam_of(double psi_db, double along_deg, double athwart_deg) {
  BeamConfig beam;
  beam.equivalent_beam_angle_db = psi_db;
  beam.width_alongship_deg = along_deg;
  beam.width_athwartship_deg = athwart_deg;
  return beam;
}

// Fan 0, beam 12 of a recorded MS70. By hand: the widths give 10 log10(pi / (8 ln 2) x 6.994 x 2.709 (pi / 180)^2) = -24.855.
TEST(Calibration, TheBeamAngleIsTheOneThatTheRecipeChooses) {
  const BeamConfig beam = beam_of(-18.83, 6.994, 2.709);
  BeamCalibration user;
  user.psi_db = -20.0;
  CalibrationParams params;
  EXPECT_EQ(psi_db_of(beam, params, &user), -18.83) << "a table's angle is used where it is chosen";
  params.psi = PsiSource::table;
  EXPECT_EQ(psi_db_of(beam, params, &user), -20.0);
  EXPECT_EQ(psi_db_of(beam, params, nullptr), -18.83);
  params.psi = PsiSource::from_widths;
  EXPECT_NEAR(psi_db_of(beam, params, &user), -24.855, 1e-3);
  user.width_along_deg = 2.0 * 6.994;  // twice as wide: 3.010 dB more
  EXPECT_NEAR(psi_db_of(beam, params, &user), -21.845, 1e-3);
  EXPECT_TRUE(std::isnan(psi_db_of(beam_of(-18.83, 0.0, 2.709), params, nullptr)));
}

// Echo goes as 1 / psi: under the stated angle it is 6.025 dB below what the widths make of it.
TEST(Calibration, TheErrorIsThatAgainstTheOtherReading) {
  SounderConfig config;
  config.beams = {beam_of(-18.83, 6.994, 2.709)};
  BeamGrid grid;
  grid.elevation_deg = {-45.0};
  grid.azimuth_deg = {270.0};
  grid.channel = {0};
  grid.vertical_width_deg = {6.994};
  grid.horizontal_width_deg = {2.709};
  CalibrationParams params;
  EXPECT_NEAR(beam_figures(config, grid, params).psi_error_db.at(0), -6.025, 1e-3);
  EXPECT_TRUE(std::isnan(beam_figures(config, grid, params).calibration_se_db.at(0)));
  params.psi = PsiSource::from_widths;
  EXPECT_NEAR(beam_figures(config, grid, params).psi_error_db.at(0), 6.025, 1e-3);
  params.psi = PsiSource::table;
  BeamCalibration user;
  user.psi_db = -24.0;
  user.gain_db_se = 0.2;
  user.sa_correction_db_se = 0.1;
  user.psi_db_se = 0.3;
  user.width_along_deg = 7.5;
  params.beams = {user};
  const BeamFigures figures = beam_figures(config, grid, params);
  EXPECT_NEAR(figures.psi_error_db.at(0), -0.855, 1e-3);
  EXPECT_NEAR(figures.calibration_se_db.at(0), std::sqrt(0.16 + 0.04 + 0.09), 1e-12) << "gain and sa count twice";
  EXPECT_EQ(calibrated_grid(grid, params).vertical_width_deg.at(0), 7.5);
}

// 1.5 dB may be a wide transmit beam, 5 dB is beyond the 3.5 dB that any makes of it.
TEST(Calibration, ImpossibleBeamAnglesAreNoted) {
  SurveyFiles survey = pinged_with(0.002);
  BeamGrid& grid = *survey.observations.at(0).grid;
  grid.vertical_width_deg.assign(grid.channel.size(), 7.0);
  grid.horizontal_width_deg.assign(grid.channel.size(), 3.0);
  for (std::size_t row = 0; row < grid.channel.size(); ++row) {
    grid.psi_stated_db[row] = psi_from_widths_db(grid)[row] + (row == 2 ? 5.0 : 1.5);
  }
  const Diagnostics found = notes(survey);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].code, DiagnosticCode::psi_against_widths);
  EXPECT_THAT(found[0].text, testing::HasSubstr("in 1 of 6 beams"));
  CalibrationParams by_widths;
  by_widths.psi = PsiSource::from_widths;
  EXPECT_TRUE(notes(survey, by_widths).empty());
}

}  // namespace
}  // namespace sonar
