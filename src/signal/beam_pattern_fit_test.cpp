// SPDX-License-Identifier: Apache-2.0
#include "signal/beam_pattern_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "base/units.h"
#include "signal/level_misfit.h"

namespace sonar {
namespace {

constexpr int kFans = 5;
constexpr int kBeams = 6;
constexpr int kPings = 260;
constexpr double kSpacing = 0.05;
constexpr double kWidth = 0.1;  // beams overlap as an MS70's do

/// Numbers that look random and are the same everywhere: a linear congruence (Knuth's MMIX).
class Numbers {
 public:
  double uniform(double low, double high) {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return low + (high - low) * static_cast<double>(state_ >> 11U) / 9007199254740992.0;
  }
  double normal() {
    return std::sqrt(-2.0 * std::log(uniform(1e-12, 1.0))) * std::cos(2.0 * std::numbers::pi * uniform(0.0, 1.0));
  }

 private:
  std::uint64_t state_ = 1;
};

std::vector<FittedBeam> stated() {
  std::vector<FittedBeam> beams;
  for (int f = 0; f < kFans; ++f) {
    for (int b = 0; b < kBeams; ++b) beams.push_back({40.0, kWidth, kWidth, {kSpacing * b, kSpacing * f}});
  }
  return beams;
}

struct World {
  std::vector<FittedBeam> beams;
  PatternShape shape;
  std::vector<FaceDirection> at;  ///< [ping]
  std::vector<HeardLevel> heard;
};

/// A sphere anywhere over the beams and a little beyond; beams whose levels, widths and centres differ from those stated.
World world(double noise_db, double form) {
  Numbers numbers;
  World w;
  w.beams = stated();
  w.shape.k = {form, form, 0.0};
  for (FittedBeam& beam : w.beams) {
    beam.level_db += 1.5 * numbers.normal();
    beam.width_across *= 1.0 + 0.05 * numbers.normal();
    beam.width_up *= 0.9 + 0.05 * numbers.normal();
    beam.centre.across += 0.001 * numbers.normal();
    beam.centre.up += 0.001 * numbers.normal();
  }
  for (int p = 0; p < kPings; ++p) {
    const FaceDirection at{numbers.uniform(-0.05, kSpacing * (kBeams - 1) + 0.05),
                           numbers.uniform(-0.05, kSpacing * (kFans - 1) + 0.05)};
    w.at.push_back(at);
    for (std::size_t b = 0; b < w.beams.size(); ++b) {
      const FittedBeam& beam = w.beams[b];
      const double x = std::pow(2.0 * (at.across - beam.centre.across) / beam.width_across, 2);
      const double y = std::pow(2.0 * (at.up - beam.centre.up) / beam.width_up, 2);
      const double under = w.shape.db(x, y);
      if (under < -25.0) continue;
      w.heard.push_back({p, static_cast<int>(b), beam.level_db + under + noise_db * numbers.normal(), noise_db});
    }
  }
  return w;
}

TEST(PatternFit, BeamsAndDirectionsComeBackFromLevelsAlone) {
  const World w = world(0.01, 0.4);
  const PatternFit fit = fit_patterns(stated(), w.heard, kPings);
  EXPECT_NEAR(fit.shape.k[0], 0.4, 0.05);
  int crossed = 0;
  for (std::size_t b = 0; b < w.beams.size(); ++b) {
    if (!fit.crossed[b]) continue;
    ++crossed;
    EXPECT_NEAR(fit.beams[b].level_db, w.beams[b].level_db, 0.1) << b;
    EXPECT_NEAR(fit.beams[b].width_across / w.beams[b].width_across, 1.0, 0.02) << b;
    EXPECT_NEAR(fit.beams[b].width_up / w.beams[b].width_up, 1.0, 0.02) << b;
  }
  EXPECT_GE(crossed, (kFans - 2) * (kBeams - 2));  // outside the outermost too few beams hear the sphere
  for (std::size_t p = 0; p < w.at.size(); ++p) {
    if (!fit.used[p]) continue;
    EXPECT_NEAR(fit.directions[p].across, w.at[p].across, 0.003) << p;
    EXPECT_NEAR(fit.directions[p].up, w.at[p].up, 0.003) << p;
  }
}

TEST(PatternFit, StandardErrorsCoverTheTruth) {
  const World w = world(0.2, 0.0);
  const PatternFit fit = fit_patterns(stated(), w.heard, kPings);
  double sum = 0.0;
  double n = 0.0;
  for (std::size_t b = 0; b < w.beams.size(); ++b) {
    if (!fit.crossed[b]) continue;
    const double variance = fit.errors[b].covariance[BeamErrors::level_db][BeamErrors::level_db];
    sum += std::pow(fit.beams[b].level_db - w.beams[b].level_db, 2) / variance;
    n += 1.0;
  }
  ASSERT_GT(n, 10.0);
  EXPECT_GT(std::sqrt(sum / n), 0.5);
  EXPECT_LT(std::sqrt(sum / n), 1.5);
}

TEST(PatternFit, EchoesOfFishAreLeftOut) {
  World w = world(0.05, 0.0);
  const PatternFit clean = fit_patterns(stated(), w.heard, kPings);
  // In each tenth ping a fish lies beside the sphere: some of its beams hear more.
  std::vector<bool> disturbed(w.heard.size());
  for (std::size_t i = 0; i < w.heard.size(); ++i) {
    if (w.heard[i].ping % 10 != 0 || w.heard[i].beam % 2 != 0) continue;
    w.heard[i].level_db += 5.0;
    disturbed[i] = true;
  }
  const PatternFit fit = fit_patterns(stated(), w.heard, kPings);
  double largest = 0.0;
  for (std::size_t b = 0; b < w.beams.size(); ++b) {
    if (fit.crossed[b] && clean.crossed[b]) {
      largest = std::max(largest, std::abs(fit.beams[b].level_db - clean.beams[b].level_db));
    }
  }
  EXPECT_LT(largest, 0.3);
}

TEST(PatternFit, ABeamThatTheSphereOnlyBrushedIsNotCrossed) {
  World w = world(0.05, 0.0);
  std::erase_if(w.heard, [&](const HeardLevel& h) { return w.at[static_cast<std::size_t>(h.ping)].across > 0.1; });
  const PatternFit fit = fit_patterns(stated(), w.heard, kPings);
  for (std::size_t f = 0; f < kFans; ++f) {
    EXPECT_FALSE(fit.crossed[f * kBeams + 3]) << f;
    EXPECT_FALSE(fit.crossed[f * kBeams + 5]) << f;
    EXPECT_EQ(fit.beams[f * kBeams + 5].level_db, stated()[f * kBeams + 5].level_db);
  }
  EXPECT_TRUE(fit.crossed[2 * kBeams + 1]);
}

// Few noisy pings over a few beams that are all wider than stated: what many beams share holds the few (each with widths
// of its own, levels are off by up to 1.3 dB).
TEST(PatternFit, WidthsThatAllErrAlikeLeaveTheLevelsOfAFewBeamsRight) {
  World w = world(1.0, 0.0);
  std::vector<FittedBeam> narrow = stated();
  for (FittedBeam& beam : narrow) beam.width_across *= 0.72;
  std::erase_if(w.heard, [&](const HeardLevel& h) {
    const FaceDirection& at = w.at[static_cast<std::size_t>(h.ping)];
    return at.across > 0.17 || at.up > 0.15 || h.ping % 2 != 0;
  });
  const PatternFit fit = fit_patterns(narrow, w.heard, kPings);
  int crossed = 0;
  for (std::size_t b = 0; b < w.beams.size(); ++b) {
    if (!fit.crossed[b]) continue;
    ++crossed;
    EXPECT_NEAR(fit.beams[b].level_db, w.beams[b].level_db, 0.7) << b;
  }
  EXPECT_GE(crossed, 2);
}

// A level that noise lifted by 6 dB is told to be twice as sure as it is, one that noise lowered half as sure.
TEST(PatternFit, NoiseIsJudgedAgainstWhatShouldHaveBeenHeard) {
  const FittedBeam beam{40.0, kWidth, kWidth, {0.0, 0.0}};
  const auto weight = [&](double off_db, double told_se_db) {
    return misfit({0, 0, 40.0 + off_db, told_se_db}, beam, beam, {}, {0.0, 0.0}, 0.0).weight;
  };
  const double six_db = 20.0 * std::log10(2.0);
  EXPECT_NEAR(weight(six_db, 0.5), weight(0.0, 1.0), 1e-9);
  EXPECT_NEAR(weight(-six_db, 2.0), weight(0.0, 1.0), 1e-9);
}

TEST(PatternFit, NothingHeardChangesNothing) {
  const PatternFit fit = fit_patterns(stated(), {}, 3);
  EXPECT_EQ(fit.beams[7].level_db, stated()[7].level_db);
  EXPECT_FALSE(fit.crossed[7]);
  EXPECT_FALSE(fit.used[0]);
}

/// The Gaussian's integral by hand: pi / (8 ln 2) widths squared, less what lies beyond -25 dB (0.3 %).
TEST(PatternForm, PsiOfAGaussianBeamIsThatOfItsWidths) {
  const FittedBeam ahead{0.0, 0.06, 0.04, {0.0, 0.0}};
  const double psi = std::numbers::pi / (8.0 * std::numbers::ln2) * 0.06 * 0.04;
  EXPECT_NEAR(psi_sr(ahead, {}) / psi, 1.0, 0.006);
  // Steered aside a solid angle is larger by the cosine to the face.
  const FittedBeam aside{0.0, 0.06, 0.04, {0.5, 0.0}};
  EXPECT_NEAR(psi_sr(aside, {}) / psi, 1.0 / std::sqrt(0.75), 0.01);
}

}  // namespace
}  // namespace sonar
