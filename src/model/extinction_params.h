// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/describe.h"

namespace sonar {

struct ExtinctionParams {
  double ratio = 0.627;
  double ratio_low = 0.486;
  double ratio_high = 0.768;
  double most_db = 6.0;
  bool correct = false;
};

template <class Visitor>
void describe(Visitor& v, ExtinctionParams& p) {
  v.field("ratio", p.ratio,
          {.unit = "1",
           .min = 0,
           .max = 100,
           .text = "Extinction cross-section over 4 pi sigma_bs, the backscattering cross-section of older papers: "
                   "0.627 was found for sardine of 23 cm (Correction for shadowing within sardine schools). It differs "
                   "with species, length, frequency and aspect; 0 = nothing is lost."});
  v.field("ratio_low", p.ratio_low,
          {.unit = "1",
           .min = 0,
           .max = 100,
           .text = "Lower end of the ratio's interval of 95 %, for extinction_share_low: 0.486 for the same sardine."});
  v.field(
      "ratio_high", p.ratio_high,
      {.unit = "1",
       .min = 0,
       .max = 100,
       .text = "Upper end of the ratio's interval of 95 %, for extinction_share_high: 0.768 for the same sardine."});
  v.field("most_db", p.most_db,
          {.unit = "dB",
           .min = 0.1,
           .max = 20,
           .text = "Two-way loss above which no more is told or corrected, because what is heard there hardly depends "
                   "on the fish; raise it for ratios that are well known."});
  v.field(
      "correct", p.correct,
      {.text = "Measure schools, and integrate echo, as they would be without extinction; extinction_corrected is 1 in "
               "the rows of schools then. Switch it on only with a ratio for the fish and frequency at hand."});
}

}  // namespace sonar
