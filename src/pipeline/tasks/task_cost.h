// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pipeline/survey/survey.h"

namespace sonar {

/// What a task is expected to take.
struct TaskCost {
  double cpu_s = 0.0;    ///< on one core like the one it was measured on
  double read_mb = 0.0;  ///< of raw files, 10^6 bytes
  double memory_mb = 0.0;
};

/// From what parts of run were measured to take (docs/cluster.md says when and on what): each ping's voxels, a ping's own
/// work, what is read, what is held for each thread and for each ping of an observation.
/// threads  that one task uses
[[nodiscard]] TaskCost task_cost(const SurveyFiles& survey, const ObservationFiles& observation, int threads);

}  // namespace sonar
