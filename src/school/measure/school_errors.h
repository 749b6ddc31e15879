// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/describe.h"
#include "model/mask.h"
#include "model/school.h"
#include "model/school_errors.h"
#include "school/measure/measure_input.h"
#include "school/measure/measure_params.h"
#include "school/measure/summarise.h"
#include "signal/median.h"

namespace sonar {

/// Standard errors of what is the same in all pings of a school, so that no mean makes it better.
struct ErrorParams {
  bool enabled = false;
  double threshold_db = 1.0;
  double calibration_db = 0.5;
  double sound_speed_percent = 0.5;
  double tilt_deg = 0.5;
};

template <class Visitor>
void describe(Visitor& v, ErrorParams& p) {
  v.field(
      "enabled", p.enabled,
      {.text =
           "Work out the standard error of each figure of a school by measuring it again under other fading and other "
           "thresholds; it takes several times as long as measuring."});
  v.field("threshold_db", p.threshold_db,
          {.unit = "dB",
           .min = 0,
           .max = 10,
           .text = "Standard error of the threshold that bounds a school: how differently two people would choose it; "
                   "set it to 0 where the threshold is part of the method."});
  v.field(
      "calibration_db", p.calibration_db,
      {.unit = "dB",
       .min = 0,
       .max = 20,
       .text =
           "Standard error of the calibration of Sv, gain and equivalent beam angle together, where the calibration "
           "table tells none. The default is an assumption, not a measurement; set it to what the sphere runs of "
           "your sonar scatter by."});
  v.field("sound_speed_percent", p.sound_speed_percent,
          {.unit = "%",
           .min = 0,
           .max = 10,
           .text = "Standard error of the sound speed that ranges are counted with: 0.5 is 7 m/s, what one value for a "
                   "whole season leaves open; lower it to 0.1 where a cast was taken."});
  v.field(
      "tilt_deg", p.tilt_deg,
      {.unit = "degrees",
       .min = 0,
       .max = 10,
       .text = "Standard error of the elevation of a beam, by roll, pitch and mounting; it is the error of depths."});
}

/// So many of a school's pings are measured again, spread evenly; a long school costs no more than these.
inline constexpr std::size_t kRepeatedPings = 6;
/// A standard error of so many degrees of freedom is known to 18 %: more would not show.
inline constexpr std::size_t kErrorFreedom = 15;
/// So many other fadings of a ping alone.
inline constexpr std::size_t kFadings = kErrorFreedom + 1;

/// How often the ping at a place among a school's is measured again under other fading; 0 = pings beside it stand for it.
[[nodiscard]] constexpr std::size_t fadings_of_ping(std::size_t place, std::size_t pings) {
  const std::size_t repeated = std::min(pings, kRepeatedPings);
  const std::size_t part = (2 * place + 1) * repeated / (2 * pings);
  if (place != (2 * part + 1) * pings / (2 * repeated)) return 0;
  return 1 + (kErrorFreedom + repeated - 1) / repeated;
}

/// Figures of one school in one ping as they would come out under other fading, under two other thresholds, below and above,
/// and last the cell_steps() of the ping. Empty = not known. In the place of a corrected volume stands its share of the mean of
/// the former.
using Repeats = std::vector<std::array<float, kErrorCount>>;

/// Figures that have a standard error, in the order of kErrorColumns.
[[nodiscard]] FigureValues figures_of(const SchoolPingRow& row);
[[nodiscard]] FigureValues figures_of(const SchoolRow& row);

/// Measures a school again, fadings + 2 times, by measure_row() and correct_sizes() themselves.
/// Fading: the echo is taken as its median-filtered level, smoothed, times exponential fading, which neighbouring voxels share as
/// they do (fading_field.h). That is filtered; the mask is where it lies above the mask's threshold, beside the mask that
/// was; a voxel that stands against the threshold (a human's) stays. The threshold moves with the school's loud part.
/// median   the filter that the mask was found in
/// tolerance_db  what confidences count from
/// seed     of the ping: the same for all its schools
/// fadings  by fadings_of_ping(); of none nothing is measured
/// threads  pure
/// cost     so many measurings, each with a median of the school's surroundings
/// source   parametric bootstrap (Efron & Tibshirani 1993, section 6.5)
[[nodiscard]] Repeats measure_repeats(const MeasureInput& ping, const PingMask& mask, const MedianParams& median,
                                      double tolerance_db, std::uint64_t seed, std::size_t fadings,
                                      const MeasureParams& measure, const ErrorParams& params);

/// Standard errors of a school's figures, in the order of kErrorColumns; NaN = unknown. Fading differs from ping to ping;
/// threshold, calibration, sound speed and tilt are alike in all. A ping that was not measured again scatters as the nearest one
/// that was, under fadings of its own. Unknown where none was.
/// What moves by whole cells may have stood still in all repeats, and yet not in the next: a step that none of n shows is taken
/// to come 0.5 times in n + 1 (Jeffreys' prior; Brown, Cai & DasGupta 2001, Statistical Science 16).
/// Corrected volumes scatter by shares, as one ping tells without its neighbours: pooled or not, the mean of n independent heights
/// scatters by the root of n less. Unknown where the looks at any of the pings hide it.
/// A count that no repeat changes has none: of 16, none may show what happens in one look of twenty.
/// rows     of the school, rising time
/// repeats  [row]; empty = not measured again
[[nodiscard]] FigureValues school_errors(std::span<const SchoolPingRow> rows, std::span<const Repeats* const> repeats,
                                         const SummariseParams& summary, const ErrorParams& params);

}  // namespace sonar
