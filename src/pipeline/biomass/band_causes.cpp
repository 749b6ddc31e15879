// SPDX-License-Identifier: Apache-2.0
#include "pipeline/biomass/band_causes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/units.h"

namespace sonar {
namespace {

/// The 95 % of a lognormal, as banded() has it.
CauseSpan of_error(double relative) {
  const double up = db_from_linear(banded(1.0, 1.0, 1.0, relative).high);
  if (!std::isfinite(relative)) return {};
  return {-up, up};
}

struct Sums {
  double numbers = 0.0;
  double own_variance = 0.0;
  double calibration = 0.0;
  double fewest_by_course = 0.0;
  double most_by_course = 0.0;
  std::vector<double> by_choice;
};

}  // namespace

BandCauses band_causes(std::span<const NumberedSchool> schools) {
  Sums sums;
  double lengths = kUnknown;
  for (const NumberedSchool& school : schools) {
    const double numbers = school.row.numbers;
    if (!school.counted || !(numbers > 0.0)) continue;
    sums.numbers += numbers;
    sums.own_variance += numbers * numbers * school.errors.own * school.errors.own;
    sums.calibration += numbers * school.errors.calibration;
    sums.fewest_by_course += school.fewest_by_course;
    sums.most_by_course += school.most_by_course;
    sums.by_choice.resize(school.by_choice.size());
    for (std::size_t i = 0; i < school.by_choice.size(); ++i) sums.by_choice[i] += school.by_choice[i];
    lengths = school.errors.lengths;
  }
  if (!(sums.numbers > 0.0)) return {};
  BandCauses causes;
  causes.fading = of_error(std::sqrt(sums.own_variance) / sums.numbers);
  causes.calibration = of_error(sums.calibration / sums.numbers);
  causes.lengths = of_error(lengths);
  causes.course = {db_from_linear(sums.fewest_by_course / sums.numbers),
                   db_from_linear(sums.most_by_course / sums.numbers)};
  causes.relation = {0.0, 0.0};
  for (const double by_choice : sums.by_choice) {
    const double off_db = db_from_linear(by_choice / sums.numbers);
    causes.by_choice_db.push_back(off_db);
    causes.relation.down_db = std::min(causes.relation.down_db, off_db);
    causes.relation.up_db = std::max(causes.relation.up_db, off_db);
  }
  return causes;
}

}  // namespace sonar
