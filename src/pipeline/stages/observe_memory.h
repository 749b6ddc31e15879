// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pipeline/stages/known_pings.h"
#include "pipeline/stages/measure_schools.h"

namespace sonar {

/// What observe() worked out the last time, when the observation had fewer pings. Changes no result, only how soon it is there.
struct ObserveMemory {
  KnownPings pings;
  MeasuredPings rows;
};

}  // namespace sonar
