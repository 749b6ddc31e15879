// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "io/simrad/raw0.h"

namespace sonar::simrad {

/// How one channel of a ping was sent and where its row ends, offset included.
struct SentChannel {
  double frequency_hz = 0.0;
  double transmit_power_w = 0.0;
  double pulse_length_s = 0.0;
  double sample_interval_s = 0.0;
  double sound_speed_mps = 0.0;
  double absorption_db_per_m = 0.0;
  int end = 0;
  bool shifted = false;  ///< has an offset that no reduction explains
  bool reduced = false;  ///< of a file that keeps but some channels
};
[[nodiscard]] SentChannel sent_channel(const ChannelPing& head, int count);

/// For each channel of a ping what of it disagrees with the others, or nullptr: a value that (almost) no other has where
/// nearly all share one or a few, or a row that its offset moves far beyond all others. A sounder sets many beams at
/// once; one of hundreds that differs is damage, and would cut an observation in two or make every row as long as its own.
/// Pings of fewer than ten channels are left as they are.
/// all_beams  (nearly) all beams are here; where but some were kept, the one that is left of a fan is not odd, and only rows
///            that lie far away are
/// cost  sorts the channels six times
[[nodiscard]] std::vector<const char*> odd_channels(std::span<const SentChannel> channels, bool all_beams);

}  // namespace sonar::simrad
