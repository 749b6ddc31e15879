// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pipeline/survey/observations.h"

namespace sonar {

/// Marks pings none of whose channels transmitted.
void mark_silent_pings(const SurveyFiles& survey, ObservationFiles& observation);

/// Of RAW0 that the configuration promises and the files do not hold; reduced files leave beams out on purpose.
void note_missing_channels(const SurveyFiles& survey, ObservationFiles& observation);

/// Beams of a sounder that nobody knows, on a ship that rolls: whether they are stabilised is a guess.
void note_unused_attitude(ObservationFiles& observation);

}  // namespace sonar
