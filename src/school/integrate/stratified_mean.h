// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "model/school.h"

namespace sonar {

/// A figure of a transect and what it weighs: its length.
struct WeightedValue {
  double weight = 0.0;
  double value = kUnknown;
};

/// A mean and its standard error; NaN = unknown.
struct MeanWithError {
  double mean = kUnknown;
  double se = kUnknown;
};

/// Mean over the transects of a stratum, weighted by their lengths, and its standard error from what differs between them:
/// n / (n - 1) times the sum of w^2 (x - mean)^2, the weights w adding up to 1. Known from two transects on. Values that are
/// not known, and weights of 0, take no part.
/// threads  pure
/// source   Jolly & Hampton 1990, Can. J. Fish. Aquat. Sci. 47:1282-1291
[[nodiscard]] MeanWithError transect_mean(std::span<const WeightedValue> transects);

/// Mean over strata, weighted; the strata's errors are independent. The error is known where that of every stratum is.
struct WeightedMean {
  double weight = 0.0;
  MeanWithError of;
};
[[nodiscard]] MeanWithError stratified_mean(std::span<const WeightedMean> strata);

}  // namespace sonar
