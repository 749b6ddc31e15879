// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/channel_sv.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/units.h"
#include "pipeline/stages/load_volume.h"
#include "pipeline/survey/test_opened.h"

namespace sonar {
namespace {

using test::kStart;

/// The sonar equation for volume backscatter, written out anew: what of a sample is known, in SI units and dB.
struct SonarEquation {
  double frequency_hz, power_w, pulse_s, speed_mps, gain_db, sa_db, psi_db, alpha_db_m;
  [[nodiscard]] double sv_db(double received_db, double range_m) const {
    const double lambda = speed_mps / frequency_hz;
    const double constant = power_w * lambda * lambda * speed_mps * pulse_s * std::pow(10.0, psi_db / 10.0) /
                            (32.0 * std::numbers::pi * std::numbers::pi);
    return received_db + 20.0 * std::log10(range_m) + 2.0 * alpha_db_m * range_m - 10.0 * std::log10(constant) -
           2.0 * gain_db - 2.0 * sa_db;
  }
};

TEST(ChannelSv, IsTheSonarEquationOfTheChannelItself) {
  const test::TemporaryFolder folder;
  test::Con0Spec con0;
  con0.sounder = "ER60";
  con0.beams = {{38'000.0F, 0.0F, 0.0F, 25.0F, -20.5F}, {120'000.0F, 0.0F, 0.0F, 27.0F, -21.0F}};
  test::Bytes bytes = test::con0(con0);
  test::Raw0Spec low;
  low.channel = 1;
  low.frequency_hz = 38'000.0F;
  low.power_w = 2000.0F;
  low.pulse_s = 0.002F;  // as the table has it: sa correction -1.5 dB
  low.interval_s = 0.0005F;
  low.sound_speed_mps = 1490.0F;
  low.absorption_db_per_m = 0.0095F;
  low.transducer_depth_m = 6.0F;
  test::Raw0Spec high = low;
  high.channel = 2;
  high.frequency_hz = 120'000.0F;
  high.power_w = 500.0F;
  high.absorption_db_per_m = 0.04F;
  high.interval_s = 0.00025F;  // twice as fine as the other
  const std::vector<std::int16_t> power{-3000, -5000, -20000, -7000, -8000, -9000, -9500, -9900};
  bytes.add(test::raw0(kStart, low, power)).add(test::raw0(kStart, high, power));
  bytes.add(test::raw0(kStart + kSecondNs, low, power));  // the second ping lacks 120 kHz
  folder.write("a.raw", bytes);
  const SurveyFiles survey = test::opened(folder);
  const ObservationFiles& observation = survey.observations.at(0);
  ASSERT_FALSE(observation.grid);
  for (const int channel : {0, 1}) {
    const auto sv = load_channel_sv(survey, observation, 0, channel, Recipe{});
    ASSERT_TRUE(sv);
    ASSERT_EQ(sv->counts.size(), power.size());
    const test::Raw0Spec& set = channel == 0 ? low : high;
    const SonarEquation equation{set.frequency_hz,
                                 set.power_w,
                                 set.pulse_s,
                                 set.sound_speed_mps,
                                 channel == 0 ? 25.0 : 27.0,
                                 -1.5,
                                 channel == 0 ? -20.5 : -21.0,
                                 set.absorption_db_per_m};
    const double spacing_m = 1490.0 * set.interval_s / 2.0;
    EXPECT_NEAR(sv->range.spacing_m, spacing_m, 1e-6);
    for (std::size_t s = 0; s < power.size(); ++s) {
      if (power[s] == -20000) {
        EXPECT_EQ(sv->counts[s], kNoData) << "a missing value";
        continue;
      }
      const double range_m = spacing_m * static_cast<double>(s) - 1490.0 * 0.002 / 4.0;
      if (range_m < spacing_m) continue;
      EXPECT_NEAR(db_from_counts(sv->counts[s]), equation.sv_db(power[s] * 10.0 * std::log10(2.0) / 256.0, range_m),
                  0.012)
          << channel << ' ' << s;
    }
  }
  const auto lacking = load_channel_sv(survey, observation, 1, 1, Recipe{});
  ASSERT_TRUE(lacking);
  EXPECT_TRUE(lacking->counts.empty());
}

// The lines of a table name channels alone: 0 is the sonar's, and the sounder's too.
TEST(ChannelSv, ATableIsTheSoundersOwnOnlyWhereNoSonarHasFans) {
  const test::TemporaryFolder folder;
  test::Con0Spec con0;
  con0.sounder = "ER60";
  con0.beams = {{38'000.0F, 0.0F, 0.0F, 25.0F, -20.5F}};
  test::Raw0Spec spec;
  spec.channel = 1;
  spec.frequency_hz = 38'000.0F;
  test::Bytes bytes = test::con0(con0);
  bytes.add(test::raw0(kStart, spec, std::vector<std::int16_t>(40, -5000)));
  folder.write("b.raw", bytes);
  Recipe table;
  table.calibration.beams.resize(1);
  table.calibration.beams[0].channel = 0;
  table.calibration.beams[0].gain_db = 20.0;
  const auto sv_db = [&](const SurveyFiles& survey, const Recipe& recipe) {
    for (const ObservationFiles& observation : survey.observations) {
      if (observation.grid) continue;
      const auto sv = load_channel_sv(survey, observation, 0, 0, recipe);
      return sv ? db_from_counts(sv->counts.at(30)) : 0.0;
    }
    return 0.0;
  };
  const SurveyFiles alone = test::opened(folder);
  // Ten decibels less of twice a gain of five less.
  EXPECT_NEAR(sv_db(alone, table) - sv_db(alone, Recipe{}), 10.0, 0.03);
  folder.write("a.raw", test::small_file(2));
  const SurveyFiles both = test::opened(folder);
  ASSERT_EQ(both.observations.size(), 2U);
  ASSERT_TRUE(both.observations[0].grid || both.observations[1].grid);
  EXPECT_EQ(sv_db(both, table), sv_db(both, Recipe{}));
}

TEST(ChannelSv, OfARecordedEk60IsTheSonarEquation) {
  const auto file = test::data_folder() / "raw" / "D20070724-T042400.raw";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no recorded files here";
  const SurveyFiles survey = test::opened({file});
  const ObservationFiles& observation = survey.observations.at(0);
  ASSERT_EQ(observation.config.beams.size(), 4U);
  for (int channel = 0; channel < 4; ++channel) {
    const auto ping = load_ping(survey, observation.pings.at(17));
    ASSERT_TRUE(ping);
    const ChannelPing& head = ping->channels.at(static_cast<std::size_t>(channel));
    const BeamConfig& beam = observation.config.beams[static_cast<std::size_t>(channel)];
    std::size_t pulse = 0;
    while (pulse < 5 && std::abs(beam.pulse_length_s[pulse] - head.pulse_length_s) > 1e-6) ++pulse;
    ASSERT_LT(pulse, 5U);
    const SonarEquation equation{head.frequency_hz,
                                 head.transmit_power_w,
                                 head.pulse_length_s,
                                 head.sound_speed_mps,
                                 beam.gain_table_db[pulse],
                                 beam.sa_correction_table_db[pulse],
                                 beam.equivalent_beam_angle_db,
                                 head.absorption_db_per_m};
    const auto sv = load_channel_sv(survey, observation, 17, channel, Recipe{});
    ASSERT_TRUE(sv);
    ASSERT_EQ(sv->counts.size(), 2604U);
    const double spacing_m = head.sound_speed_mps * head.sample_interval_s / 2.0;
    for (std::size_t s = 10; s < 2604; s += 7) {
      const double range_m = spacing_m * static_cast<double>(s) - head.sound_speed_mps * head.pulse_length_s / 4.0;
      EXPECT_NEAR(db_from_counts(sv->counts[s]),
                  equation.sv_db(head.power_count[s] * 10.0 * std::log10(2.0) / 256.0, range_m), 0.012)
          << channel << ' ' << s;
    }
  }
}

}  // namespace
}  // namespace sonar
