// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "base/time.h"
#include "geo/sector.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/survey/survey.h"

namespace sonar {

/// One channel of one ping as Sv, as a sounder without a grid of beams has it (an EK60's frequencies).
struct ChannelSv {
  TimeNs time = 0;                   ///< datagram time
  RangeAxis range;                   ///< of this ping; channels and pings may differ
  std::vector<std::int16_t> counts;  ///< [sample], Sv counts; kNoData = none
};

/// Where a channel's samples lie under some settings.
/// samples  of the channel
[[nodiscard]] RangeAxis channel_range(const ObservationFiles& observation, const SurveyParams& params,
                                      const ChannelTransmit& settings, int samples);

/// Reads a ping and calibrates one of its channels by the sonar equation, with what the file and the recipe say of that
/// channel. No counts where the ping lacks the channel, or its calibration is not known.
/// channel  0-based
/// errors   io, format; `where` names file, byte and ping
/// threads  any
[[nodiscard]] Result<ChannelSv> load_channel_sv(const SurveyFiles& survey, const ObservationFiles& observation,
                                                std::size_t ping_index, int channel, const Recipe& recipe);

}  // namespace sonar
