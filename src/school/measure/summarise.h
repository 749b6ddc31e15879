// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "base/describe.h"
#include "model/school.h"
#include "school/measure/water_current.h"

namespace sonar {

struct SummariseParams {
  int min_speed_pings = 4;
  double min_speed_span_s = 15.0;
  double movement_window_s = 30.0;
};

template <class Visitor>
void describe(Visitor& v, SummariseParams& p) {
  v.field("min_speed_pings", p.min_speed_pings,
          {.unit = "pings",
           .min = 3,
           .max = 1000,
           .text = "A school has no speed if its centre is seen uncut in fewer pings than this; lower it for a fast "
                   "ship that passes schools in few pings, raise it where positions are noisy."});
  v.field("min_speed_span_s", p.min_speed_span_s,
          {.unit = "s",
           .min = 0,
           .max = 100000,
           .text = "A school has no speed if its centre is seen uncut over a shorter time than this; lower it for a "
                   "fast ship that passes schools quickly, raise it where positions are noisy."});
  v.field("movement_window_s", p.movement_window_s,
          {.unit = "s",
           .min = 1,
           .max = 100000,
           .text = "A school's movement at a ping is that of a line through its centres over this time, and what winds "
                   "within it is not seen as tortuosity; lower it for quick reactions, raise it where positions are "
                   "noisy."});
}

/// A school's row of schools.csv from its rows of school_pings.csv: pings that touch no edge where there are any, else
/// all; linear means of sv, medians of apparent sizes. Backscatter and corrected volume are linear means over those of
/// these pings that know both (where none does, backscatter is over all of them); corrected Sv is their ratio. Speed over
/// ground is that of a least-squares line through the centres of pings whose centre is not cut, less what their scatter
/// adds to the length of a vector; its standard error is that along the line, for scatter that is alike from ping to ping
/// (line_fit.h). Unknown values in a column are left out.
/// rows   of one school, rising time; not empty
/// water  speed through the water is that over ground less the drift along the track (water_current.h); null = unknown
[[nodiscard]] SchoolRow summarise(std::span<const SchoolPingRow> rows, const SummariseParams& params,
                                  const WaterCurrents* water = nullptr);

}  // namespace sonar
