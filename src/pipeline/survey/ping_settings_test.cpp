// SPDX-License-Identifier: Apache-2.0
// What pings say of themselves (sound speed, transmit mode, attitude, beam azimuths), and what becomes of it.
#include "pipeline/survey/survey.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "io/simrad/test_bytes.h"
#include "pipeline/survey/test_opened.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using test::Bytes;
using test::count;
using test::kStart;
using test::opened;

TEST(PingSettings, ARollingShipUnderAnUnknownSounderIsNoted) {
  const auto noted = [](const std::string& sounder, float roll_deg, bool stabilised) {
    const test::TemporaryFolder folder;
    test::Con0Spec beams = test::small_ms70();
    beams.sounder = sounder;
    folder.write("a.raw", test::con0(beams).add(test::small_ping(kStart, {.roll_deg = roll_deg})));
    NavigationParams navigation;
    navigation.beams_stabilised = stabilised;
    Work work(1);
    const std::vector<fs::path> paths{folder.path()};
    const auto survey = open_survey(paths, {}, navigation, IndexCache{}, work);
    return survey && count(survey->observations.at(0).diagnostics, DiagnosticCode::attitude_unused) == 1;
  };
  EXPECT_TRUE(noted("XYZ", 4.0F, true));
  EXPECT_FALSE(noted("XYZ", 1.0F, true));
  EXPECT_FALSE(noted("XYZ", 4.0F, false));
  EXPECT_FALSE(noted("MBS", 4.0F, true));
}

// No description of the format says which way the azimuths of a sonar count that looks to starboard.
TEST(PingSettings, BeamAzimuthsCountAsTheSettingSays) {
  const test::TemporaryFolder folder;
  test::Con0Spec beams = test::small_ms70();
  beams.beams.clear();
  for (const float elevation : {-10.0F, 0.0F}) {
    for (const float azimuth : {-2.5F, 0.0F, 5.0F}) beams.beams.push_back({100'000.0F, elevation, azimuth, 20.0F});
  }
  folder.write("a.raw", test::con0(beams).add(test::small_ping(kStart)));
  const auto azimuths = [&](double mounting_deg, BeamAzimuthSense sense) {
    NavigationParams navigation;
    navigation.mounting_azimuth_deg = mounting_deg;
    navigation.beam_azimuth_sense = sense;
    Work work(1);
    const std::vector<fs::path> paths{folder.path()};
    const auto survey = open_survey(paths, {}, navigation, IndexCache{}, work);
    return survey->observations.at(0).grid.value();
  };
  const BeamGrid clockwise = azimuths(90.0, BeamAzimuthSense::clockwise);
  EXPECT_EQ(clockwise.azimuth_deg, (std::vector<double>{87.5, 90.0, 95.0}));
  EXPECT_EQ(clockwise.channel, (std::vector<int>{0, 1, 2, 3, 4, 5}));
  // +5 degrees to the bow of a sonar that looks to starboard are 85 degrees from the bow.
  const BeamGrid to_the_bow = azimuths(90.0, BeamAzimuthSense::anticlockwise);
  EXPECT_EQ(to_the_bow.azimuth_deg, (std::vector<double>{85.0, 90.0, 92.5}));
  EXPECT_EQ(to_the_bow.channel, (std::vector<int>{2, 1, 0, 5, 4, 3}));
}

TEST(PingSettings, PingsMadeWithoutTransmittingAreBad) {
  const test::TemporaryFolder folder;
  folder.write("a.raw", test::small_file(2)
                            .add(test::small_ping(kStart + 2 * kSecondNs, {.transmit_mode = 1}))
                            .add(test::small_ping(kStart + 3 * kSecondNs, {.transmit_mode = 2}))
                            .add(test::small_ping(kStart + 4 * kSecondNs, {.transmit_mode = -1}))
                            // One channel that listens makes no ping of it.
                            .add(test::raw0(kStart + 5 * kSecondNs, {.channel = 1, .transmit_mode = 1}, {1, 2, 3, 4}))
                            .add(test::raw0(kStart + 5 * kSecondNs, {.channel = 2}, {1, 2, 3, 4})));
  for (const bool use : {false, true}) {
    const SurveyFiles survey = opened(folder, {.use_passive_pings = use});
    ASSERT_EQ(survey.observations.size(), 1U);
    const ObservationFiles& o = survey.observations[0];
    ASSERT_EQ(o.navigation.size(), 6U);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(o.navigation[i].bad, !use && (i == 2 || i == 3)) << i;
    EXPECT_EQ(count(o.diagnostics, DiagnosticCode::passive_pings), use ? 0 : 1);
  }
}

/// Pings of 1320 samples a row, each with the sound speed that it is given.
template <class SoundSpeed>
SurveyFiles drifting(int pings, SoundSpeed sound_speed_mps) {
  const test::TemporaryFolder folder;
  Bytes bytes = test::con0(test::small_ms70(), kStart);
  for (int i = 0; i < pings; ++i) {
    bytes.add(test::small_ping(kStart + i * kSecondNs,
                               {.sound_speed_mps = static_cast<float>(sound_speed_mps(i)), .offset = 1316}));
  }
  folder.write("a.raw", bytes);
  return opened(folder);
}

/// Law: whichever axis the observation has, it tells where the farthest sample of each ping lies to half a sample.
template <class SoundSpeed>
void expect_right_ranges(const SurveyFiles& survey, SoundSpeed sound_speed_mps) {
  int ping = 0;
  for (const ObservationFiles& o : survey.observations) {
    for (std::size_t i = 0; i < o.pings.size(); ++i, ++ping) {
      const double spacing_m = sound_speed_mps(ping) * 0.0005 / 2.0;
      const double range_m = 1319.0 * spacing_m - sound_speed_mps(ping) * 0.002 / 4.0;
      EXPECT_NEAR(o.range.range_m(1319), range_m, 0.51 * spacing_m) << ping;
    }
  }
}

TEST(PingSettings, AWaveringSoundSpeedCutsNothing) {
  const auto wavering = [](int ping) { return 1475.0 + 0.3 * std::sin(ping / 3.0); };
  const SurveyFiles survey = drifting(60, wavering);
  ASSERT_EQ(survey.observations.size(), 1U);
  EXPECT_EQ(count(survey.observations[0].diagnostics, DiagnosticCode::sound_speed_drift), 1);
  EXPECT_EQ(count(survey.observations[0].diagnostics, DiagnosticCode::settings_changed), 0);
  expect_right_ranges(survey, wavering);
  EXPECT_LE(survey.files[0].index.transmits.size(), 8U);
}

// By hand: 0.75 samples of 1320 are 0.84 m/s of 1475, and the index tells speeds to 0.15 m/s, so that 3.9 m/s need four
// observations or five.
TEST(PingSettings, ADriftOfSoundSpeedCutsWhereRangesWouldBeWrong) {
  const auto drift = [](int ping) { return 1475.0 + 0.1 * ping; };
  const SurveyFiles survey = drifting(40, drift);
  EXPECT_GE(survey.observations.size(), 4U);
  EXPECT_LE(survey.observations.size(), 5U);
  expect_right_ranges(survey, drift);
  for (std::size_t i = 1; i < survey.observations.size(); ++i) {
    EXPECT_TRUE(survey.observations[i].continues_cut);
    EXPECT_EQ(count(survey.observations[i].diagnostics, DiagnosticCode::settings_changed), 1);
  }
}

}  // namespace
}  // namespace sonar
