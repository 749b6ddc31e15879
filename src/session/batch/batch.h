// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/task_thread.h"
#include "base/work.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/tasks/named_surveys.h"
#include "pipeline/tasks/run_survey.h"
#include "session/batch/batch_progress.h"
#include "session/listeners.h"
#include "session/open/document.h"
#include "session/words/preferences.h"

namespace sonar {

enum class BatchState : std::uint8_t {
  waiting,
  running,
  done,
  partly,  ///< some observations or files failed, the others are done
  failed,
  stopped,  ///< by a human; what was finished stays
};

enum class BatchRecipe : std::uint8_t {
  of_window,  ///< that of the open survey, under the calibration that was chosen in it; the default where none is open
  preset,     ///< the default
  of_file,
};

enum class BatchChange : std::uint8_t {
  surveys,   ///< the list, or how one of it stands
  progress,  ///< how far the one that runs is
  log,       ///< lines came
};

/// A survey to be run, or how its run ended.
struct BatchSurvey {
  std::int64_t id = 0;
  std::vector<std::filesystem::path> paths;  ///< a folder of raw files, or raw files
  std::filesystem::path out;                 ///< where results go; empty = nobody has said where yet
  std::optional<RawSize> size;               ///< empty = not known yet, or it cannot be read
  BatchState state = BatchState::waiting;
  BatchProgress progress;
  std::optional<std::size_t> schools;  ///< empty = schools were not looked for, or not yet
  std::size_t failed_observations = 0;
  std::size_t failed_files = 0;
  double took_s = 0.0;
  std::string why;          ///< of what failed, the first line
  std::string recipe_hash;  ///< that it was run under last
};

/// Surveys that are run one after another behind the window, each as `sonarx run SURVEY --out OUT` runs it: one pipeline, the
/// same products. One that fails stops no other.
/// threads  the window's
class Batch {
 public:
  /// The document lends its recipe, its version and its right of way; both outlive the batch.
  Batch(ChangeQueue& queue, Document& document);
  ~Batch();
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;

  [[nodiscard]] const std::vector<BatchSurvey>& surveys() const { return surveys_; }
  /// What the paths stand for, see named_surveys().
  /// errors  usage: one is in the list already (the others are taken); as named_surveys()
  Result<void> add(const std::vector<std::filesystem::path>& paths);
  /// One survey of all the paths, as a window has them open together.
  /// errors  usage: it is in the list already; as set_out()
  Result<void> add_survey(const std::vector<std::filesystem::path>& paths);
  /// What was listed when the window was closed, whether it can be reached now or not; nothing of it counts as done.
  void take_up(const std::vector<ListedSurvey>& surveys);
  /// The same of now, to be kept.
  [[nodiscard]] std::vector<ListedSurvey> listed() const;
  /// errors  usage: it is running
  Result<void> remove(std::size_t at);
  /// Changes places with the one before or after it.
  void move(std::size_t at, bool later);
  /// errors  usage: raw files lie there, another survey's results do or go there, or it is running
  Result<void> set_out(std::size_t at, const std::filesystem::path& folder);

  /// file  of a recipe; of of_file alone
  /// errors  as read_recipe(): what was chosen before stays
  Result<void> set_recipe(BatchRecipe choice, const std::filesystem::path& file = {});
  [[nodiscard]] BatchRecipe recipe_choice() const;
  [[nodiscard]] const std::filesystem::path& recipe_file() const { return recipe_file_; }
  /// Threads of a run; 0 = all of the machine's, as of `sonarx run`.
  void set_jobs(int jobs) { jobs_ = jobs; }
  [[nodiscard]] int jobs() const { return jobs_; }

  /// Folders that hold results of their survey under another recipe, which would be replaced.
  /// errors  those of the recipe
  [[nodiscard]] Result<std::vector<std::filesystem::path>> to_be_replaced() const;
  /// Runs what is not done under this recipe; where all is, all, in which what is right stays.
  /// errors  usage: nothing is listed, or a survey has no folder for its results; those of the recipe
  Result<void> start();
  /// As Ctrl-C stops `sonarx run`: what is half made goes, finished observations stay.
  void stop();
  [[nodiscard]] bool running() const { return running_; }
  [[nodiscard]] bool stopping() const { return stopping_; }

  /// Of all together, 0 to 1, by the size of their files.
  [[nodiscard]] double share() const;
  /// Empty where nobody can know.
  [[nodiscard]] std::optional<double> left_s() const;
  /// What the runs told: the lines of `sonarx run`, below a head for each survey.
  [[nodiscard]] const std::vector<std::string>& log() const { return log_; }
  /// The log as a text file.
  /// errors  usage: it would lie with raw files; io, no_space
  [[nodiscard]] Result<void> save_log(const std::filesystem::path& file) const;
  [[nodiscard]] Listeners<BatchChange>& changed() { return changed_; }

  /// Returns when nothing runs or waits, its changes drained; for tests.
  void settle();

 private:
  /// What a run came to, without what it made.
  struct Ended {
    BatchState state = BatchState::done;
    BatchProgress progress;
    std::optional<std::size_t> schools;
    std::size_t failed_observations = 0;
    std::size_t failed_files = 0;
    std::string why;
  };
  Result<void> add_one(const std::vector<std::filesystem::path>& paths, const std::filesystem::path& out);
  void look_at_size(const BatchSurvey& survey);
  [[nodiscard]] Result<void> require_free(std::size_t at, const std::filesystem::path& folder) const;
  [[nodiscard]] Result<Recipe> chosen_recipe() const;
  [[nodiscard]] static bool has_others_results(const BatchSurvey& survey, const std::string& recipe_hash);
  void begin_next();
  void begin(BatchSurvey& survey);
  void end(std::int64_t id, const Ended& ended);
  void end_all();
  void tell(std::string line);
  [[nodiscard]] std::string now_text() const;
  [[nodiscard]] BatchSurvey* find(std::int64_t id);
  [[nodiscard]] static Ended ended(const Result<RunDone>& done);

  ChangeQueue& queue_;
  Document& document_;
  std::vector<BatchSurvey> surveys_;
  std::int64_t last_id_ = 0;
  BatchRecipe recipe_ = BatchRecipe::of_window;
  std::filesystem::path recipe_file_;
  int jobs_ = 0;
  std::shared_ptr<const Recipe> running_recipe_;
  std::vector<std::filesystem::path> may_replace_;  ///< folders with results of another recipe when the run was started
  bool running_ = false;
  bool stopping_ = false;
  std::chrono::steady_clock::time_point begun_;
  std::vector<std::string> log_;
  Listeners<BatchChange> changed_;
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);  ///< changes that come after the end are dropped
  std::shared_ptr<Work> work_;
  TaskThread looks_;
  TaskThread runs_;  // the last members: they end first
};

/// "5 surveys: 4 done, 1 failed".
[[nodiscard]] std::string states_text(const Batch& batch);
/// "waiting", "done in part".
[[nodiscard]] std::string_view name(BatchState state);

}  // namespace sonar
