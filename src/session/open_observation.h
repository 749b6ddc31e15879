// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "pipeline/engine.h"
#include "pipeline/manual.h"
#include "pipeline/survey.h"
#include "session/ping_cache.h"

namespace sonar {

/// An observation at work: everything that pictures and choices stand on. Opening one reads nothing; each ping is read
/// when it is asked for, with the background levels of its neighbours.
/// threads  all members may be called from any thread
class OpenObservation {
 public:
  /// The observation has a grid.
  /// prefetch  pings to each side of the one looked at that are made ahead
  OpenObservation(std::shared_ptr<const SurveyFiles> survey, std::size_t index, const Recipe& recipe,
                  std::int64_t prefetch);

  [[nodiscard]] std::size_t index() const { return index_; }
  [[nodiscard]] const SurveyFiles& survey() const { return *survey_; }
  [[nodiscard]] const ObservationFiles& files() const { return survey_->observations[index_]; }
  [[nodiscard]] const std::string& name() const { return files().name; }
  [[nodiscard]] std::int64_t pings() const { return engine_.pings(); }
  [[nodiscard]] const Sector& sector() const { return engine_.sector(); }
  [[nodiscard]] const BeamGrid& grid() const { return engine_.grid(); }
  [[nodiscard]] Engine& engine() { return engine_; }
  /// What commands need; its pings come through the cache.
  [[nodiscard]] const CommandGround& ground() const { return ground_; }
  [[nodiscard]] PingCache& cache() { return *cache_; }

  /// All stages of a ping, from the cache or made now. errors: as Engine::staged()
  [[nodiscard]] Result<StagedPingPtr> ping(std::int64_t ping_index) { return cache_->ping(ping_index); }
  /// Makes sure that the background of a ping is known, as the engine's other calls need it.
  void estimate_background(std::int64_t ping_index);

 private:
  [[nodiscard]] Result<StagedPingPtr> made(std::int64_t ping_index);

  std::shared_ptr<const SurveyFiles> survey_;
  std::size_t index_;
  Engine engine_;
  std::mutex estimating_;
  CommandGround ground_;
  std::unique_ptr<PingCache> cache_;  // the last member: its thread ends first
};

}  // namespace sonar
