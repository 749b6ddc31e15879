// SPDX-License-Identifier: Apache-2.0
#include "signal/pattern_form.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/units.h"

namespace sonar {
namespace {

double square(double x) { return x * x; }

}  // namespace

double PatternShape::db(double x, double y) const {
  return -kHalfBothWays_db * (x + y) - k[0] * (x * x - x) - k[1] * (y * y - y) - k[2] * x * y;
}

double psi_sr(const FittedBeam& beam, const PatternShape& shape) {
  constexpr int kTurns = 72;
  constexpr double kStep = 0.02;  // of half a width
  constexpr double kLast_db = -25.0;
  constexpr double kFitted_db = -15.0;
  double sum = 0.0;
  for (int turn = 0; turn < kTurns; ++turn) {
    const double angle = 2.0 * std::numbers::pi * (turn + 0.5) / kTurns;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    double before = 0.0;
    for (double t = kStep / 2.0; t < 10.0; t += kStep) {
      const double db = shape.db(square(t * c), square(t * s));
      // Beyond where it was fitted the form must not rise again.
      if (db < kLast_db || (db < kFitted_db && db > before)) break;
      before = db;
      const double across = beam.centre.across + t * c * beam.width_across / 2.0;
      const double up = beam.centre.up + t * s * beam.width_up / 2.0;
      const double abeam = std::sqrt(std::max(1e-4, 1.0 - across * across - up * up));
      sum += linear_from_db(db) * t / abeam;
    }
  }
  return sum * kStep * (2.0 * std::numbers::pi / kTurns) * beam.width_across * beam.width_up / 4.0;
}

}  // namespace sonar
