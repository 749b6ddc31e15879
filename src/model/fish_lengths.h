// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "model/school.h"
#include "model/ts_relation.h"

namespace sonar {

struct LengthClass {
  double length_cm = 0.0;  ///< > 0
  double share = 0.0;      ///< of the fish; all add up to 1
};

/// Lengths of fish, as a haul tells them.
struct FishLengths {
  std::vector<LengthClass> classes;  ///< not empty
  double measured = kUnknown;        ///< how many fish were measured; unknown where only shares are told
};

/// Lengths of a normal distribution, in classes a fifth of its deviation wide up to four deviations from its mean; lengths
/// that no fish has are left out. How many were measured is unknown.
/// mean_cm  > 0
/// sd_cm    0 = all are alike
[[nodiscard]] FishLengths normal_lengths(double mean_cm, double sd_cm);

/// W = a L^b, in grams of cm.
struct WeightLength {
  double a_g = kUnknown;
  double b = 3.0;
  [[nodiscard]] double weight_g(double length_cm) const;
};

/// The mean weight of a fish, g; unknown where a is.
[[nodiscard]] double mean_weight_g(const FishLengths& lengths, const WeightLength& weight);

/// Relative standard errors that follow from how few fish were measured, as if they had been drawn one by one at random; hauls
/// differ by more. Unknown below two fish.
struct SamplingErrors {
  double numbers = kUnknown;  ///< of 1 / mean sigma_bs
  double biomass = kUnknown;  ///< of mean weight / mean sigma_bs: the same fish tell both, so that part of it cancels
};
/// source  Cochran 1977, Sampling Techniques, section 2.11: the ratio of two means of one sample
[[nodiscard]] SamplingErrors sampling_errors(const FishLengths& lengths, const TsRelation& relation,
                                             const WeightLength& weight);

}  // namespace sonar
