// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/time.h"
#include "model/reduced_record.h"

namespace sonar {

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
  int transmit_mode = 0;                      ///< 0 active, 1 passive, 2 test, -1 unknown
  int offset = 0;                             ///< index of the first stored sample
  std::span<const std::int16_t> power_count;  ///< [stored sample], 10 log10(2)/256 dB re 1 W; little-endian as stored
  std::optional<ReducedRecord> reduced;       ///< only in reduced files
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
