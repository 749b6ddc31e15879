// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "model/product.h"
#include "pipeline/journal/journal.h"
#include "pipeline/live/live_schools.h"
#include "pipeline/live/live_survey.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/stages/observe_memory.h"
#include "pipeline/tasks/merge.h"
#include "pipeline/tasks/plan.h"
#include "pipeline/tasks/run.h"

namespace sonar {

struct FollowOptions {
  std::vector<std::filesystem::path> survey;
  std::filesystem::path out;
  std::filesystem::path session;  ///< see read_session(), read again when it grows; empty = none
  std::string program_version;
  IndexCache cache;  ///< for indexes of files that are final
};

/// A survey worked on while it is recorded: the same stages as run(), on what is there. An observation's product is written
/// when it is over, and is the one that run() makes of the finished files; until then what is known of it is provisional, as
/// are its schools' numbers.
/// threads  one
class Follow {
 public:
  Follow(FollowOptions options, Recipe recipe);

  struct Look {
    LiveSurvey::News news;
    std::vector<std::string> finished;  ///< observations that were over, their products written
    std::vector<RunFailure> failures;   ///< tried again some seconds later
    std::vector<LiveSchool> schools;    ///< of the observations that go on: in their newest ping, or new
  };
  /// Takes in what came, works it out, writes the products of observations that are over.
  /// errors  cancelled; no_space, io: a product could not be written, what is known stays; bad_parameter
  [[nodiscard]] Result<Look> look(LiveClock::time_point now, Work& work);
  /// Writes what is known of observations that go on, the plan, the tables and the map.
  /// errors  no_space, io, mismatch
  [[nodiscard]] Result<MergeReport> write(Work& work);
  /// Nothing more will come: the next look ends every observation.
  void end() { live_.end(); }

  [[nodiscard]] std::shared_ptr<const SurveyFiles> survey() const { return live_.survey(); }
  [[nodiscard]] LiveClock::duration quiet(LiveClock::time_point now) const { return live_.quiet(now); }
  /// Whether something came since write().
  [[nodiscard]] bool unwritten() const { return unwritten_; }

 private:
  /// An observation whatever it is called: names shift when another sounder's, or a file before, comes in.
  using Which = std::pair<Sounder, TimeNs>;  ///< and its first ping
  struct AtWork {
    std::unique_ptr<ObserveMemory> memory = std::make_unique<ObserveMemory>();
    std::optional<ObservationProduct> product;  ///< the newest; empty once it is over
    PlanTask task;
    std::string key;  ///< of the product that is written
  };
  [[nodiscard]] static Which which(const SurveyFiles& survey, const ObservationFiles& observation);
  bool read_session();
  Result<void> work_on(const ObservationFiles& observation, Look& look, Work& work);
  Result<void> look_at_one(const ObservationFiles& observation, AtWork& at_work, Look& look, Work& work);
  Result<void> end_one(const ObservationFiles& observation, AtWork& at_work, Look& look, Work& work);
  [[nodiscard]] Result<ObservationProduct> observed(const ObservationFiles& observation, AtWork& at_work, bool over,
                                                    Work& work);
  [[nodiscard]] Result<void> hold_other(const std::filesystem::path& product, const std::string& key) const;
  void forget_vanished();
  void let_go();

  FollowOptions options_;
  Recipe recipe_;
  LiveSurvey live_;
  ReadJournal journal_;
  std::uintmax_t journal_size_ = 0;
  std::map<Which, AtWork> at_work_;
  std::vector<PlanTask> let_go_;  ///< of observations that are over and not looked at any more
  bool unworked_ = false;         ///< something came, and not all of it could be worked out
  LiveClock::time_point tried_at_{};
  bool unwritten_ = false;
};

}  // namespace sonar
