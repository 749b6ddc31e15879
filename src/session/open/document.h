// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "base/task_thread.h"
#include "base/work.h"
#include "model/index_cache.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/survey/survey.h"
#include "pipeline/tasks/results_alone.h"
#include "pipeline/tasks/work_folders.h"
#include "session/change_queue.h"
#include "session/listeners.h"
#include "session/open/open_survey.h"
#include "session/playing/right_of_way.h"

namespace sonar {

struct DocumentOptions {
  Recipe recipe;  ///< of surveys for which none was chosen
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

/// A survey at work: its files, one observation and ping on show, and every human choice. What takes long runs in the
/// background and comes back through the change queue. What is known of the survey that is open lives as long as it is.
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
  /// a run opens the survey that it was made of, under the run's recipe and with the run's schools: those of another version
  /// as it made them, with its figures as long as nothing but decisions is changed.
  /// first  done before, in the background too: what makes the files, say; empty = nothing
  void open(std::vector<std::filesystem::path> paths, std::function<Result<void>(Work&)> first = {}) {
    read({std::move(paths), std::move(first), std::nullopt, asked_recipe_, std::nullopt});
  }
  /// Opens the survey under another recipe, and keeps that beside its journals; the one that is being read, where one is;
  /// before one is open, the next.
  void use_recipe(Recipe recipe);
  /// errors  as named_recipe()
  Result<void> use_named_recipe(const std::string& path_or_preset);
  /// Of the survey that is open, before use_recipe() last changed it: what takes that back. Empty = it was not changed.
  [[nodiscard]] const std::optional<Recipe>& recipe_before() const { return survey_->read_.recipe_before; }
  /// Takes the survey with what came since; what is looked at and what was chosen stays. False, and nothing is taken, where
  /// it is not the same survey with more pings and observations behind.
  bool grow(std::shared_ptr<const SurveyFiles> survey) { return survey_->grow(std::move(survey)); }
  /// Ends what runs in the background; what was there before stays.
  void cancel();
  /// Whether another survey is being read, or this one anew.
  [[nodiscard]] bool opening() const { return opening_ != nullptr; }
  [[nodiscard]] const SurveyFiles* survey() const { return survey_files().get(); }
  /// The same, for whoever needs it beyond its end here.
  [[nodiscard]] const std::shared_ptr<const SurveyFiles>& survey_files() const { return survey_->read_.files; }
  /// What the files' ends tell of a survey that is being read while none is open (glance_at_survey()); else null.
  [[nodiscard]] const std::shared_ptr<const SurveyFiles>& glance() const { return glance_; }
  /// Reads the files of one of its observations alone: they are open while the rest would still be read.
  void open_glanced(std::size_t observation);
  /// Why nothing of the survey is shown, in a line; empty where something is, or no survey is open.
  [[nodiscard]] std::string nothing_shown() const { return survey_->nothing_shown(); }
  /// [observation] of results whose raw files are not here, as they were read; empty = pings can be read.
  [[nodiscard]] const std::vector<ProductPtr>& results() const { return survey_->read_.products; }
  /// The survey's raw files, and folders of them.
  [[nodiscard]] const std::vector<std::filesystem::path>& paths() const { return survey_->read_.paths; }
  /// What open() was given: those, or work folders of runs on them.
  [[nodiscard]] const std::vector<std::filesystem::path>& named() const { return survey_->read_.named; }
  [[nodiscard]] const std::filesystem::path& journal_path() const { return choices().journal; }
  /// What choices stand on.
  [[nodiscard]] const Recipe& recipe() const { return survey_->read_.recipe; }
  /// What Sv and measures follow: the recipe, under the calibration that a human has chosen.
  [[nodiscard]] Recipe measuring_recipe() const { return survey_->measuring_recipe(); }
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
  void run(std::function<void(Work&, const CancelToken&)> job) { run(std::move(job), nullptr); }
  /// Runs something short behind the window, beside what else runs there. It must not touch the document.
  void run_beside(std::function<void(const CancelToken&)> job) { (void)beside_.post(std::move(job)); }
  /// Taken by what a user waits for; what else runs behind the window gives way.
  [[nodiscard]] RightOfWay& right_of_way() { return way_; }
  /// Brings a change from such a job into the window's turn, unless another job has followed it.
  void post(const CancelToken& token, std::function<void()> change);

  // --- what is looked at
  /// ping    that is looked at first; out of range = the nearest end
  /// errors  usage: no such observation, or one without a grid
  Result<void> show(std::size_t observation, std::int64_t ping = 0) { return survey_->show(observation, ping); }
  /// The observation on show; null before there is one.
  [[nodiscard]] const OpenObservationPtr& shown() const { return survey_->shown_; }
  /// Null where it is not open.
  [[nodiscard]] OpenObservationPtr open_observation(std::size_t index) const {
    return survey_->open_observation(index);
  }
  /// Opens every observation with a grid, as a review of the whole survey needs it.
  void open_all() { survey_->open_all(); }
  /// Out of range = the nearest end.
  void look_at(std::int64_t ping_index) { survey_->look_at(ping_index); }
  /// The ping that is looked at; it may still be on its way.
  [[nodiscard]] std::int64_t ping() const { return survey_->ping_; }
  /// The ping that has arrived last; null before the first.
  [[nodiscard]] const StagedPingPtr& staged() const { return survey_->staged_; }

  // --- choices
  void act(Command command) { act(ping(), std::move(command)); }
  /// On the observation on show. What cannot be done is told as a notice and changes nothing.
  void act(std::int64_t ping_index, Command command) {
    if (shown()) act(shown()->index(), ping_index, std::move(command));
  }
  /// step  that the act is part of; null = it stands alone
  ActTicket act(std::size_t observation, std::int64_t ping_index, Command command,
                std::shared_ptr<JournalStep> step = nullptr) {
    return survey_->act(observation, ping_index, std::move(command), std::move(step));
  }
  void undo() { survey_->undo(); }
  void redo() { survey_->redo(); }
  void stop_propagation() { survey_->stop_propagation(); }
  [[nodiscard]] const ChoicesShown& choices() const { return survey_->choices_; }
  /// Of the observation on show; an empty one before it is known.
  [[nodiscard]] const JournalState& state() const {
    return state(shown() ? shown()->index() : static_cast<std::size_t>(-1));
  }
  [[nodiscard]] const JournalState& state(std::size_t observation) const { return survey_->state(observation); }
  /// Number of the school that a running propagation carries on; empty where it makes a new one.
  [[nodiscard]] std::optional<std::int64_t> followed() const { return survey_->followed_; }
  /// Masks of a propagation that runs on the observation on show, by ping; they are part of the state when it ends.
  [[nodiscard]] const std::map<std::int64_t, PingMask>& propagating() const { return survey_->propagating_; }
  [[nodiscard]] bool busy() const { return survey_->busy(); }

  // --- schools
  /// Looks for schools in one or in all observations, in the background; choices are laid upon what is found. However
  /// many they are, it is one step to undo.
  void detect(std::vector<std::size_t> observations) { survey_->detect(std::move(observations)); }
  /// Schools that were looked for elsewhere, as detect() takes them.
  void take_schools(std::size_t observation, const ObservationProduct& found) {
    survey_->take_schools(observation, found);
  }
  [[nodiscard]] bool detected(std::size_t observation) const { return survey_->detected(observation); }
  /// Whether the journal asks for schools of this observation.
  [[nodiscard]] bool asks_for_schools(std::size_t observation) const { return survey_->asks_for_schools(observation); }
  /// The journal asks for schools of this observation that were not looked for yet: its state is without them.
  [[nodiscard]] bool lacks_detected(std::size_t observation) const { return survey_->lacks_detected(observation); }
  /// What lay above the background where schools were looked for and is no school now: rows of /rejected. Never null.
  [[nodiscard]] RefusedPtr refused(std::size_t observation) const { return survey_->refused(observation); }
  /// What the tracker noted of the schools that were found, with their voxels: events_now() tells whom it is about now.
  /// Never null.
  [[nodiscard]] EventsPtr found_events(std::size_t observation) const { return survey_->found_events(observation); }
  /// Schools and their figures as far as they are measured; null where the observation is not open.
  [[nodiscard]] ProductPtr product(std::size_t observation) const { return survey_->product(observation); }
  /// What another version found, which the observation's schools come from; null where they are found by this one.
  [[nodiscard]] ProductPtr as_made(std::size_t observation) const { return survey_->as_made(observation); }

  /// Numbers of schools in the survey as its results last had them. Others follow in the order of observations, and are
  /// known when all are measured.
  [[nodiscard]] const std::vector<SurveyNumber>& survey_numbers() const { return survey_->survey_numbers_; }
  [[nodiscard]] bool all_measured() const { return survey_->all_measured(); }
  /// Why schools of an open observation could not be measured, as it was told; empty = nothing is known against it.
  /// open_all() tries again.
  [[nodiscard]] const std::string& unmeasured() const { return survey_->unmeasured(); }
  void keep_survey_numbers(std::vector<SurveyNumber> numbers) { survey_->keep_survey_numbers(std::move(numbers)); }

  /// Whether figures are on their way.
  [[nodiscard]] bool measuring() const { return survey_->measures_begun_ > 0; }

  /// Returns when nothing runs or waits in the background, its changes drained; for tests and the program's end.
  void settle();

 private:
  /// A survey that is being read.
  struct Opening {
    std::vector<std::filesystem::path> paths;
    std::function<Result<void>(Work&)> first;                     ///< what must be done before; may be empty
    std::optional<std::pair<std::size_t, std::int64_t>> back_to;  ///< see OpenSurvey::begin()
    std::shared_ptr<const Recipe> recipe;                         ///< null = the one that the survey was opened under
    std::optional<Recipe> recipe_before;                          ///< see SurveyRead
  };
  using OpeningPtr = std::shared_ptr<const Opening>;
  void read(Opening opening);
  /// opening  that the job is; null = another job, and what was being read is read no more
  void run(std::function<void(Work&, const CancelToken&)> job, const OpeningPtr& opening);
  void glance_at(const std::vector<std::filesystem::path>& paths, const Recipe& recipe, Work& work,
                 const CancelToken& token);
  [[nodiscard]] Result<JournalPlace> placed(const NamedToOpen& named, const std::vector<std::filesystem::path>& folders,
                                            const SurveyFiles& files, const Recipe& recipe) const;
  void add_sessions_beside(const std::filesystem::path& home, const std::vector<std::filesystem::path>& folders,
                           std::vector<std::filesystem::path>& sessions) const;
  [[nodiscard]] Result<ResultsAlone> survey_of(const NamedToOpen& named, const Recipe& recipe, Work& work) const;
  void end_with(const Error& error, const CancelToken& token, const OpeningPtr& opening);
  [[nodiscard]] Recipe recipe_of(const std::vector<std::filesystem::path>& folders, const CancelToken& token);
  /// recipe_chosen  it is kept beside the journals for the next time
  void take(SurveyRead read, bool recipe_chosen, const std::optional<std::pair<std::size_t, std::int64_t>>& back_to);

  ChangeQueue& queue_;
  DocumentOptions options_;
  OpeningPtr opening_;                          ///< null = nothing is being read
  std::shared_ptr<const Recipe> asked_recipe_;  ///< that the first survey is opened under; null = as others
  Listeners<DocumentChange> changes_;
  std::shared_ptr<const SurveyFiles> glance_;
  std::vector<std::string> notices_;
  Progress progress_;
  RightOfWay way_;
  std::shared_ptr<Work> work_;
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);  ///< changes that come after the end are dropped
  std::shared_ptr<OpenSurvey> survey_;                          ///< never null; without files before the first is open
  TaskThread beside_;
  TaskThread background_;  // the last members: they end first
};

}  // namespace sonar
