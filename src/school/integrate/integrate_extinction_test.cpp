// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "base/units.h"
#include "school/integrate/test_integration.h"

namespace sonar {
namespace {

using test::kSamples;

constexpr double kRatio = 0.627;
constexpr double kPerSv = 2.0 * 4.0 * std::numbers::pi * kRatio;  // 2 k: two ways, sigma = 4 pi sigma_bs
constexpr double kWater = 1e-15;

/// Two slabs of fish, and fish too few to be a school behind both, in all beams alike.
struct Slabs {
  double near_sv = 3e-3;  ///< samples 200 .. 259
  double far_sv = 5e-4;   ///< 300 .. 359
  double behind_sv = 1e-6;

  /// [sample]
  [[nodiscard]] std::vector<double> sv() const {
    std::vector<double> out(kSamples, kWater);
    std::fill(out.begin() + 200, out.begin() + 260, near_sv);
    std::fill(out.begin() + 300, out.begin() + 360, far_sv);
    std::fill(out.begin() + 420, out.begin() + 640, behind_sv);
    return out;
  }
  /// The closed form of a uniform slab: exp(-2 k S) of what lies before a sample, times the mean over its own length.
  /// Only the slabs take sound out.
  [[nodiscard]] std::vector<double> heard(double spacing_m) const {
    std::vector<double> out = sv();
    for (int s = 0; s < kSamples; ++s) {
      const double near_m = spacing_m * std::clamp(s - 200, 0, 60);
      const double far_m = spacing_m * std::clamp(s - 300, 0, 60);
      double& one = out[static_cast<std::size_t>(s)];
      const bool in_slab = (s >= 200 && s < 260) || (s >= 300 && s < 360);
      const double own = in_slab ? kPerSv * one * spacing_m : 0.0;
      one *= std::exp(-kPerSv * (near_sv * near_m + far_sv * far_m));
      if (own > 0.0) one *= (1.0 - std::exp(-own)) / own;
    }
    return out;
  }
};

PingMask slab_mask(int first, int count) {
  PingMask out;
  for (int row = 0; row < 500; ++row) out.runs.push_back({row, first, count});
  out.confidence.assign(std::size_t{500} * static_cast<std::size_t>(count), 255);
  return out;
}

class IntegrateExtinction : public testing::Test {
 protected:
  /// noise  sv of the background, in what is heard and taken off again
  PingCells integrated(const std::vector<double>& sv, bool correct, double noise = 0.0, double most_db = 6.0) {
    scene_.fill([&](int, int s) { return sv[static_cast<std::size_t>(s)] + noise; });
    scene_.background_db.clear();
    if (noise > 0.0) scene_.background_db.assign(500, db_from_linear(noise));
    scene_.schools = {&near_, &far_};
    scene_.extinction.correct = correct;
    scene_.extinction.most_db = most_db;
    return scene_.integrated({});
  }
  [[nodiscard]] double spacing_m() const { return scene_.sector.range().spacing_m; }

  PingMask near_ = slab_mask(200, 60);
  PingMask far_ = slab_mask(300, 60);
  test::IntegratedScene scene_;
};

double sum_of(const PingCells& cells, double CellSums::*what) {
  double sum = 0.0;
  for (const CellSums& cell : cells.cells) sum += cell.*what;
  return sum;
}

// What is heard, corrected, is in every cell what would be heard of the same fish if they took no sound out: in the slabs,
// between them and behind them. Steps of counts are 0.3 % of sv.
TEST_F(IntegrateExtinction, two_slabs_and_what_lies_behind_them_come_back_as_they_are) {
  const Slabs slabs;
  const PingCells truth = integrated(slabs.sv(), false);
  const PingCells heard = integrated(slabs.heard(spacing_m()), false);
  const PingCells corrected = integrated(slabs.heard(spacing_m()), true);
  ASSERT_EQ(truth.cells.size(), corrected.cells.size());
  int cells = 0;
  for (std::size_t i = 0; i < truth.cells.size(); ++i) {
    const CellSums& as_it_is = truth.cells[i];
    if (as_it_is.echo_m2 < 1e-6) continue;
    ++cells;
    EXPECT_NEAR(corrected.cells[i].echo_m2, as_it_is.echo_m2, 0.004 * as_it_is.echo_m2) << i;
    EXPECT_NEAR(corrected.cells[i].school_m2, as_it_is.school_m2, 0.004 * as_it_is.echo_m2) << i;
    EXPECT_NEAR(corrected.cells[i].extinction_m2, as_it_is.echo_m2 - heard.cells[i].echo_m2, 0.004 * as_it_is.echo_m2)
        << i;
    EXPECT_LT(corrected.cells[i].extinction_low_m2, corrected.cells[i].extinction_m2 + 1e-15);
    EXPECT_GT(corrected.cells[i].extinction_high_m2, corrected.cells[i].extinction_m2 - 1e-15);
  }
  EXPECT_GT(cells, 20);
  // Behind both: 60 samples of 3e-3 and of 5e-4, 5.4 dB.
  const double gain = std::exp(kPerSv * 3.5e-3 * 60.0 * spacing_m());
  const CellSums& behind = corrected.at(4, 6);
  EXPECT_NEAR(behind.echo_m2 / heard.at(4, 6).echo_m2, gain, 0.004 * gain);
  // Whatever fades is as many times stronger.
  EXPECT_NEAR(behind.variance_m4 / heard.at(4, 6).variance_m4, gain * gain, 0.01 * gain * gain);
  EXPECT_EQ(behind.school_m2, 0.0);
}

// Fish take nothing of the background, which is not the water's but the receiver's.
TEST_F(IntegrateExtinction, of_the_background_nothing_is_given_back) {
  const Slabs slabs;
  constexpr double kNoise = 2e-7;
  const PingCells truth = integrated(slabs.sv(), false);
  const PingCells corrected = integrated(slabs.heard(spacing_m()), true, kNoise);
  EXPECT_NEAR(sum_of(corrected, &CellSums::echo_m2) / sum_of(truth, &CellSums::echo_m2), 1.0, 0.004);
  EXPECT_NEAR(corrected.at(4, 6).echo_m2 / truth.at(4, 6).echo_m2, 1.0, 0.01);
}

TEST_F(IntegrateExtinction, no_more_than_the_cap_is_given_back) {
  Slabs slabs;
  slabs.near_sv = 5e-2;  // 77 dB
  const std::vector<double> heard = slabs.heard(spacing_m());
  std::vector<double> loud_behind = heard;
  std::fill(loud_behind.begin() + 420, loud_behind.begin() + 640, 1e-6);
  const PingCells off = integrated(loud_behind, false);
  const PingCells on = integrated(loud_behind, true, 0.0, 3.0);
  EXPECT_NEAR(db_from_linear(on.at(4, 6).echo_m2 / off.at(4, 6).echo_m2), 3.0, 1e-6);
}

TEST_F(IntegrateExtinction, switched_off_or_without_schools_nothing_changes) {
  const std::vector<double> heard = Slabs{}.heard(spacing_m());
  const PingCells off = integrated(heard, false);
  EXPECT_EQ(sum_of(off, &CellSums::extinction_m2), 0.0);
  scene_.extinction.ratio = 50.0;
  EXPECT_EQ(integrated(heard, false).cells, off.cells);
  scene_.extinction.correct = true;
  scene_.schools.clear();
  const PingCells on = scene_.integrated({});
  scene_.extinction.correct = false;
  EXPECT_EQ(on.cells, scene_.integrated({}).cells);
}

// A member that was hit by noise takes sound out as its neighbours do; what stands in for it is the filtered volume, a
// median of exponential echo.
TEST_F(IntegrateExtinction, faulty_members_take_sound_out_too) {
  const std::vector<double> heard = Slabs{}.heard(spacing_m());
  const PingCells whole = integrated(heard, true);
  Array3<std::int16_t> filtered(scene_.sv.shape());
  for (int row = 0; row < 500; ++row) {
    for (std::size_t s = 0; s < kSamples; ++s) {
      filtered.view().row(row)[s] = count_from_linear(std::numbers::ln2 * heard[s]);
    }
    for (int s = 220; s < 240; ++s) scene_.flags.view().row(row)[static_cast<std::size_t>(s)] = SampleFlags::impulse;
  }
  const PingCells blind = integrated(heard, true);
  EXPECT_LT(blind.at(4, 6).echo_m2, 0.95 * whole.at(4, 6).echo_m2);
  scene_.filtered = &filtered;
  const PingCells filled = integrated(heard, true);
  EXPECT_NEAR(filled.at(4, 6).echo_m2 / whole.at(4, 6).echo_m2, 1.0, 0.004);
}

}  // namespace
}  // namespace sonar
