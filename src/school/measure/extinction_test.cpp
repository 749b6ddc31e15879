// SPDX-License-Identifier: Apache-2.0
#include "school/measure/extinction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "base/units.h"
#include "school/test_ping.h"

namespace sonar {
namespace {

constexpr double kRatio = 0.627;
constexpr double kPerSv = 2.0 * 4.0 * std::numbers::pi * kRatio;  // 2 k: two ways, sigma = 4 pi sigma_bs

/// What a beam hears of fish by the layered closed form: layer by layer, exp(-2 k S) before it times the mean of its own.
std::vector<double> heard(const std::vector<double>& sv, double spacing_m) {
  std::vector<double> out;
  double depth = 0.0;
  for (const double one : sv) {
    const double own = kPerSv * one * spacing_m;
    out.push_back(own > 0.0 ? one * std::exp(-depth) * (1.0 - std::exp(-own)) / own : 0.0);
    depth += own;
  }
  return out;
}

/// 50 empty samples, a slab of 100, 30 empty, a slab of 60 and 40 behind.
std::vector<double> two_slabs(double first, double second) {
  std::vector<double> sv(280, 0.0);
  std::fill(sv.begin() + 50, sv.begin() + 150, first);
  std::fill(sv.begin() + 180, sv.begin() + 240, second);
  return sv;
}

TEST(Extinction, two_slabs_come_back_as_they_are) {
  constexpr double kSpacing_m = 0.2;
  const std::vector<double> sv = two_slabs(1e-3, 2e-3);
  const std::vector<double> observed = heard(sv, kSpacing_m);
  const BeamGain gain = beam_gain(observed, kSpacing_m, kRatio, 20.0);
  EXPECT_FALSE(gain.capped);
  for (std::size_t i = 0; i < sv.size(); ++i) EXPECT_NEAR(gain.within[i] * observed[i], sv[i], 1e-9 * 1e-3) << i;
  // 20 m of 1e-3 and 12 m of 2e-3: optical depths 0.3152 and 0.3782
  EXPECT_NEAR(db_from_linear(gain.behind[160]), 4.342945 * kPerSv * 0.020, 1e-6);
  EXPECT_NEAR(db_from_linear(gain.behind.back()), 4.342945 * kPerSv * 0.044, 1e-6);
  EXPECT_EQ(gain.within[49], 1.0);
}

TEST(Extinction, more_than_the_cap_is_not_told) {
  const std::vector<double> observed = heard(two_slabs(2e-2, 1e-3), 0.2);  // 27 dB in the first slab alone
  const BeamGain gain = beam_gain(observed, 0.2, kRatio, 6.0);
  EXPECT_TRUE(gain.capped);
  EXPECT_NEAR(db_from_linear(gain.behind.back()), 6.0, 1e-9);
  for (const double one : gain.within) EXPECT_LE(one, linear_from_db(6.0) * (1.0 + 1e-9));
  // A ratio twice too large makes what is heard impossible: no sign turns, nothing runs away.
  const BeamGain twice = beam_gain(observed, 0.2, 2.0 * kRatio, 20.0);
  EXPECT_TRUE(twice.capped);
  for (const double one : twice.within) EXPECT_TRUE(one >= 1.0 && one <= 100.0 * (1.0 + 1e-9)) << one;
}

/// One beam through two schools, the second in the shadow of the first.
TEST(Extinction, a_school_behind_another_is_corrected_to_what_it_is) {
  test::MeasuredPing scene;
  scene.counts = Array3<std::int16_t>(scene.expected.shape(), kMinCount);
  const double spacing_m = scene.sector.range().spacing_m;
  const std::vector<double> sv = two_slabs(1e-3, 5e-4);
  const std::vector<double> observed = heard(sv, spacing_m);
  constexpr int kFirst = 300;
  constexpr int kRow = 10 * 25 + 12;
  for (std::size_t i = 0; i < sv.size(); ++i) {
    if (observed[i] > 0.0) scene.counts(10, 12, kFirst + static_cast<int>(i)) = count_from_linear(observed[i]);
  }
  const auto mask = [](int first, int count) {
    PingMask out;
    out.runs.push_back({kRow, first, count});
    out.confidence.assign(static_cast<std::size_t>(count), 255);
    return out;
  };
  const PingMask near = mask(kFirst + 50, 100);
  const PingMask far = mask(kFirst + 180, 60);
  MeasureInput in;
  in.sv = scene.counts.view();
  in.flags = scene.flags.view();
  in.sector = &scene.sector;
  const std::vector<const PingMask*> both{&near, &far};
  ExtinctionParams params;
  params.ratio = kRatio;
  const PingShadow shadow(in, both, params);
  SchoolPingRow row;
  shadow.tell(far, row);
  const double depth = kPerSv * spacing_m;
  EXPECT_NEAR(row.extinction_loss_db, 4.342945 * depth * (0.1 + 0.03), 0.01) << "steps of counts are 0.012 dB";
  double whole = 0.0;
  double left = 0.0;
  for (std::size_t i = 180; i < 240; ++i) {
    const double volume = scene.sector.shell_m3_per_sr(kFirst + static_cast<int>(i));
    whole += sv[i] * volume;
    left += observed[i] * volume;
  }
  EXPECT_NEAR(row.extinction_share, 1.0 - left / whole, 0.002);
  EXPECT_LT(row.extinction_share_low, row.extinction_share);
  EXPECT_GT(row.extinction_share_high, row.extinction_share);
  EXPECT_EQ(row.extinction_corrected, 0.0);
  const Array3<std::int16_t> corrected = without_extinction(in.sv, in.background, shadow.gain(), 1.0);
  for (const int at : {55, 149, 181, 239}) {
    const std::size_t i = static_cast<std::size_t>(at);
    const std::int16_t count = std::as_const(corrected)(10, 12, kFirst + at);
    EXPECT_NEAR(db_from_linear(linear_from_count(count)), db_from_linear(sv[i]), 0.03) << at;
  }
}

/// Water alone has no fish whose echo the gain could raise: neither its mean nor its median changes.
TEST(Extinction, what_is_background_alone_is_left_as_it_is) {
  test::MeasuredPing scene;
  constexpr int kRow = 10 * 25 + 12;
  const Background background{scene.flat.power_db, scene.flat.calibration.view()};
  const double behind = RowBackground(background, kRow)(400);
  ASSERT_GT(behind, 0.0);
  PingGain gain(scene.expected.shape().rows());
  gain[kRow].within.assign(static_cast<std::size_t>(scene.expected.shape().samples), 3.0);
  for (const double of_mean : {1.0, std::numbers::ln2}) {
    Array3<std::int16_t> counts(scene.expected.shape());
    counts(10, 12, 400) = count_from_linear(of_mean * behind);
    const Array3<std::int16_t> out = without_extinction(std::as_const(counts).view(), background, gain, of_mean);
    EXPECT_NEAR(out(10, 12, 400), count_from_linear(of_mean * behind), 2) << of_mean;
  }
}

}  // namespace
}  // namespace sonar
