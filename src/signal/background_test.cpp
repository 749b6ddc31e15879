// SPDX-License-Identifier: Apache-2.0
#include "signal/background.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "base/describe.h"
#include "base/units.h"
#include "signal/row_kernels.h"
#include "signal/test_data.h"

namespace sonar {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Sv counts over power counts of a beam: spreading and absorption of 30 dB a km, spacing 0.27 m.
std::vector<std::int16_t> sv_over_power(int samples) {
  std::vector<std::int16_t> table;
  for (int s = 0; s < samples; ++s) {
    const double range_m = 0.27 * (s + 1);
    table.push_back(static_cast<std::int16_t>(
        std::lround(counts_from_db(10.0 + 20.0 * std::log10(range_m) + 2.0 * 0.03 * range_m))));
  }
  return table;
}

Array3<std::int16_t> table_of(const Shape3& shape) {
  Array3<std::int16_t> table(shape);
  for (int row = 0; row < static_cast<int>(shape.rows()); ++row) {
    std::ranges::copy(sv_over_power(shape.samples), table.view().row(row).begin());
  }
  return table;
}

std::vector<double> noise_of(std::span<const Array3<std::int16_t>> pings, const Array3<SampleFlags>& flags,
                             const BackgroundParams& params) {
  std::vector<Array3<std::int16_t>> levels;
  for (const auto& ping : pings) levels.push_back(background_levels(ping.view(), flags.view(), params));
  std::vector<const Array3<std::int16_t>*> borrowed;
  for (const auto& of_ping : levels) borrowed.push_back(&of_ping);
  const Array3<double> gain = block_gain(table_of(flags.shape()).view(), params);
  const Array3<std::int16_t> over_pings = levels_over_pings(borrowed, params);
  const double spread = level_spread(borrowed, over_pings.view(), flags.shape().samples, params);
  return noise_power_db(over_pings.view(), spread, gain.view(), params);
}

/// From one ping alone.
std::vector<double> estimate(const Array3<std::int16_t>& ping, const Array3<SampleFlags>& flags, BackgroundMethod m) {
  return noise_of({&ping, 1}, flags, {.method = m});
}

/// Adds the echo of a mean Sv at each sample, fading as single echoes do, to pings of noise.
template <class SvDb>
std::vector<Array3<std::int16_t>> pings_of(const Shape3& shape, double noise_db, int count, SvDb sv_db) {
  std::vector<Array3<std::int16_t>> pings;
  const std::vector<std::int16_t> table = sv_over_power(shape.samples);
  std::mt19937 random(7);
  std::exponential_distribution<double> drawn(1.0);
  for (int i = 0; i < count; ++i) {
    Array3<std::int16_t> ping(shape);
    for (std::size_t k = 0; k < ping.all().size(); ++k) {
      const std::size_t s = k % static_cast<std::size_t>(shape.samples);
      const double mean = linear_from_db(noise_db) +
                          linear_from_db(sv_db(0.27 * (static_cast<double>(s) + 1)) - db_from_counts(table[s]));
      ping.all()[k] = counts_of_power(mean * std::max(1e-6, drawn(random)));
    }
    pings.push_back(std::move(ping));
  }
  return pings;
}

double mean_of(std::span<const double> db) {
  double sum = 0.0;
  for (const double level : db) sum += linear_from_db(level);
  return db_from_linear(sum / static_cast<double>(db.size()));
}

// The truth is the level the noise was drawn with. Of 82 samples the 0.2 quantile of an exponential scatters by
// sqrt(p / (1 - p) / n) / ln(1 / (1 - p)) = 25 %, 1.1 dB; a quartile of twelve such by 0.5 dB.
TEST(background, low_quantile_finds_the_noise_under_schools) {
  auto ping = noise_ping({4, 5, 1320}, -123.0, 1);
  for (int s = 500; s < 800; ++s) ping(1, 1, s) = static_cast<std::int16_t>(ping(1, 1, s) + 3000);
  const auto level_db = estimate(ping, Array3<SampleFlags>(ping.shape()), BackgroundMethod::low_quantile);
  for (const double level : level_db) EXPECT_NEAR(level, -123.0, 2.0);
  EXPECT_NEAR(mean_of(level_db), -123.0, 0.4);
}

// Water of one Sv all along the beam that at the record's end is as loud as the noise, ten times softer, ten times louder: the
// noise is known within a tenth of what is heard there. Without telling water and noise apart it would be 5 dB too high in the first.
TEST(background, uniform_water_is_no_noise) {
  const Shape3 shape{2, 25, 1320};
  const double end_db = db_from_counts(sv_over_power(1320).back());
  for (const double over_noise_db : {-10.0, 0.0, 10.0}) {
    const auto pings = pings_of(shape, -150.0, 11, [&](double) { return end_db - 150.0 + over_noise_db; });
    const double found = linear_from_db(mean_of(noise_of(pings, Array3<SampleFlags>(shape), {})) + 150.0);
    EXPECT_NEAR(found, 1.0, 0.1 * (1.0 + linear_from_db(over_noise_db))) << over_noise_db;
  }
}

// A layer near the ship, one that fills the far half, the seabed from 250 m of 356 m on.
TEST(background, layers_and_the_seabed_are_no_noise) {
  const Shape3 shape{1, 25, 1320};
  const auto noise_db = [&](auto sv_db) {
    return mean_of(noise_of(pings_of(shape, -150.0, 11, sv_db), Array3<SampleFlags>(shape), {}));
  };
  EXPECT_NEAR(noise_db([](double r) { return r < 180.0 ? -55.0 : -200.0; }), -150.0, 0.3);
  EXPECT_NEAR(noise_db([](double r) { return r > 200.0 ? -70.0 : -200.0; }), -150.0, 0.3);
  EXPECT_NEAR(noise_db([](double r) { return r > 250.0 ? -40.0 - (r - 250.0) / 5.0 : -200.0; }), -150.0, 0.3);
}

// No quarter of what noise alone shows is taken for water.
TEST(background, silent_water_leaves_the_noise_whole) {
  const Shape3 shape{4, 25, 1320};
  const auto pings = pings_of(shape, -150.0, 11, [](double) { return -300.0; });
  EXPECT_NEAR(mean_of(noise_of(pings, Array3<SampleFlags>(shape), {})), -150.0, 0.1);
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
  std::vector<Array3<std::int16_t>> pings;
  for (const auto& powers : {std::array{1.0, 3.0, 0.2, 0.6, 5.0, 5.0}, std::array{4.0, 4.0, 3.6, 3.6, 1.0, 1.0}}) {
    Array3<std::int16_t>& ping = pings.emplace_back(Shape3{1, 1, 6});
    for (int s = 0; s < 6; ++s) ping(0, 0, s) = counts_of_power(0.01 * powers[static_cast<std::size_t>(s)]);
  }
  EXPECT_NEAR(noise_of(pings, flags, params)[0], -16.990, 2 * kDbPerCount);
  params.maximum_db = -20.0;
  EXPECT_EQ(noise_of(pings, flags, params)[0], -20.0);
}

// The truth is the level the noise was drawn with. A block of 26 samples over 20 pings scatters by 1/sqrt(520) = 4.4 %;
// the weakest of 50 such lies some 2.3 standard deviations low: 10 %, 0.45 dB.
TEST(background, de_robertis_finds_the_noise_over_twenty_pings) {
  const BackgroundParams params{.method = BackgroundMethod::de_robertis};
  std::vector<Array3<std::int16_t>> pings;
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    auto ping = noise_ping({2, 2, 1320}, -123.0, seed);
    for (int s = 200; s < 900; ++s) ping(1, 1, s) = static_cast<std::int16_t>(ping(1, 1, s) + 2000);  // a school
    pings.push_back(std::move(ping));
  }
  for (const double level : noise_of(pings, Array3<SampleFlags>({2, 2, 1320}), params)) EXPECT_NEAR(level, -123.4, 0.4);
}

// One beam is hot in seven of eleven pings, so that their median is; its quiet pings are quiet, its hot ones hot.
TEST(background, a_ping_is_no_louder_than_itself) {
  std::vector<Array3<std::int16_t>> pings;
  std::vector<const Array3<std::int16_t>*> borrowed;
  for (std::uint32_t seed = 1; seed <= 11; ++seed) {
    auto ping = noise_ping({1, 2, 1320}, -157.0, seed);
    for (int s = 0; seed <= 7 && s < 1320; ++s) ping(0, 1, s) = static_cast<std::int16_t>(ping(0, 1, s) + 3500);
    pings.push_back(background_levels(ping.view(), Array3<SampleFlags>(ping.shape()).view(), {}));
  }
  for (const auto& ping : pings) borrowed.push_back(&ping);
  const Array3<std::int16_t> together = levels_over_pings(borrowed, {});
  for (const auto& [ping, loud] : {std::pair<std::size_t, bool>{0, true}, {10, false}}) {
    Array3<std::int16_t> levels = together;
    keep_quieter(std::as_const(pings[ping]).view(), 6.0, levels.view());
    EXPECT_TRUE(std::ranges::equal(levels.row(0, 0), together.row(0, 0)));  // a single ping's scatter is no quiet
    EXPECT_TRUE(std::ranges::equal(levels.row(0, 1), loud ? together.row(0, 1) : std::as_const(pings[ping]).row(0, 1)));
  }
  Array3<std::int16_t> unknown({1, 1, kFarBlocks}, kNoData);
  keep_quieter(std::as_const(pings[10]).view(), 6.0, Array3<std::int16_t>(pings[10].shape(), kNoData).view());
  EXPECT_TRUE(
      std::isnan(noise_power_db(std::as_const(unknown).view(), 0.1, Array3<double>(unknown.shape()).view(), {})[0]));
}

// A level of the 0.2 quantile of 82 samples scatters by 25 % (above), the median of eleven by sqrt(pi / 2 / 11) of that: 9.3 %. One
// ping that is all loud moves the middle of the distances from the 50th to the 55th part in a hundred of those of the others: 13 %.
TEST(background, spread_of_levels_over_pings) {
  std::vector<Array3<std::int16_t>> pings;
  std::vector<const Array3<std::int16_t>*> borrowed;
  for (std::uint32_t seed = 1; seed <= 11; ++seed) {
    const auto ping = noise_ping({4, 25, 1320}, -150.0, seed);
    pings.push_back(background_levels(ping.view(), Array3<SampleFlags>(ping.shape()).view(), {}));
  }
  for (const auto& ping : pings) borrowed.push_back(&ping);
  const auto spread = [&] {
    const Array3<std::int16_t> together = levels_over_pings(borrowed, {});
    return level_spread(borrowed, together.view(), 1320, {});
  };
  const double quiet = spread();
  EXPECT_NEAR(quiet, 0.093, 0.012);
  for (std::int16_t& level : pings[0].all()) level = static_cast<std::int16_t>(level + 1000);
  EXPECT_NEAR(spread() / quiet, 1.1, 0.1);
}

TEST(background, median_over_pings_by_hand) {
  const auto counts = [](double db) { return static_cast<std::int16_t>(std::lround(counts_from_db(db))); };
  const auto levels = [&](std::int16_t a, std::int16_t b, std::int16_t c) {
    Array3<std::int16_t> out({1, 1, 3});
    std::ranges::copy(std::array{a, b, c}, out.all().begin());
    return out;
  };
  const auto first = levels(counts(-120), kNoData, counts(-100));
  const auto second = levels(counts(-110), kNoData, counts(-90));
  const auto third = levels(counts(-100), kNoData, kNoData);
  const Array3<std::int16_t> over = levels_over_pings(std::array{&first, &second, &third}, {});
  EXPECT_EQ(over(0, 0, 0), counts(-110));
  EXPECT_EQ(over(0, 0, 1), kNoData);
  EXPECT_NEAR(db_from_counts(over(0, 0, 2)), 10.0 * std::log10((1e-10 + 1e-9) / 2), kDbPerCount);
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
