// SPDX-License-Identifier: Apache-2.0
#include "signal/background.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/describe.h"
#include "base/units.h"
#include "signal/row_kernels.h"
#include "signal/test_data.h"

namespace sonar {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::vector<double> estimate(const Array3<std::int16_t>& ping, const Array3<SampleFlags>& flags, BackgroundMethod m) {
  return background_power_db(ping.view(), flags.view(), {.method = m});
}

// The truth is the level the noise was drawn with. Of 1000 samples the 0.2 quantile of an exponential scatters by
// sqrt(p (1 - p) / n) / (1 - p) / ln(1 / (1 - p)) = 7 %, i.e. 0.3 dB.
TEST(background, low_quantile_finds_the_noise_under_schools) {
  auto ping = noise_ping({4, 5, 1320}, -123.0, 1);
  for (int s = 500; s < 800; ++s) ping(1, 1, s) = static_cast<std::int16_t>(ping(1, 1, s) + 3000);
  const auto level_db = estimate(ping, Array3<SampleFlags>(ping.shape()), BackgroundMethod::low_quantile);
  double sum = 0.0;
  for (std::size_t row = 0; row < 20; ++row) {
    if (row == 6) continue;
    EXPECT_NEAR(level_db[row], -123.0, 1.2);
    sum += level_db[row];
  }
  EXPECT_NEAR(sum / 19, -123.0, 0.3);
  // A third of the samples used is school: the 0.2 quantile of all is the 0.29 quantile of the noise, 2 dB more.
  EXPECT_NEAR(level_db[6], -121.0, 1.5);
}

TEST(background, flagged_and_missing_samples_do_not_count) {
  auto ping = noise_ping({1, 2, 1320}, -123.0, 2);
  Array3<SampleFlags> flags(ping.shape());
  for (int s = 400; s < 1100; ++s) {
    ping(0, 0, s) = 5000;
    flags(0, 0, s) = SampleFlags::hot_beam;
    ping(0, 1, s) = kNoData;
  }
  for (const double level : estimate(ping, flags, BackgroundMethod::low_quantile)) EXPECT_NEAR(level, -123.0, 1.5);
}

TEST(background, too_few_samples_leave_it_unknown) {
  const auto ping = noise_ping({1, 1, 60}, -123.0, 3);
  for (const auto method : {BackgroundMethod::low_quantile, BackgroundMethod::de_robertis}) {
    EXPECT_TRUE(std::isnan(estimate(ping, Array3<SampleFlags>(ping.shape()), method)[0]));
    EXPECT_TRUE(
        std::isnan(estimate(Array3<std::int16_t>({1, 1, 900}, kNoData), Array3<SampleFlags>({1, 1, 900}), method)[0]));
  }
}

// By hand: blocks of two samples with linear powers (1, 3), (0.2, 0.6), (5, 5): the weakest mean is 0.4, -3.979 dB.
TEST(background, weakest_block_by_hand_and_its_cap) {
  Array3<std::int16_t> ping({1, 1, 6});
  const double powers[] = {1, 3, 0.2, 0.6, 5, 5};
  for (int s = 0; s < 6; ++s) ping(0, 0, s) = counts_of_power(powers[s]);
  BackgroundParams params{.method = BackgroundMethod::de_robertis, .minimum_samples = 1, .block_samples = 2};
  const Array3<SampleFlags> flags(ping.shape());
  EXPECT_NEAR(background_power_db(ping.view(), flags.view(), params)[0], -3.979, kDbPerCount);
  params.maximum_db = -10.0;
  EXPECT_EQ(background_power_db(ping.view(), flags.view(), params)[0], -10.0);
}

TEST(background, median_over_pings) {
  const std::vector<std::vector<double>> pings = {{-120, kNaN, -100}, {-110, kNaN, -90}, {-100, kNaN, kNaN}};
  const auto combined = combine_background(pings);
  EXPECT_EQ(combined[0], -110);
  EXPECT_TRUE(std::isnan(combined[1]));
  EXPECT_NEAR(combined[2], 10.0 * std::log10((1e-10 + 1e-9) / 2), 1e-9);
  EXPECT_TRUE(combine_background({}).empty());
}

TEST(background, sv_of_the_noise_and_low_snr) {
  const std::vector<std::int16_t> table = {1000, kNoData, 2000};
  const auto sv_db = noise_sv_db(-120.0, table);
  EXPECT_NEAR(sv_db[0], -120.0 + 1000 * kDbPerCount, 1e-9);
  EXPECT_TRUE(std::isnan(sv_db[1]));
  const auto limit = noise_sv_counts(-120.0, 3.0, table);
  EXPECT_EQ(limit[0], std::lround(-117.0 / kDbPerCount) + 1000);
  EXPECT_EQ(limit[1], kNoData);
  EXPECT_THAT(noise_sv_counts(kNaN, 3.0, table), testing::ElementsAre(kMinCount, kNoData, kMinCount));

  Array3<std::int16_t> ping({1, 2, 3}, counts_of_power(1e-12));
  ping(0, 0, 1) = counts_of_power(1e-11);
  ping(0, 0, 2) = kNoData;
  Array3<SampleFlags> flags(ping.shape(), SampleFlags::wall);
  const std::vector<double> level_db = {-118.0, kNaN};
  flag_low_snr(ping.view(), level_db, 3.0, flags.view());
  EXPECT_THAT(flags.all(),
              testing::ElementsAre(SampleFlags::wall | SampleFlags::low_snr, SampleFlags::wall, SampleFlags::wall,
                                   SampleFlags::wall, SampleFlags::wall, SampleFlags::wall));
}

TEST(background, select_rank_is_exact) {
  TestRandom random(9);
  for (const int size : {1, 2, 7, 64, 333, 1320}) {
    for (const int spread : {1, 3, 65536}) {
      std::vector<std::int16_t> values(static_cast<std::size_t>(size));
      for (auto& v : values) v = static_cast<std::int16_t>(random.below(spread) - 32768);
      auto sorted = values;
      std::sort(sorted.begin(), sorted.end());
      for (std::size_t rank = 0; rank < values.size(); rank += 1 + values.size() / 9) {
        ASSERT_EQ(select_rank(values, rank), sorted[rank]);
      }
    }
  }
}

TEST(background, parameters_are_checked) {
  EXPECT_TRUE(validate(BackgroundParams{}).has_value());
  EXPECT_FALSE(validate(BackgroundParams{.quantile = 2.0}).has_value());
}

}  // namespace
}  // namespace sonar
