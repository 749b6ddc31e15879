// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/describe.h"
#include "view/sv_scale.h"

namespace sonar {

/// Display limits of the timelines, which show the maximum of all beams: a strong beam hides what a slice shows.
struct TimelineLimits {
  bool own_limits = false;
  double low_db = SvScale{}.low_db;
  double span_db = SvScale{}.span_db;
  /// With the colours and the threshold of the slices.
  [[nodiscard]] SvScale scale(SvScale of_slices) const {
    if (own_limits) {
      of_slices.low_db = low_db;
      of_slices.span_db = span_db;
    }
    return of_slices;
  }
};

template <class Visitor>
void describe(Visitor& v, TimelineLimits& p) {
  v.field("own_limits", p.own_limits, {.text = "timelines have limits of their own; off = as the slices"});
  v.field("low_db", p.low_db,
          {.unit = "dB", .min = -190, .max = 100, .text = "own limits: the first colour begins here"});
  v.field("span_db", p.span_db,
          {.unit = "dB", .min = 1, .max = 200, .text = "own limits: from the first colour to the last"});
}

}  // namespace sonar
