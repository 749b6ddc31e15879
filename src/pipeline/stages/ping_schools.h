// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "model/mask.h"
#include "pipeline/stages/engine.h"

namespace sonar {

/// A school's echo in one ping as detection finds it, before schools are followed over pings.
struct PingSchool {
  PingMask mask;
  double volume_m3 = 0.0;  ///< sum of its cells
};

/// One ping ready for detection, with its water as the pings round it tell it. What is found in it is what a run over the
/// whole observation finds there, and then follows over pings, where some of it is left out.
/// threads  any, once it is made
class PingBeforeDetection {
 public:
  /// Survey and observation outlive it.
  /// recipe  validated
  /// cost    stages the pings that tell the water, kGroupPings + 2 kGroupSide of them; the work is looked at between two
  /// errors  as Engine::staged(), of the ping itself; cancelled
  [[nodiscard]] static Result<std::shared_ptr<const PingBeforeDetection>> of(const SurveyFiles& survey,
                                                                             const ObservationFiles& observation,
                                                                             const Recipe& recipe,
                                                                             std::int64_t ping_index, Work& work);

  /// Under other parameters of detection than the recipe's, too: by first voxel, and nothing in a bad ping.
  [[nodiscard]] std::vector<PingSchool> schools(const DetectParams& params) const;

 private:
  PingBeforeDetection(const SurveyFiles& survey, const ObservationFiles& observation, const Recipe& recipe)
      : engine_(survey, observation, recipe) {}

  Engine engine_;
  std::optional<StagedPing> ping_;  ///< empty: it is bad
  WaterLevels water_;
};

}  // namespace sonar
