// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "pipeline/journal/manual.h"
#include "pipeline/stages/engine.h"
#include "pipeline/survey/survey.h"
#include "session/open/ping_cache.h"
#include "session/open/ping_memory.h"

namespace sonar {

/// errors  no_space: not one ping of the observation, which has a grid, can be read within a budget
[[nodiscard]] Result<void> room_for(const ObservationFiles& observation, std::uint64_t memory_bytes);

/// An observation at work: everything that pictures and choices stand on. Opening one reads nothing; each ping is read
/// when it is asked for, with the background levels of its neighbours. Under another calibration pictures and measures are
/// of that one, while choices keep the context that they always had.
/// threads  all members may be called from any thread
class OpenObservation {
 public:
  /// The observation has a grid.
  /// prefetch      pings to each side of the one looked at that are made ahead
  /// memory_bytes  that its pings may take: fewer are made ahead, and where not even one fits, ping() says so
  OpenObservation(std::shared_ptr<const SurveyFiles> survey, std::size_t index, const Recipe& recipe,
                  std::int64_t prefetch, std::uint64_t memory_bytes = usual_memory())
      : OpenObservation(std::move(survey), index, recipe, prefetch, memory_bytes, std::make_shared<KnownPings>()) {}
  /// The same observation with the pings that came since.
  OpenObservation(const OpenObservation& before, std::shared_ptr<const SurveyFiles> grown, std::int64_t prefetch,
                  std::uint64_t memory_bytes = usual_memory());
  /// The same observation under another calibration.
  OpenObservation(std::shared_ptr<OpenObservation> chosen_on, const Recipe& measuring, std::int64_t prefetch,
                  std::uint64_t memory_bytes = usual_memory());

  [[nodiscard]] std::size_t index() const { return index_; }
  [[nodiscard]] const SurveyFiles& survey() const { return *survey_; }
  [[nodiscard]] const ObservationFiles& files() const { return survey_->observations[index_]; }
  /// Where a ping was made, with the attitude that its beams follow.
  [[nodiscard]] Placement placement(std::int64_t ping_index) const { return engine_.placement(ping_index); }
  /// As Engine::rays().
  [[nodiscard]] const std::shared_ptr<const Refraction>& rays() const { return engine_.rays(); }
  [[nodiscard]] const std::string& name() const { return files().name; }
  /// "obs-0001", with SYNTHETIC behind it where the data is.
  [[nodiscard]] std::string title() const;
  [[nodiscard]] std::int64_t pings() const { return engine_.pings(); }
  [[nodiscard]] const Sector& sector() const { return engine_.sector(); }
  [[nodiscard]] const BeamGrid& grid() const { return engine_.grid(); }
  [[nodiscard]] const Recipe& recipe() const { return engine_.recipe(); }
  [[nodiscard]] Engine& engine() { return engine_; }
  /// What commands need; its pings come through a cache.
  [[nodiscard]] const CommandContext& context() const { return context_; }
  /// Whether pictures and measures follow another calibration than choices.
  [[nodiscard]] bool recalibrated() const { return chosen_on_ != nullptr; }
  /// The same object for the same observation, whatever its calibration and however many pings it has by now.
  [[nodiscard]] const std::shared_ptr<const int>& identity() const { return identity_; }
  [[nodiscard]] PingCache& cache() { return *cache_; }

  /// Its pings leave the memory: nobody looks at it.
  void rest() {
    cache_->rest();
    engine_.rest();
  }

  /// All stages of a ping, from the cache or made now. errors: as Engine::staged()
  [[nodiscard]] Result<StagedPingPtr> ping(std::int64_t ping_index) { return cache_->ping(ping_index); }
  /// Makes sure that the background of a ping is known, as the engine's other calls need it.
  void estimate_background(std::int64_t ping_index);

 private:
  OpenObservation(std::shared_ptr<const SurveyFiles> survey, std::size_t index, const Recipe& recipe,
                  std::int64_t prefetch, std::uint64_t memory_bytes, std::shared_ptr<KnownPings> known);
  [[nodiscard]] Result<StagedPingPtr> made(std::int64_t ping_index);

  std::shared_ptr<const SurveyFiles> survey_;
  std::size_t index_;
  std::shared_ptr<OpenObservation> chosen_on_;  ///< null = this one
  Result<std::int64_t> reach_;                  ///< of the cache, or why no ping can be read
  std::shared_ptr<const int> identity_ = std::make_shared<const int>(0);
  std::shared_ptr<KnownPings> known_;  ///< goes on with the observation as it grows
  Engine engine_;
  std::mutex estimating_;
  CommandContext context_;
  std::unique_ptr<PingCache> cache_;  // the last member: its thread ends first
};

/// Whether two are the same observation, whatever its calibration and however many pings it has; null is like null.
[[nodiscard]] inline bool same_observation(const std::shared_ptr<OpenObservation>& a,
                                           const std::shared_ptr<OpenObservation>& b) {
  return a && b ? a->identity() == b->identity() : !a && !b;
}

}  // namespace sonar
