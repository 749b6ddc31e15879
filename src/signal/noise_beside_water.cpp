// SPDX-License-Identifier: Apache-2.0
#include "signal/noise_beside_water.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "base/check.h"

namespace sonar {
namespace {

constexpr double kQuartile = 0.25;
/// Of a normal distribution, below its mean, in standard deviations.
constexpr double kQuartileDepth = 0.674;

/// Sum of the weighted distances of the levels from a line, those below it counted three times as much.
double misfit(std::span<const double> sv, std::span<const double> gain, double water, double noise) {
  double sum = 0.0;
  for (std::size_t k = 0; k < sv.size(); ++k) {
    const double above = (sv[k] - water - noise * gain[k]) / sv[k];
    sum += above > 0.0 ? kQuartile * above : (kQuartile - 1.0) * above;
  }
  return sum;
}

}  // namespace

double uniform_water_sv(std::span<const double> sv, std::span<const double> gain) {
  SONAR_CHECK(sv.size() == gain.size());
  if (sv.size() < 2) return 0.0;
  double best_water = 0.0;
  double least = std::numeric_limits<double>::infinity();
  const auto look_at = [&](double water, double noise) {
    if (!(water >= 0.0 && noise >= 0.0)) return;
    const double found = misfit(sv, gain, water, noise);
    if (found >= least) return;
    least = found;
    best_water = water;
  };
  for (std::size_t i = 0; i < sv.size(); ++i) {
    look_at(0.0, sv[i] / gain[i]);
    look_at(sv[i], 0.0);
    for (std::size_t j = 0; j < i; ++j) {
      if (gain[i] == gain[j]) continue;
      const double noise = (sv[i] - sv[j]) / (gain[i] - gain[j]);
      look_at(sv[i] - noise * gain[i], noise);
    }
  }
  return best_water;
}

double noise_beside_water(std::span<const double> power, std::span<const double> water, std::span<const double> usual,
                          double spread) {
  SONAR_CHECK(!power.empty() && power.size() == water.size() && power.size() == usual.size());
  std::vector<std::pair<double, double>> left;  // power, weight
  double total = 0.0;
  for (std::size_t k = 0; k < power.size(); ++k) {
    left.emplace_back(power[k] - water[k], 1.0 / usual[k]);
    total += left.back().second;
  }
  std::ranges::sort(left);
  double weight = 0.0;
  auto quartile = left.begin();
  while (quartile + 1 != left.end() && (weight += quartile->second) < kQuartile * total) ++quartile;
  const double weakest = std::ranges::min(usual);
  return std::max(quartile->first + kQuartileDepth * spread * weakest, spread * weakest);
}

}  // namespace sonar
