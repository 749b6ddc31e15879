// SPDX-License-Identifier: Apache-2.0
#include "session/open/open_observation.h"

#include <utility>

namespace sonar {

namespace {

Shape3 shape_of(const ObservationFiles& observation) {
  return {observation.grid->fans(), observation.grid->beams(), observation.range.count};
}

}  // namespace

Result<void> room_for(const ObservationFiles& observation, std::uint64_t memory_bytes) {
  const auto reach = reach_within(memory_bytes, shape_of(observation), 0);
  if (!reach) return fail(reach.error().code, observation.name + ": " + reach.error().text);
  return {};
}

OpenObservation::OpenObservation(std::shared_ptr<const SurveyFiles> survey, std::size_t index, const Recipe& recipe,
                                 std::int64_t prefetch, std::uint64_t memory_bytes, std::shared_ptr<KnownPings> known)
    : survey_(std::move(survey)),
      index_(index),
      reach_(reach_within(memory_bytes, shape_of(survey_->observations[index]), prefetch)),
      known_(std::move(known)),
      engine_(*survey_, survey_->observations[index], recipe, known_.get()) {
  cache_ = std::make_unique<PingCache>([this](std::int64_t i) { return made(i); }, engine_.pings(), reach_.value_or(0));
  context_ = context_of(engine_, {0, engine_.pings() - 1});
  context_.ping = [this](std::int64_t i) -> Result<FilteredPing> {
    auto staged = ping(i);
    if (!staged) return pass_on(staged);
    return engine_.filtered(**staged);
  };
}

OpenObservation::OpenObservation(const OpenObservation& before, std::shared_ptr<const SurveyFiles> grown,
                                 std::int64_t prefetch, std::uint64_t memory_bytes)
    : OpenObservation(std::move(grown), before.index_, before.engine_.recipe(), prefetch, memory_bytes, before.known_) {
  identity_ = before.identity_;  // NOLINT(cppcoreguidelines-prefer-member-initializer): after a delegated constructor
}

OpenObservation::OpenObservation(std::shared_ptr<OpenObservation> chosen_on, const Recipe& measuring,
                                 std::int64_t prefetch, std::uint64_t memory_bytes)
    : survey_(chosen_on->survey_),
      index_(chosen_on->index_),
      chosen_on_(std::move(chosen_on)),
      reach_(reach_within(memory_bytes, shape_of(survey_->observations[index_]), prefetch)),
      identity_(chosen_on_->identity_),
      known_(chosen_on_->known_),
      engine_(*survey_, survey_->observations[index_], measuring, known_.get()),
      context_(chosen_on_->context_) {
  cache_ = std::make_unique<PingCache>([this](std::int64_t i) { return made(i); }, engine_.pings(), reach_.value_or(0));
}

std::string OpenObservation::title() const {
  const bool synthetic = files().config.survey_name.find("SYNTHETIC") != std::string::npos;
  return synthetic ? name() + " SYNTHETIC" : name();
}

void OpenObservation::estimate_background(std::int64_t ping_index) {
  // A window that is known is never written again, so that those who read it need no lock.
  const std::scoped_lock lock(estimating_);
  Work one(1);
  (void)engine_.estimate_background(ping_index, ping_index, one);
}

Result<StagedPingPtr> OpenObservation::made(std::int64_t ping_index) {
  if (ping_index < 0 || ping_index >= pings()) return fail(ErrorCode::usage, "there is no such ping");
  if (!reach_) return fail(reach_.error().code, name() + ": " + reach_.error().text);
  estimate_background(ping_index);
  auto staged = engine_.staged(ping_index);
  if (!staged) return pass_on(staged);
  return std::make_shared<const StagedPing>(std::move(*staged));
}

}  // namespace sonar
