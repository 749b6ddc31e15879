// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/water_levels.h"

namespace sonar {

/// What a reduced raw file says of a beam of which it holds a part only. Stands behind the samples of its RAW0.
struct ReducedRow {
  float background_db = 0.0F;         ///< noise that was subtracted in the whole ping, dB re 1 W; NaN = none
  std::int32_t seabed_sample = 0;     ///< first sample that hears the seabed; the recorded count or more = none
  std::int32_t recorded_samples = 0;  ///< of the whole beam, offset included
  std::int32_t open_first = 0;  ///< from there on, its beam-edge echo before the seabed: schools may rise above it
  std::int32_t open_end = 0;    ///< ... up to here; no more than open_first = none
  friend bool operator==(const ReducedRow&, const ReducedRow&) = default;
};

/// The seabed's plane in the whole ping and where it was seen, as room school's Seabed has it; behind the record of a
/// reduced ping's first channel.
struct ReducedSeabed {
  double offset_m = 0.0;
  double slope_x = 0.0;
  double slope_y = 0.0;
  double min_x = 0.0;  ///< m
  double max_x = 0.0;
  double min_y = 0.0;
  double max_y = 0.0;
  friend bool operator==(const ReducedSeabed&, const ReducedSeabed&) = default;
};

/// What a reduced raw file says of a beam of which it holds nothing, though the beam was not whole: no channel, or one
/// that ended before the others. Behind the record of a reduced ping's first channel.
struct ReducedChannel {
  int channel = 0;  ///< 0-based
  ReducedRow row;
  friend bool operator==(const ReducedChannel&, const ReducedChannel&) = default;
};

/// What stands behind the samples of one channel of a reduced file; all but the row with a ping's first channel alone.
struct ReducedRecord {
  ReducedRow row;
  std::optional<ReducedSeabed> seabed = {};
  std::optional<WaterLevels> water = {};         ///< of the whole ping
  std::vector<ReducedChannel> short_beams = {};  ///< beams left out that end early
  friend bool operator==(const ReducedRecord&, const ReducedRecord&) = default;
};

}  // namespace sonar
