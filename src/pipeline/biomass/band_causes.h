// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "pipeline/biomass/school_numbers.h"

namespace sonar {

/// How far a number of fish reaches for one reason alone, dB of the number: 0 = it adds nothing, NaN = unknown, not in the band.
struct CauseSpan {
  double down_db = kUnknown;  ///< <= 0
  double up_db = kUnknown;    ///< >= 0
};

/// What makes the band of a number of fish, each cause alone. Errors are told at 95 %; relations and courses at their extremes.
struct BandCauses {
  CauseSpan fading;
  CauseSpan calibration;
  CauseSpan lengths;
  CauseSpan course;                  ///< courses that schools may have, with the chosen relation
  CauseSpan relation;                ///< target strength relations that could be meant
  std::vector<double> by_choice_db;  ///< what the number would change by with each of FishChoice::choices
};

/// Of the numbers of schools together: those of one are {&school, 1}. Fading is independent between schools; all else is alike
/// for all of them. Schools without numbers are left out.
[[nodiscard]] BandCauses band_causes(std::span<const NumberedSchool> schools);

}  // namespace sonar
