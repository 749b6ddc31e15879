// SPDX-License-Identifier: Apache-2.0
#include "session/maps/observation_head.h"

#include <fmt/format.h>

#include "pipeline/survey/beam_figures.h"

namespace sonar {

ObservationProduct observation_head(const ObservationFiles& observation) {
  ObservationProduct head;
  head.observation = observation.name;
  head.title = fmt::format("Fish schools of {} {}", observation.config.survey_name, observation.name);
  head.pings = observation.navigation;
  if (observation.grid) head.grid = grid_record(observation, {});
  return head;
}

}  // namespace sonar
