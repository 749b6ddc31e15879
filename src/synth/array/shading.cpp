// SPDX-License-Identifier: Apache-2.0
#include "synth/array/shading.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sonar::synth::array {
namespace {

constexpr double kPi = std::numbers::pi;

std::vector<double> taylor(int n, double side_lobe_db) {
  constexpr int kNearLobes = 4;
  const double a = std::acosh(std::pow(10.0, -side_lobe_db / 20.0)) / kPi;
  const double widening = kNearLobes * kNearLobes / (a * a + (kNearLobes - 0.5) * (kNearLobes - 0.5));
  std::vector<double> weights(static_cast<std::size_t>(n), 1.0);
  for (int m = 1; m < kNearLobes; ++m) {
    double above = 1.0;
    double below = 1.0;
    for (int i = 1; i < kNearLobes; ++i) {
      above *= 1.0 - m * m / widening / (a * a + (i - 0.5) * (i - 0.5));
      if (i != m) below *= 1.0 - static_cast<double>(m * m) / (i * i);
    }
    const double f = (m % 2 == 1 ? 1.0 : -1.0) * above / (2.0 * below);
    for (int i = 0; i < n; ++i) {
      weights[static_cast<std::size_t>(i)] += 2.0 * f * std::cos(2.0 * kPi * m * (i - (n - 1) / 2.0) / n);
    }
  }
  return weights;
}

double chebyshev(int order, double x) {
  if (std::abs(x) <= 1.0) return std::cos(order * std::acos(x));
  const double t = std::cosh(order * std::acosh(std::abs(x)));
  return x < 0.0 && order % 2 == 1 ? -t : t;
}

std::vector<double> dolph(int n, double side_lobe_db) {
  const double x0 = std::cosh(std::acosh(std::pow(10.0, -side_lobe_db / 20.0)) / (n - 1));
  std::vector<double> weights;
  for (int i = 0; i < n; ++i) {
    double sum = 0.0;
    for (int k = 0; k < n; ++k) {
      // The half-sample shift keeps an even number of elements symmetric.
      sum += chebyshev(n - 1, x0 * std::cos(kPi * k / n)) * std::cos(2.0 * kPi * k * (i - (n - 1) / 2.0) / n);
    }
    weights.push_back(sum);
  }
  return weights;
}

}  // namespace

std::vector<double> shading_weights(Shading shading, int n, double side_lobe_db) {
  std::vector<double> weights(static_cast<std::size_t>(n), 1.0);
  if (shading == Shading::taylor) weights = taylor(n, side_lobe_db);
  if (shading == Shading::dolph) weights = dolph(n, side_lobe_db);
  const double most = *std::max_element(weights.begin(), weights.end());
  for (double& w : weights) w /= most;
  return weights;
}

}  // namespace sonar::synth::array
