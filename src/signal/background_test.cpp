// SPDX-License-Identifier: Apache-2.0
#include "signal/background.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "base/describe.h"
#include "base/units.h"
#include "signal/row_kernels.h"
#include "signal/test_data.h"

namespace sonar {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// From one ping alone.
std::vector<double> estimate(const Array3<std::int16_t>& ping, const Array3<SampleFlags>& flags, BackgroundMethod m) {
  const BackgroundParams params{.method = m};
  const std::vector<std::vector<double>> pings{background_power_db(ping.view(), flags.view(), params)};
  return combine_background(pings, ping.shape().rows(), params);
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

// Water of one Sv all along the beam, louder than the noise up to the record's end: its power falls by spreading and
// absorption. What is taken for noise may lie no higher than what comes from the last sixth.
TEST(background, water_that_fades_along_the_beam_is_no_noise) {
  auto ping = noise_ping({4, 5, 1320}, 0.0, 5);
  const auto water_db = [](int s) {
    const double range_m = 0.27 * (s + 1);
    return -80.0 - 20.0 * std::log10(range_m) - 2.0 * 0.03 * range_m;
  };
  for (int row = 0; row < 20; ++row) {
    for (int s = 0; s < 1320; ++s) {
      std::int16_t& count = ping.view().row(row)[static_cast<std::size_t>(s)];
      count = static_cast<std::int16_t>(count + counts_from_db(water_db(s)));
    }
  }
  const Array3<SampleFlags> flags(ping.shape());
  const auto level_db = [&](double fall_db) {
    const BackgroundParams params{.fall_db = fall_db};
    const std::vector<std::vector<double>> pings{background_power_db(ping.view(), flags.view(), params)};
    return combine_background(pings, 20, params);
  };
  for (const double level : level_db(BackgroundParams{}.fall_db)) EXPECT_LT(level, water_db(1100));
  for (const double level : level_db(100.0)) EXPECT_GT(level, water_db(1100) + 2.0);
}

TEST(background, flagged_and_missing_samples_do_not_count) {
  auto ping = noise_ping({1, 2, 1320}, -123.0, 2);
  Array3<SampleFlags> flags(ping.shape());
  for (int s = 400; s < 1100; ++s) {
    ping(0, 0, s) = 5000;
    flags(0, 0, s) = SampleFlags::corrupted;
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

// By hand: two pings in blocks of two samples. Means over both pings: (2, 0.4, 5) and (4, 3.6, 1) give 3, 2, 3: the
// weakest is 2, 3.010 dB. Of the single blocks 0.4 would be the weakest. All in 0.01 W.
TEST(background, weakest_block_over_pings_by_hand_and_its_cap) {
  const Array3<SampleFlags> flags({1, 1, 6});
  BackgroundParams params{.method = BackgroundMethod::de_robertis, .minimum_samples = 1, .block_samples = 2};
  std::vector<std::vector<double>> pings;
  for (const auto& powers : {std::array{1.0, 3.0, 0.2, 0.6, 5.0, 5.0}, std::array{4.0, 4.0, 3.6, 3.6, 1.0, 1.0}}) {
    Array3<std::int16_t> ping({1, 1, 6});
    for (int s = 0; s < 6; ++s) ping(0, 0, s) = counts_of_power(0.01 * powers[static_cast<std::size_t>(s)]);
    pings.push_back(background_power_db(ping.view(), flags.view(), params));
  }
  EXPECT_NEAR(combine_background(pings, 1, params)[0], -16.990, kDbPerCount);
  params.maximum_db = -20.0;
  EXPECT_EQ(combine_background(pings, 1, params)[0], -20.0);
}

// The truth is the level the noise was drawn with. A block of 26 samples over 20 pings scatters by 1/sqrt(520) = 4.4 %;
// the weakest of 50 such lies some 2.3 standard deviations low: 10 %, 0.45 dB.
TEST(background, de_robertis_finds_the_noise_over_twenty_pings) {
  const BackgroundParams params{.method = BackgroundMethod::de_robertis};
  std::vector<std::vector<double>> pings;
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    auto ping = noise_ping({2, 2, 1320}, -123.0, seed);
    for (int s = 200; s < 900; ++s) ping(1, 1, s) = static_cast<std::int16_t>(ping(1, 1, s) + 2000);  // a school
    pings.push_back(background_power_db(ping.view(), Array3<SampleFlags>(ping.shape()).view(), params));
  }
  for (const double level : combine_background(pings, 4, params)) EXPECT_NEAR(level, -123.4, 0.4);
}

// One beam is hot in seven of eleven pings, so that their median is; its quiet pings are quiet, its hot ones hot.
TEST(background, a_ping_is_no_louder_than_itself) {
  std::vector<std::vector<double>> pings;
  for (std::uint32_t seed = 1; seed <= 11; ++seed) {
    auto ping = noise_ping({1, 2, 1320}, -157.0, seed);
    for (int s = 0; seed <= 7 && s < 1320; ++s) ping(0, 1, s) = static_cast<std::int16_t>(ping(0, 1, s) + 3500);
    pings.push_back(background_power_db(ping.view(), Array3<SampleFlags>(ping.shape()).view(), {}));
  }
  for (const auto& [ping, loud] : {std::pair<std::size_t, bool>{0, true}, {10, false}}) {
    std::vector<double> level_db = combine_background(pings, 2, {});
    EXPECT_GT(level_db[1], -120.0);
    const double steady_db = level_db[0];
    keep_quieter(combine_background({&pings[ping], 1}, 2, {}), 6.0, level_db);
    EXPECT_EQ(level_db[0], steady_db);  // a single ping's scatter is no quiet
    if (loud) {
      EXPECT_GT(level_db[1], -120.0);
    } else {
      EXPECT_NEAR(level_db[1], -157.0, 1.2);
    }
  }
  std::vector<double> unknown{kNaN, -150.0};
  keep_quieter(std::array{-170.0, kNaN}, 6.0, unknown);
  EXPECT_TRUE(std::isnan(unknown[0]));
  EXPECT_EQ(unknown[1], -150.0);
}

TEST(background, median_over_pings) {
  const std::vector<std::vector<double>> pings = {{-120, kNaN, -100}, {-110, kNaN, -90}, {-100, kNaN, kNaN}};
  const auto combined = combine_background(pings, 3, {});
  EXPECT_EQ(combined[0], -110);
  EXPECT_TRUE(std::isnan(combined[1]));
  EXPECT_NEAR(combined[2], 10.0 * std::log10((1e-10 + 1e-9) / 2), 1e-9);
  EXPECT_TRUE(combine_background({}, 3, {}).empty());
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
  Array3<SampleFlags> flags(ping.shape(), SampleFlags::interference);
  const std::vector<double> level_db = {-118.0, kNaN};
  flag_low_snr(ping.view(), level_db, 3.0, flags.view());
  EXPECT_THAT(flags.all(),
              testing::ElementsAre(SampleFlags::interference | SampleFlags::low_snr, SampleFlags::interference,
                                   SampleFlags::interference, SampleFlags::interference, SampleFlags::interference,
                                   SampleFlags::interference));
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
        ASSERT_EQ(select_rank(values, rank, sorted.front(), sorted[rank]), sorted[rank]);
        ASSERT_EQ(select_rank(values, rank, sorted[rank], sorted.back()), sorted[rank]);
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
