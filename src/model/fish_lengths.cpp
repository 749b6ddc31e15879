// SPDX-License-Identifier: Apache-2.0
#include "model/fish_lengths.h"

#include <cmath>

namespace sonar {

FishLengths normal_lengths(double mean_cm, double sd_cm) {
  constexpr int kClasses = 20;  // to each side
  constexpr double kClass_sd = 0.2;
  FishLengths lengths;
  if (!(sd_cm > 0.0)) {
    lengths.classes.push_back({mean_cm, 1.0});
    return lengths;
  }
  double sum = 0.0;
  for (int i = -kClasses; i <= kClasses; ++i) {
    const double off_sd = kClass_sd * i;
    const double length_cm = mean_cm + off_sd * sd_cm;
    if (!(length_cm > 0.0)) continue;
    lengths.classes.push_back({length_cm, std::exp(-0.5 * off_sd * off_sd)});
    sum += lengths.classes.back().share;
  }
  for (LengthClass& of : lengths.classes) of.share /= sum;
  return lengths;
}

double WeightLength::weight_g(double length_cm) const { return a_g * std::pow(length_cm, b); }

double mean_weight_g(const FishLengths& lengths, const WeightLength& weight) {
  double sum = 0.0;
  for (const LengthClass& of : lengths.classes) sum += of.share * weight.weight_g(of.length_cm);
  return sum;
}

SamplingErrors sampling_errors(const FishLengths& lengths, const TsRelation& relation, const WeightLength& weight) {
  if (!(lengths.measured >= 2.0)) return {};
  const double mean_g = mean_weight_g(lengths, weight);
  double mean_m2 = 0.0;
  for (const LengthClass& of : lengths.classes) mean_m2 += of.share * relation.sigma_bs_m2(of.length_cm, 0.0);
  double of_sigma = 0.0;
  double of_ratio = 0.0;
  for (const LengthClass& of : lengths.classes) {
    const double sigma = relation.sigma_bs_m2(of.length_cm, 0.0) / mean_m2;
    const double grams = weight.weight_g(of.length_cm) / mean_g;
    of_sigma += of.share * (sigma - 1.0) * (sigma - 1.0);
    of_ratio += of.share * (grams - sigma) * (grams - sigma);
  }
  return {std::sqrt(of_sigma / (lengths.measured - 1.0)), std::sqrt(of_ratio / (lengths.measured - 1.0))};
}

}  // namespace sonar
