// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/array.h"
#include "base/sample_flags.h"
#include "geo/frames.h"
#include "geo/sector.h"
#include "school/detect/noise_level.h"
#include "school/seabed/seabed.h"

namespace sonar {

/// What the seabed is looked for in; borrowed.
struct SeabedWater {
  View3<const std::int16_t> sv;  ///< median-filtered Sv counts
  View3<const SampleFlags> flags;
  const Background& background;
  const Sector& sector;
  const SeabedParams& params;
};

/// From which count on a sample of one beam is loud.
struct LoudLimit {
  int least = 0;
  int above_table = 0;
  const std::int16_t* table = nullptr;  ///< of the beam's calibration; null = background not known
  [[nodiscard]] int operator()(int sample) const {
    return table == nullptr || above_table + table[sample] < least ? least : above_table + table[sample];
  }
};
/// By level_db and above_background_db.
[[nodiscard]] LoudLimit loud_limit(const SeabedWater& water, int row);

/// A long strong echo along one beam.
struct SeabedEcho {
  int row = 0;
  int first_sample = 0;
  int peak_sample = 0;
  bool cut = false;  ///< still at its height where the beam ends: its middle lies there or beyond
  double peak_db = 0.0;
  double range_m = 0.0;  ///< of its strongest part
  Point<Sonar> place;
};

/// A beam's axis, or a direction so far below it; never beyond the vertical.
[[nodiscard]] Point<Sonar> beam_axis(const Sector& sector, int row, double lower_by_rad = 0.0);

/// Long echoes with a clear rise before them, by row.
[[nodiscard]] std::vector<SeabedEcho> long_echoes(const SeabedWater& water);

/// Those of them that may be the seabed: of beams that point down. Cut ones only where the record tells nothing else and
/// where all of a fan shows echoes.
[[nodiscard]] std::vector<SeabedEcho> seabed_echoes(const SeabedWater& water, std::vector<SeabedEcho> echoes);

}  // namespace sonar
