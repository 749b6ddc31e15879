// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/describe.h"
#include "view/sv_scale.h"

namespace sonar {

/// What timelines show of all beams, and in which display limits: a strong beam hides what a slice shows.
struct TimelineLimits {
  bool maximum = true;
  bool filtered = false;
  bool own_limits = false;
  double low_db = SvScale{}.low_db;
  double span_db = SvScale{}.span_db;
  /// With the colours and the threshold of the slices.
  /// of_maximum  a beam's own Sv, as in slices; else a mean, which begins lower
  [[nodiscard]] SvScale scale(SvScale of_slices, bool of_maximum) const {
    if (!of_maximum) of_slices.low_db = kMeansLow_db;
    if (own_limits) {
      of_slices.low_db = low_db;
      of_slices.span_db = span_db;
    }
    return of_slices;
  }
  [[nodiscard]] SvScale scale(const SvScale& of_slices) const { return scale(of_slices, maximum); }
};

template <class Visitor>
void describe(Visitor& v, TimelineLimits& p) {
  v.field("maximum", p.maximum, {.text = "the maximum over beams; off = their mean"});
  v.field("filtered", p.filtered, {.text = "Sv after the median filter, without noise; off = as recorded"});
  v.field("own_limits", p.own_limits,
          {.text = "timelines have limits of their own; off = as the slices, and of means from -75 dB"});
  v.field("low_db", p.low_db,
          {.unit = "dB", .min = -190, .max = 100, .text = "own limits: the first colour begins here"});
  v.field("span_db", p.span_db,
          {.unit = "dB", .min = 1, .max = 200, .text = "own limits: from the first colour to the last"});
}

}  // namespace sonar
