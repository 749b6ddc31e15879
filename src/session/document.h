// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "base/task_thread.h"
#include "base/work.h"
#include "model/product.h"
#include "pipeline/journal/state_product.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/survey/survey.h"
#include "pipeline/tasks/survey_numbers.h"
#include "session/change_queue.h"
#include "session/choices.h"
#include "session/listeners.h"
#include "session/open_observation.h"
#include "session/right_of_way.h"

namespace sonar {

struct DocumentOptions {
  Recipe recipe;
  std::string operator_name;
  std::string program_version;
  IndexCache cache;  ///< empty folder = none
  /// Where the journal of a survey in this folder goes: the first that can be written to holds it.
  std::function<std::vector<std::filesystem::path>(const std::filesystem::path& survey)> journal_folders;
  std::function<TimeNs()> clock;  ///< UTC now
  /// Observation and ping that a survey, as it was named, was left at: it begins there. Empty = at its first observation.
  std::function<std::optional<std::pair<std::string, std::int64_t>>(const std::vector<std::filesystem::path>& named)>
      left_at;
  std::function<std::string(std::string_view)> with_keys;  ///< of actions that notices name; empty = as they are
  std::int64_t prefetch = 5;                               ///< pings to each side that are made ahead
  int threads = 0;
  std::uint64_t memory_bytes = 0;  ///< for the pings of the observation on show; 0 = half of the machine's
};

/// What has changed, for whoever shows it.
enum class DocumentChange : std::uint8_t {
  survey,       ///< another survey is open, or none
  glance,       ///< what is known of the one that is being read
  observation,  ///< another observation is looked at, or one more is open
  looking,      ///< another ping is looked at and on its way
  ping,         ///< the ping that is looked at has arrived
  state,        ///< human choices, schools and masks
  propagating,  ///< a running propagation reached one more ping, or ended
  measures,     ///< the schools' figures
  progress,     ///< of what runs in the background
  notice,       ///< there is something to tell
};

struct Progress {
  std::string stage;  ///< empty = nothing runs
  std::int64_t done = 0;
  std::int64_t total = 0;
};

/// "obs-0002 cannot be shown: the beams make no product grid: ...".
/// observation  has no grid
[[nodiscard]] std::string why_no_grid(const ObservationFiles& observation);

using ProductPtr = std::shared_ptr<const ObservationProduct>;
using RefusedPtr = std::shared_ptr<const std::vector<RefusedEcho>>;

/// A survey at work: its files, one observation and ping on show, and every human choice. What takes long runs in the
/// background and comes back through the change queue.
/// threads  the window's
class Document {
 public:
  Document(ChangeQueue& queue, DocumentOptions options);
  ~Document();
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  [[nodiscard]] Listeners<DocumentChange>& changes() { return changes_; }

  // --- the survey
  /// Reads the survey in the background and then looks at its first observation; what was open is let go. A work folder of
  /// a run opens the survey that it was made of, under the run's recipe and with the run's schools.
  /// first  done before, in the background too: what makes the files, say; empty = nothing
  void open(std::vector<std::filesystem::path> paths, std::function<Result<void>(Work&)> first = {});
  /// Opens the survey under another recipe, and keeps that beside its journals; before one is open, the next.
  void use_recipe(Recipe recipe);
  /// Takes the survey with what came since; what is looked at and what was chosen stays. False, and nothing is taken, where
  /// it is not the same survey with more pings and observations behind.
  bool grow(std::shared_ptr<const SurveyFiles> survey);
  /// Ends what runs in the background; what was there before stays.
  void cancel();
  [[nodiscard]] const SurveyFiles* survey() const { return survey_.get(); }
  /// The same, for whoever needs it beyond its end here.
  [[nodiscard]] const std::shared_ptr<const SurveyFiles>& survey_files() const { return survey_; }
  /// What the files' ends tell of a survey that is being read while none is open (glance_at_survey()); else null.
  [[nodiscard]] const std::shared_ptr<const SurveyFiles>& glance() const { return glance_; }
  /// Reads the files of one of its observations alone: they are open while the rest would still be read.
  void open_glanced(std::size_t observation);
  /// Why nothing of the survey is shown, in a line; empty where something is, or no survey is open.
  [[nodiscard]] std::string nothing_shown() const;
  /// The survey's raw files, and folders of them.
  [[nodiscard]] const std::vector<std::filesystem::path>& paths() const { return paths_; }
  /// What open() was given: those, or work folders of runs on them.
  [[nodiscard]] const std::vector<std::filesystem::path>& named() const { return named_; }
  [[nodiscard]] const std::filesystem::path& journal_path() const { return journal_path_; }
  /// What choices stand on.
  [[nodiscard]] const Recipe& recipe() const { return options_.recipe; }
  /// What Sv and measures follow: the recipe, under the calibration that a human has chosen.
  [[nodiscard]] Recipe measuring_recipe() const;
  [[nodiscard]] const DocumentOptions& options() const { return options_; }
  /// For the pings of observations that are opened from now on, bytes; 0 = half of the machine's memory.
  void use_memory(std::uint64_t bytes) { options_.memory_bytes = bytes == 0 ? usual_memory() : bytes; }
  /// What a user must be told, oldest first.
  [[nodiscard]] const std::vector<std::string>& notices() const { return notices_; }
  void tell(std::string notice);
  [[nodiscard]] const Progress& progress() const { return progress_; }
  /// Whatever a user waits for: that, else a propagation, else the journal's lines, else measures.
  [[nodiscard]] Progress activity() const;
  /// Runs a job behind the window, with progress; one that runs is ended first. It must not touch the document.
  void run(std::function<void(Work&, const CancelToken&)> job);
  /// Runs something short behind the window, beside what else runs there. It must not touch the document.
  void run_beside(std::function<void(const CancelToken&)> job) { (void)beside_.post(std::move(job)); }
  /// Taken by what a user waits for; what else runs behind the window gives way.
  [[nodiscard]] RightOfWay& right_of_way() { return way_; }
  /// Brings a change from such a job into the window's turn, unless another job has followed it.
  void post(const CancelToken& token, std::function<void()> change);

  // --- what is looked at
  /// ping    that is looked at first; out of range = the nearest end
  /// errors  usage: no such observation, or one without a grid
  Result<void> show(std::size_t observation, std::int64_t ping = 0);
  /// The observation on show; null before there is one.
  [[nodiscard]] const OpenObservationPtr& shown() const { return shown_; }
  /// Null where it is not open.
  [[nodiscard]] OpenObservationPtr open_observation(std::size_t index) const;
  /// Opens every observation with a grid, as a review of the whole survey needs it.
  void open_all();
  /// Out of range = the nearest end.
  void look_at(std::int64_t ping_index);
  /// The ping that is looked at; it may still be on its way.
  [[nodiscard]] std::int64_t ping() const { return ping_; }
  /// The ping that has arrived last; null before the first.
  [[nodiscard]] const StagedPingPtr& staged() const { return staged_; }

  // --- choices
  void act(Command command) { act(ping_, std::move(command)); }
  /// On the observation on show. What cannot be done is told as a notice and changes nothing.
  void act(std::int64_t ping_index, Command command);
  /// step  that the act is part of; null = it stands alone
  ActTicket act(std::size_t observation, std::int64_t ping_index, Command command,
                std::shared_ptr<JournalStep> step = nullptr);
  void undo();
  void redo();
  void stop_propagation();
  [[nodiscard]] const ChoicesShown& choices() const { return choices_; }
  /// Of the observation on show; an empty one before it is known.
  [[nodiscard]] const JournalState& state() const;
  [[nodiscard]] const JournalState& state(std::size_t observation) const;
  /// Number of the school that a running propagation carries on; empty where it makes a new one.
  [[nodiscard]] std::optional<std::int64_t> followed() const { return followed_; }
  /// Masks of a propagation that runs on the observation on show, by ping; they are part of the state when it ends.
  [[nodiscard]] const std::map<std::int64_t, PingMask>& propagating() const { return propagating_; }
  [[nodiscard]] bool busy() const { return choices_thread_ && choices_thread_->busy(); }

  // --- schools
  /// Looks for schools in one or in all observations, in the background; choices are laid upon what is found. However
  /// many they are, it is one step to undo.
  void detect(std::vector<std::size_t> observations);
  /// Schools that were looked for elsewhere, as detect() takes them.
  void take_schools(std::size_t observation, const ObservationProduct& found);
  [[nodiscard]] bool detected(std::size_t observation) const { return detected_.contains(observation); }
  /// Whether the journal asks for schools of this observation.
  [[nodiscard]] bool asks_for_schools(std::size_t observation) const;
  /// The journal asks for schools of this observation that were not looked for yet: its state is without them.
  [[nodiscard]] bool lacks_detected(std::size_t observation) const;
  /// What lay above the background where schools were looked for and is no school now: rows of /rejected. Never null.
  [[nodiscard]] RefusedPtr refused(std::size_t observation) const;
  /// Schools and their figures as far as they are measured; null where the observation is not open.
  [[nodiscard]] ProductPtr product(std::size_t observation) const;

  /// Numbers of schools in the survey as its results last had them. Others follow in the order of observations, and are
  /// known when all are measured.
  [[nodiscard]] const std::vector<SurveyNumber>& survey_numbers() const { return survey_numbers_; }
  [[nodiscard]] bool all_measured() const;
  void keep_survey_numbers(std::vector<SurveyNumber> numbers);

  /// Whether figures are on their way.
  [[nodiscard]] bool measuring() const { return measures_begun_ > 0; }

  /// Returns when nothing runs or waits in the background, its changes drained; for tests and the program's end.
  void settle();

 private:
  /// What detection gave of one observation.
  struct Found {
    std::vector<SchoolMasks> schools;
    std::vector<RefusedEcho> refused;
    std::shared_ptr<const EarlierSchools> earlier;  ///< see earlier_found()
  };
  /// What was measured of an observation, in this session and, once read from the cache, before it.
  struct KeptMeasures {
    MeasuredPings measured;
    bool read = false;
  };
  void glance_at(const std::vector<std::filesystem::path>& paths, const Recipe& recipe, Work& work,
                 const CancelToken& token);
  void end_opening(const Error& error, const CancelToken& token);
  [[nodiscard]] Recipe recipe_of(const std::vector<std::filesystem::path>& folders, const CancelToken& token);
  [[nodiscard]] std::string key_of(const SurveyFiles& survey, const ObservationFiles& observation, Recipe recipe) const;
  [[nodiscard]] std::string key_of(OpenObservation& observation) const;
  [[nodiscard]] std::set<std::size_t> found_in(const std::vector<std::filesystem::path>& work_folders,
                                               const SurveyFiles& survey, const Recipe& recipe) const;
  void take_survey(std::shared_ptr<const SurveyFiles> survey, Result<JournalPlace> place,
                   const std::set<std::size_t>& found);
  void begin_where_it_was_left(std::size_t first);
  void await_schools(const std::vector<JournalLine>& lines, const std::set<std::size_t>& found);
  void take_choices(ChoicesShown shown);
  void take_step(std::size_t observation, std::int64_t ping_index, const PingMask& mask);
  OpenObservationPtr opened(std::size_t index);
  void detect_one(const std::shared_ptr<const SurveyFiles>& survey, std::size_t index,
                  const std::shared_ptr<JournalStep>& step, Work& work, const CancelToken& token);
  void take_detected(std::size_t index, Found found, const std::shared_ptr<JournalStep>& step);
  void follow_refused(const ChoicesShown& before);
  void look_at_others();
  void rest_unless_shown(std::size_t observation);
  void tell_unseen(const ChoicesShown& before);
  void tell_beyond_reach();
  void tell_lacking(const std::vector<std::size_t>& observations);
  void measure_changed(const ChoicesShown& before);
  void measure(std::size_t index);
  void measure_behind(const OpenObservationPtr& observation, const JournalState& state,
                      const std::vector<JournalLine>& lines, const RefusedPtr& refused, KeptMeasures& kept,
                      const CancelToken& token, Work& work);
  void keep_measures();
  void take_measured();
  void take_product(std::size_t observation, const ProductPtr& product);
  void follow_calibration();
  void replay_journal();
  [[nodiscard]] OpenObservationPtr calibrated(const OpenObservationPtr& chosen_on) const;

  ChangeQueue& queue_;
  DocumentOptions options_;
  Recipe usual_recipe_;                               ///< of surveys for which none was chosen
  std::vector<std::filesystem::path> opening_;        ///< what is being read; empty = nothing
  std::function<Result<void>(Work&)> opening_first_;  ///< what must be done before that is read; may be empty
  std::shared_ptr<const Recipe> asked_recipe_;        ///< that the next survey is opened under
  std::optional<std::pair<std::size_t, std::int64_t>> back_to_;  ///< observation and ping that it begins with
  Listeners<DocumentChange> changes_;
  std::vector<std::filesystem::path> paths_;
  std::vector<std::filesystem::path> named_;
  std::vector<std::filesystem::path> work_folders_;  ///< of runs, in which schools were found before
  std::shared_ptr<const SurveyFiles> survey_;
  std::shared_ptr<const SurveyFiles> glance_;
  std::filesystem::path journal_path_;
  std::vector<std::string> notices_;
  Progress progress_;
  std::map<std::size_t, OpenObservationPtr> chosen_on_;  ///< under the recipe: what choices stand on
  std::map<std::size_t, OpenObservationPtr> open_;       ///< the same, or under a calibration that a human chose
  std::set<std::size_t> unreplayed_;                     ///< of these the journal's lines wait until something is seen
  std::vector<std::size_t> undetected_;  ///< so does the detection that they ask for, and what runs found
  std::shared_ptr<const CalibrationParams> calibration_;
  OpenObservationPtr shown_;
  std::int64_t ping_ = 0;
  StagedPingPtr staged_;
  std::string unreadable_;  ///< why the ping that is looked at did not arrive; empty = it did, or may
  RightOfWay way_;
  ChoicesShown choices_;
  std::chrono::steady_clock::time_point others_looked_at_;
  std::map<std::int64_t, PingMask> propagating_;
  std::set<std::size_t> detected_;
  std::map<std::size_t, std::vector<RefusedEcho>> found_refused_;  ///< as detection told them
  std::map<std::size_t, RefusedPtr> refused_;                      ///< those of them that are no school now
  std::map<std::size_t, ProductPtr> products_;
  std::vector<SurveyNumber> survey_numbers_;
  std::map<std::size_t, std::shared_ptr<KeptMeasures>> measured_;
  std::shared_ptr<Work> work_;
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);  ///< changes that come after the end are dropped
  struct Measuring {
    CancelToken token;
    std::shared_ptr<Work> work;
    void cancel() const {
      token.cancel();
      work->cancel();
    }
  };
  std::map<std::size_t, Measuring> measuring_;
  Progress following_;  ///< a propagation's pings
  Progress replaying_;  ///< the journal's lines
  std::optional<std::int64_t> followed_;
  std::int64_t measures_begun_ = 0;
  std::int64_t measures_done_ = 0;
  std::unique_ptr<Choices> choices_thread_;
  TaskThread beside_;
  TaskThread measures_;
  TaskThread background_;  // the last members: they end first
};

}  // namespace sonar
