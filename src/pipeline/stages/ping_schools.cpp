// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/ping_schools.h"

#include <utility>

#include "pipeline/stages/group_water.h"
#include "school/detect/detect.h"

namespace sonar {

Result<std::shared_ptr<const PingBeforeDetection>> PingBeforeDetection::of(const SurveyFiles& survey,
                                                                           const ObservationFiles& observation,
                                                                           const Recipe& recipe,
                                                                           std::int64_t ping_index, Work& work) {
  std::shared_ptr<PingBeforeDetection> made(new PingBeforeDetection(survey, observation, recipe));
  Engine& engine = made->engine_;
  if (engine.is_bad(ping_index)) return made;
  const PingWindow window = group_window(ping_index, engine.pings());
  if (auto done = engine.estimate_background(window.first, window.last, work); !done) return pass_on(done);
  auto water = GroupWater(engine, &work).of(ping_index);
  if (!water) return pass_on(water);
  auto ping = engine.staged(ping_index);
  if (!ping) return pass_on(ping);
  made->water_ = std::move(*water);
  made->ping_ = std::move(*ping);
  engine.rest();
  return made;
}

std::vector<PingSchool> PingBeforeDetection::schools(const DetectParams& params) const {
  std::vector<PingSchool> schools;
  if (!ping_) return schools;
  for (Detection& found : detect(engine_.echo(*ping_, water_), params)) {
    schools.push_back({std::move(found.mask), found.volume_m3});
  }
  return schools;
}

}  // namespace sonar
