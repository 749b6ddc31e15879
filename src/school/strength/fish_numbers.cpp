// SPDX-License-Identifier: Apache-2.0
#include "school/strength/fish_numbers.h"

#include <cmath>
#include <numbers>

namespace sonar {
namespace {

constexpr double kNormal95 = 1.959964;

}  // namespace

double NumberErrors::together() const {
  double sum = 0.0;
  bool known = false;
  for (const double error : {own, calibration, lengths}) {
    if (!std::isfinite(error)) continue;
    sum += error * error;
    known = true;
  }
  return known ? std::sqrt(sum) : kUnknown;
}

Banded banded(double value, double strongest, double weakest, double relative) {
  const double widen = std::isfinite(relative) ? std::exp(kNormal95 * relative) : 1.0;
  return {value, value * relative, strongest / widen, weakest * widen};
}

double relative_of_db(double db) { return db * (std::numbers::ln10 / 10.0); }

}  // namespace sonar
