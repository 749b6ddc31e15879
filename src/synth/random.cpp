// SPDX-License-Identifier: Apache-2.0
#include "synth/random.h"

#include <cmath>
#include <numbers>

namespace sonar::synth {

double RandomStream::normal() {
  const double radius = std::sqrt(-2.0 * std::log(uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

int RandomStream::poisson(double mean) {
  double left = std::exp(-mean);
  int events = 0;
  for (double p = uniform(); p > left; p *= uniform()) ++events;
  return events;
}

}  // namespace sonar::synth
