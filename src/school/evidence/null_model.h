// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/array.h"
#include "geo/sector.h"
#include "model/water_levels.h"
#include "school/detect/noise_level.h"
#include "school/seabed/seabed.h"

namespace sonar {

/// One ping as its water is judged by; the means and the seabed are borrowed.
struct WaterPing {
  const Array3<std::int16_t>* means = nullptr;  ///< block_means() of block_samples()
  const Seabed* seabed = nullptr;               ///< null = none found
  Background noise;
  bool asked = true;  ///< false = it tells of the others' water alone
};

/// The water of neighbouring pings, and what lies above it in each: the null model of that place and hour.
///
/// For each place of a fan the water is what most beams of most pings return there, in ship-fixed coordinates: its
/// median, or that of the rest where most is a school. The excess over that (or over a beam's own noise, where that is louder) and over the patch it lies in, in
/// spreads, is averaged over 3 x 3 beams and judged by its own median and spread. At the first look the spread is that
/// downwards, which schools do not move; what lies above it is left out of the next looks, which take that upwards.
/// window  pings in order; all of one shape
/// least   cells of less evidence are not listed
/// out     [ping of the window]; nothing known of those that are not asked for
/// threads pure
/// cost    about 1 ms for each ping of 25 x 20 x 1320
[[nodiscard]] std::vector<WaterLevels> water_levels(std::span<const WaterPing> window, const Sector& sector,
                                                    double least);

}  // namespace sonar
