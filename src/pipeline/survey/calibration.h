// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "base/array.h"
#include "base/diagnostics.h"
#include "base/hash.h"
#include "model/ping.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/survey/beam_figures.h"
#include "pipeline/survey/survey.h"
#include "signal/calibrate.h"

namespace sonar {

/// What a beam's Sv is worked out with: gain and sa correction by pulse length from the sounder's tables, absorption by
/// the recipe, a user's calibration file over both.
/// head             of the ping's channel
/// given_speed_mps  a user's sound speed, in place of the head's; 0 = none
[[nodiscard]] ChannelCalibration channel_calibration(const BeamConfig& beam, const ChannelPing& head,
                                                     const CalibrationParams& params,
                                                     const BeamCalibration* beam_calibration,
                                                     double given_speed_mps = 0.0);

/// A head with what the observation's first ping set for a channel.
[[nodiscard]] ChannelPing first_head(const ObservationFiles& observation, std::size_t channel);

/// Tables [fan][beam][sample] that turn power counts into Sv counts, one for each set of transmit settings that occurs.
/// threads  any
class CalibrationTables {
 public:
  using Table = std::shared_ptr<const Array3<std::int16_t>>;

  CalibrationTables(const ObservationFiles& observation, const CalibrationParams& params);

  /// heads  RAW0 heads of a ping; a channel without one, or whose calibration is not sound, has kNoData in its row
  [[nodiscard]] Table of(std::span<const ChannelPing> heads);
  /// With what the observation's first ping set.
  [[nodiscard]] Table of_first_ping();
  /// From the observation's first settings: channels that cannot be calibrated, each named once, and whether pulses are
  /// in the gain tables; whether the stated beam angles can be.
  [[nodiscard]] Diagnostics diagnostics() const;

 private:
  [[nodiscard]] Table make(std::span<const ChannelPing> heads) const;
  void note_unmatched_gains(std::span<const std::size_t> channels, Diagnostics& notes) const;
  void note_computed_absorption(std::span<const std::size_t> channels, Diagnostics& notes) const;
  void note_impossible_psi(Diagnostics& notes) const;

  const ObservationFiles& observation_;
  CalibrationParams params_;
  UserCalibration users_;
  double given_speed_mps_;
  std::vector<int> row_of_channel_;
  std::mutex mutex_;
  std::map<Hash128, Table> tables_;
};

}  // namespace sonar
