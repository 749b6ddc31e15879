// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/school.h"

namespace sonar {

/// Relative standard errors (1 = 100 %) of a number of fish. NaN = unknown, and not in the band.
struct NumberErrors {
  double own = kUnknown;          ///< of one school or stratum alone: fading, or what differs between transects
  double calibration = kUnknown;  ///< alike for all
  double lengths = kUnknown;      ///< alike for all
  /// Root of the sum of squares of those that are known; unknown where none is.
  [[nodiscard]] double together() const;
};

/// A figure, its standard error, and its band: 95 % of a lognormal of that error, widened on each side by as much as the
/// figure would change with the strongest and the weakest target strength that could be meant.
struct Banded {
  double value = kUnknown;
  double se = kUnknown;
  double low = kUnknown;
  double high = kUnknown;
};

/// strongest  value as it would be with the strongest target strength (the least number), <= value
/// weakest    ... and with the weakest, >= value
/// relative   standard error; unknown = the band tells only of the target strengths
[[nodiscard]] Banded banded(double value, double strongest, double weakest, double relative);

/// dB as a relative standard error: 10 log10 (1 + e), small e.
[[nodiscard]] double relative_of_db(double db);

}  // namespace sonar
