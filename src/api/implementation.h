// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "model/mask.h"
#include "model/volume.h"
#include "pipeline/stages/engine.h"
#include "pipeline/survey/survey.h"
#include "sonar_explorer/ping.h"
#include "sonar_explorer/survey.h"

namespace sonar_explorer {

/// What the public classes stand on.
struct Ping::Arrays {
  sonar::Array3<std::int16_t> power;
  sonar::StagedPing staged;
};

struct Observation::State {
  std::shared_ptr<const sonar::SurveyFiles> survey;
  const sonar::ObservationFiles* files = nullptr;  ///< of the survey
  Recipe recipe;
  int threads = 0;
  std::mutex estimating;                ///< of backgrounds
  std::optional<sonar::Engine> engine;  ///< empty without a grid

  [[nodiscard]] sonar::Engine& engine_or_throw();
};

}  // namespace sonar_explorer
