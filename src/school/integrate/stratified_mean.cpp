// SPDX-License-Identifier: Apache-2.0
#include "school/integrate/stratified_mean.h"

#include <cmath>

namespace sonar {
namespace {

bool counts(double weight, double value) { return weight > 0.0 && std::isfinite(value); }

}  // namespace

MeanWithError transect_mean(std::span<const WeightedValue> transects) {
  double weights = 0.0;
  double sum = 0.0;
  int n = 0;
  for (const WeightedValue& one : transects) {
    if (!counts(one.weight, one.value)) continue;
    weights += one.weight;
    sum += one.weight * one.value;
    ++n;
  }
  if (n == 0) return {};
  MeanWithError out{sum / weights, kUnknown};
  if (n == 1) return out;
  double squares = 0.0;
  for (const WeightedValue& one : transects) {
    if (!counts(one.weight, one.value)) continue;
    const double part = one.weight / weights * (one.value - out.mean);
    squares += part * part;
  }
  out.se = std::sqrt(squares * n / (n - 1.0));
  return out;
}

MeanWithError stratified_mean(std::span<const WeightedMean> strata) {
  double weights = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  for (const WeightedMean& one : strata) {
    if (!counts(one.weight, one.of.mean)) continue;
    weights += one.weight;
    sum += one.weight * one.of.mean;
    squares += one.weight * one.weight * one.of.se * one.of.se;
  }
  if (!(weights > 0.0)) return {};
  return {sum / weights, std::sqrt(squares) / weights};
}

}  // namespace sonar
