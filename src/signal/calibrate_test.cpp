// SPDX-License-Identifier: Apache-2.0
#include "signal/calibrate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/units.h"
#include "signal/test_data.h"

namespace sonar {
namespace {

ChannelCalibration ms70_fan_12() {
  return {.frequency_hz = 88875,
          .absorption_db_per_m = 0.029516,
          .transmit_power_w = 35.67,
          .pulse_length_s = 0.002048,
          .sound_speed_mps = 1474.99,
          .gain_db = 22.33,
          .sa_correction_db = -1.55,
          .equivalent_beam_angle_db = -22.85,
          .extra_factor_db = 0.0};
}

constexpr double kSpacing_m = 0.37760;

double db_at(const ChannelCalibration& calibration, int sample, double first_m = 0.0) {
  return db_from_counts(
      sv_table(calibration, SampleRanges(first_m, kSpacing_m, sample + 1))[static_cast<std::size_t>(sample)]);
}

// By hand: lambda = 0.0165962 m; Pt lambda^2 c tau / (32 pi^2) = 35.67 * 2.754346e-4 * 3.02078 / 315.8273 = 9.3971e-5,
// i.e. -40.2701 dB; constant = 40.2701 + 22.85 - 44.66 + 3.10 = 21.5601 dB. At sample 300, r = 113.28 m:
// 20 log10 r = 41.0832, 2 alpha r = 6.6871; together 69.330 dB. A count is 0.01176 dB wide.
TEST(calibrate, sonar_equation_by_hand) {
  EXPECT_NEAR(sv_constant_db(ms70_fan_12()), 21.5601, 1e-3);
  EXPECT_NEAR(db_at(ms70_fan_12(), 300), 69.330, 0.5 * kDbPerCount + 1e-3);
}

TEST(calibrate, symmetry_in_gain_and_absorption) {
  const auto base = ms70_fan_12();
  auto louder = base;
  louder.gain_db += 1.0;
  auto thicker = base;
  thicker.absorption_db_per_m += 0.001;
  auto extra = base;
  extra.extra_factor_db = 3.0;
  auto sa = base;
  sa.sa_correction_db += 0.5;
  for (const int sample : {0, 1, 7, 100, 1319}) {
    const double range_m = std::max(sample, 1) * kSpacing_m;
    EXPECT_NEAR(db_at(louder, sample) - db_at(base, sample), -2.0, kDbPerCount);
    EXPECT_NEAR(db_at(thicker, sample) - db_at(base, sample), 2.0 * 0.001 * range_m, kDbPerCount);
    EXPECT_NEAR(db_at(extra, sample) - db_at(base, sample), 3.0, kDbPerCount);
    EXPECT_NEAR(db_at(sa, sample) - db_at(base, sample), -1.0, kDbPerCount);
  }
}

TEST(calibrate, ranges_below_one_spacing_count_as_one) {
  const auto table = sv_table(ms70_fan_12(), SampleRanges(-2.0 * kSpacing_m, kSpacing_m, 6));
  EXPECT_EQ(table[0], table[3]);
  EXPECT_EQ(table[2], table[3]);
  EXPECT_GT(table[4], table[3]);
}

TEST(calibrate, what_is_not_sound_gives_no_data) {
  using Limits = std::numeric_limits<double>;
  std::vector<ChannelCalibration> bad(6, ms70_fan_12());
  bad[0].frequency_hz = 0.0;
  bad[1].transmit_power_w = -1.0;
  bad[2].gain_db = Limits::quiet_NaN();
  bad[3].absorption_db_per_m = Limits::infinity();
  bad[4].pulse_length_s = 0.0;
  bad[5].sound_speed_mps = Limits::quiet_NaN();
  for (const auto& calibration : bad) {
    EXPECT_FALSE(is_sound(calibration));
    EXPECT_THAT(sv_table(calibration, SampleRanges(0.0, kSpacing_m, 5)), testing::Each(kNoData));
  }
  EXPECT_THAT(sv_table(ms70_fan_12(), SampleRanges(0.0, 0.0, 5)), testing::Each(kNoData));
  auto huge = ms70_fan_12();
  huge.gain_db = 1e300;
  EXPECT_THAT(sv_table(huge, SampleRanges(0.0, kSpacing_m, 5)), testing::Each(-32767));
}

TEST(calibrate, table_is_added_saturating_and_keeps_no_data) {
  TestRandom random(1);
  for (const std::size_t size : {0U, 1U, 8U, 31U, 33U, 1319U}) {
    std::vector<std::int16_t> counts(size);
    std::vector<std::int16_t> table(size);
    for (auto& v : counts) v = static_cast<std::int16_t>(random.below(65536) - 32768);
    for (auto& v : table) v = static_cast<std::int16_t>(random.below(65536) - 32768);
    for (std::size_t i = 0; i < size; i += 7) counts[i] = kNoData;
    for (std::size_t i = 3; i < size; i += 7) table[i] = kNoData;
    auto sum = counts;
    apply_sv_table(sum, table);
    for (std::size_t i = 0; i < size; ++i) {
      const int plain = counts[i] + table[i];
      const int expected =
          counts[i] == kNoData || table[i] == kNoData ? kNoData : std::clamp<int>(plain, kMinCount, kMaxCount);
      ASSERT_EQ(sum[i], expected) << i;
    }
  }
  std::vector<std::int16_t> longer = {1, 2, 3};
  apply_sv_table(longer, std::vector<std::int16_t>{10, 10});
  EXPECT_THAT(longer, testing::ElementsAre(11, 12, kNoData));
}

}  // namespace
}  // namespace sonar
