// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/time.h"
#include "model/water_levels.h"

namespace sonar {

/// What a reduced raw file says of a beam of which it holds a part only. Stands behind the samples of its RAW0.
struct ReducedRow {
  float background_db = 0.0F;         ///< noise that was subtracted in the whole ping, dB re 1 W; NaN = none
  std::int32_t seabed_sample = 0;     ///< first sample that hears the seabed; the recorded count or more = none
  std::int32_t recorded_samples = 0;  ///< of the whole beam, offset included
  std::int32_t open_first = 0;        ///< from there on, its flank before the ground: schools may stand out of it
  std::int32_t open_end = 0;          ///< ... up to here; no more than open_first = none
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

/// One channel of one ping: RAW0's header and a view of its power counts.
struct ChannelPing {
  int channel = 0;  ///< 0-based
  double transducer_depth_m = 0.0;
  double frequency_hz = 0.0;
  double transmit_power_w = 0.0;
  double pulse_length_s = 0.0;
  double bandwidth_hz = 0.0;
  double sample_interval_s = 0.0;
  double sound_speed_mps = 0.0;
  double absorption_db_per_m = 0.0;
  double heave_m = 0.0;  ///< positive down
  double roll_deg = 0.0;
  double pitch_deg = 0.0;
  double temperature_c = 0.0;
  double heading_deg = 0.0;  ///< 0 = absent
  int mode = 0;
  int transmit_mode = 0;                        ///< 0 active, 1 passive, 2 test, -1 unknown
  int offset = 0;                               ///< index of the first stored sample
  std::span<const std::int16_t> power_count;    ///< [stored sample], 10 log10(2)/256 dB re 1 W; little-endian as stored
  std::optional<ReducedRow> reduced;            ///< only in reduced files
  std::optional<ReducedSeabed> reduced_seabed;  ///< only beside `reduced`
  std::optional<WaterLevels> reduced_water;     ///< of the whole ping; only beside `reduced`
  std::vector<ReducedChannel> reduced_short;    ///< beams left out that end early; only beside `reduced`
};

/// Whether the channel listened only, or to a test signal: what it holds is no echo.
[[nodiscard]] inline bool is_silent(const ChannelPing& channel) {
  return channel.transmit_mode == 1 || channel.transmit_mode == 2;
}

/// A whole ping, with the bytes that its channels' spans point into. Values never change once published.
struct Ping {
  TimeNs time = 0;
  std::vector<ChannelPing> channels;                       ///< rising channel order; missing ones absent
  std::vector<std::shared_ptr<const std::byte[]>> blocks;  ///< owns what the spans view
};

}  // namespace sonar
