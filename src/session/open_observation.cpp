// SPDX-License-Identifier: Apache-2.0
#include "session/open_observation.h"

#include <utility>

namespace sonar {

OpenObservation::OpenObservation(std::shared_ptr<const SurveyFiles> survey, std::size_t index, const Recipe& recipe,
                                 std::int64_t prefetch)
    : survey_(std::move(survey)), index_(index), engine_(*survey_, survey_->observations[index], recipe) {
  cache_ = std::make_unique<PingCache>([this](std::int64_t i) { return made(i); }, engine_.pings(), prefetch);
  ground_ = ground_of(engine_, {0, engine_.pings() - 1});
  ground_.ping = [this](std::int64_t i) -> Result<FilteredPing> {
    auto staged = ping(i);
    if (!staged) return pass_on(staged);
    return FilteredPing{(*staged)->filtered, engine_.placement(i), ground_.times[static_cast<std::size_t>(i)], {}};
  };
}

void OpenObservation::estimate_background(std::int64_t ping_index) {
  // A window that is known is never written again, so that those who read it need no lock.
  const std::scoped_lock lock(estimating_);
  Work one(1);
  (void)engine_.estimate_background(ping_index, ping_index, one);
}

Result<StagedPingPtr> OpenObservation::made(std::int64_t ping_index) {
  if (ping_index < 0 || ping_index >= pings()) return fail(ErrorCode::usage, "there is no such ping");
  estimate_background(ping_index);
  auto staged = engine_.staged(ping_index);
  if (!staged) return pass_on(staged);
  return std::make_shared<const StagedPing>(std::move(*staged));
}

}  // namespace sonar
