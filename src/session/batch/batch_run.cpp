// SPDX-License-Identifier: Apache-2.0
// How the surveys of a batch are run, and what is told of it.
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <map>
#include <system_error>
#include <utility>

#include "base/machine_memory.h"
#include "base/number_text.h"
#include "base/within_memory.h"
#include "model/school_totals.h"
#include "pipeline/tasks/work_folders.h"
#include "session/batch/batch.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kBetweenTold{100};  ///< progress is drawn no more often

double seconds_since(Clock::time_point begun) { return std::chrono::duration<double>(Clock::now() - begun).count(); }

}  // namespace

std::string_view name(BatchState state) {
  switch (state) {
    case BatchState::waiting:
      return "waiting";
    case BatchState::running:
      return "running";
    case BatchState::done:
      return "done";
    case BatchState::partly:
      return "done in part";
    case BatchState::failed:
      return "failed";
    case BatchState::stopped:
      return "stopped";
  }
  return "";
}

std::string states_text(const Batch& batch) {
  std::map<BatchState, std::size_t> counts;
  for (const BatchSurvey& survey : batch.surveys()) ++counts[survey.state];
  std::string text = count_of(batch.surveys().size(), "survey");
  for (const auto& [state, count] : counts) {
    text += fmt::format("{} {} {}", state == counts.begin()->first ? ":" : ",", count, name(state));
  }
  return text;
}

Result<std::vector<fs::path>> Batch::to_be_replaced() const {
  const auto recipe = chosen_recipe();
  if (!recipe) return pass_on(recipe);
  const std::string hash = recipe_hash(*recipe);
  std::vector<fs::path> folders;
  for (const BatchSurvey& survey : surveys_) {
    if (has_others_results(survey, hash)) folders.push_back(survey.out);
  }
  return folders;
}

/// Of another recipe.
bool Batch::has_others_results(const BatchSurvey& survey, const std::string& hash) {
  std::error_code absent;
  if (survey.out.empty() || !fs::exists(survey.out / "products", absent)) return false;
  const auto plan = read_plan(survey.out / "plan.json");
  return plan && recipe_hash(plan->recipe) != hash;
}

Result<void> Batch::start() {
  if (running_) return {};
  if (surveys_.empty()) return fail(ErrorCode::usage, "no survey is in the list: add the folders of their raw files");
  for (const BatchSurvey& survey : surveys_) {
    if (!survey.out.empty()) continue;
    return fail(ErrorCode::usage, "has no folder for its results yet: choose one", {survey.paths.front().string()});
  }
  auto recipe = chosen_recipe();
  if (!recipe) return pass_on(recipe);
  const std::string hash = recipe_hash(*recipe);
  const auto is_left = [&](const BatchSurvey& one) { return one.state != BatchState::done || one.recipe_hash != hash; };
  const bool all = std::none_of(surveys_.begin(), surveys_.end(), is_left);
  for (BatchSurvey& survey : surveys_) {
    if (all || is_left(survey)) survey.state = BatchState::waiting;
  }
  for (const std::string& note : recipe_choice() == BatchRecipe::of_file ? recipe->notes : std::vector<std::string>{}) {
    tell(shown_line({RunLine::Kind::note, fmt::format("earlier-parameter: {}: {}", recipe_file_.string(), note)}));
  }
  auto replaced = to_be_replaced();
  if (!replaced) return pass_on(replaced);
  may_replace_ = std::move(*replaced);
  running_recipe_ = std::make_shared<const Recipe>(std::move(*recipe));
  running_ = true;
  stopping_ = false;
  begin_next();
  return {};
}

void Batch::stop() {
  if (!running_ || stopping_) return;
  stopping_ = true;
  work_->cancel();
  changed_.tell(BatchChange::surveys);
}

void Batch::begin_next() {
  // What came into the list meanwhile was not asked about.
  const std::string hash = recipe_hash(*running_recipe_);
  for (BatchSurvey& survey : surveys_) {
    if (survey.state != BatchState::waiting || !has_others_results(survey, hash)) continue;
    if (std::find(may_replace_.begin(), may_replace_.end(), survey.out) != may_replace_.end()) continue;
    survey.state = BatchState::failed;
    survey.why = "results under another recipe lie in its folder: the next start asks about them";
  }
  const auto next =
      std::find_if(surveys_.begin(), surveys_.end(), [](const auto& one) { return one.state == BatchState::waiting; });
  if (stopping_ || next == surveys_.end()) return end_all();
  begin(*next);
}

void Batch::begin(BatchSurvey& survey) {
  survey.state = BatchState::running;
  survey.progress = {};
  survey.schools.reset();
  survey.failed_observations = survey.failed_files = 0;
  survey.why.clear();
  survey.recipe_hash = recipe_hash(*running_recipe_);
  begun_ = Clock::now();
  tell(fmt::format("{}  {}: its results go to {}", now_text(), text_of(survey.paths), survey.out.string()));
  changed_.tell(BatchChange::surveys);
  const auto alive = std::weak_ptr<bool>(alive_);
  const auto progress = std::make_shared<RunProgress>();
  const std::int64_t id = survey.id;
  work_ = std::make_shared<Work>(jobs_);
  work_->set_progress([this, alive, progress, id, begun = begun_, told = Clock::time_point{},
                       give_way = GivesWay(document_.right_of_way())](std::string_view stage, std::int64_t done,
                                                                      std::int64_t total) mutable {
    progress->tell(stage, done, total);
    if (const auto now = Clock::now(); now - told >= kBetweenTold) {
      told = now;
      queue_.post_latest("batch progress", [this, alive, id, now = progress->now(seconds_since(begun))] {
        BatchSurvey* of = alive.expired() ? nullptr : find(id);
        if (of == nullptr || of->state != BatchState::running) return;
        of->progress = now;
        changed_.tell(BatchChange::progress);
      });
    }
    give_way();
  });
  const RunTelling telling{
      [this, alive](const RunLine& line) {
        queue_.post([this, alive, text = shown_line(line)] {
          if (!alive.expired()) tell(text);
        });
      },
      [progress, begun = begun_](const Plan& plan) { progress->plan(plan, seconds_since(begun)); }};
  RunSources sources{survey.paths, {}, {}, {}, document_.options().cache};
  sources.recipe = [recipe = running_recipe_](const Journal&) { return Result<Recipe>(*recipe); };
  RunOptions options;
  options.out = survey.out;
  options.program_version = document_.options().program_version;
  (void)runs_.post([this, alive, id, progress, begun = begun_, work = work_, sources = std::move(sources),
                    options = std::move(options), telling](const CancelToken&) {
    const auto run = [&]() -> Result<RunDone> {
      // Others may have come there since it was chosen.
      if (auto ours = require_results_of(options.out, sources.survey); !ours) return pass_on(ours);
      return run_survey(sources, options, telling, *work);
    };
    const auto done = [&]() -> Result<RunDone> {
      try {
        return within_memory(run);
      } catch (const std::exception& failure) {
        return fail(ErrorCode::io, failure.what());  // one survey fails, and neither the others nor the window
      }
    }();
    if (!done) telling.line({RunLine::Kind::failure, to_line(done.error())});
    Ended how = ended(done);
    how.progress = progress->now(seconds_since(begun));
    queue_.post([this, alive, id, how = std::move(how)] {
      if (!alive.expired()) end(id, how);
    });
    give_memory_back();
  });
}

Batch::Ended Batch::ended(const Result<RunDone>& done) {
  Ended how;
  if (!done) {
    how.state = done.error().code == ErrorCode::cancelled ? BatchState::stopped : BatchState::failed;
    if (how.state == BatchState::failed) how.why = to_line(done.error());
    return how;
  }
  for (const RunFailure& failure : done->report.failures) {
    ++(failure.observation ? how.failed_observations : how.failed_files);
  }
  if (!done->whole()) {
    how.state = done->nothing() ? BatchState::failed : BatchState::partly;
    const RunFailure& first = done->report.failures.front();
    how.why = (first.observation ? *first.observation + ": " : "") + to_line(first.error);
  }
  const auto& observations = done->merged->survey.observations;
  const bool any_grid = std::any_of(observations.begin(), observations.end(), [](const auto& one) { return one.grid; });
  if (done->looked_for_schools && any_grid) how.schools = counted_schools(observations).size();
  return how;
}

void Batch::end(std::int64_t id, const Ended& how) {
  if (BatchSurvey* survey = find(id)) {
    survey->state = how.state;
    survey->progress = how.progress;
    survey->schools = how.schools;
    survey->failed_observations = how.failed_observations;
    survey->failed_files = how.failed_files;
    survey->why = how.why;
    survey->took_s = seconds_since(begun_);
  }
  begin_next();
}

void Batch::end_all() {
  running_ = stopping_ = false;
  work_.reset();
  const std::string line = states_text(*this);
  tell(fmt::format("{}  {}", now_text(), line));
  changed_.tell(BatchChange::surveys);
  document_.tell("run of " + line);
}

double Batch::share() const {
  const auto bytes_of = [](const BatchSurvey& survey) {
    return survey.size ? static_cast<double>(survey.size->bytes) : 0.0;
  };
  const bool sized =
      std::any_of(surveys_.begin(), surveys_.end(), [&](const auto& one) { return bytes_of(one) > 0.0; });
  double done = 0.0;
  double all = 0.0;
  for (const BatchSurvey& survey : surveys_) {
    const double weight = sized ? bytes_of(survey) : 1.0;
    const bool ended = survey.state != BatchState::running && survey.state != BatchState::waiting;
    all += weight;
    done += weight * (ended ? 1.0 : survey.state == BatchState::running ? survey.progress.share : 0.0);
  }
  return all > 0.0 ? done / all : 0.0;
}

/// What waits takes its time by its bytes, as the one that runs does.
std::optional<double> Batch::left_s() const {
  double waiting = 0.0;
  const BatchSurvey* now = nullptr;
  for (const BatchSurvey& survey : surveys_) {
    if (survey.state == BatchState::running) now = &survey;
    if (survey.state == BatchState::waiting && survey.size) waiting += static_cast<double>(survey.size->bytes);
  }
  if (now == nullptr || !now->progress.left_s || !now->size || now->size->bytes == 0) return std::nullopt;
  const double whole_s = *now->progress.left_s / std::max(1.0 - now->progress.share, 1e-3);
  return *now->progress.left_s + whole_s * waiting / static_cast<double>(now->size->bytes);
}

void Batch::tell(std::string line) {
  log_.push_back(printable(std::move(line)));
  changed_.tell(BatchChange::log);
}

Result<void> Batch::save_log(const fs::path& file) const {
  for (const BatchSurvey& survey : surveys_) {
    if (auto outside = require_outside_raw(survey.paths, whole_path(file).parent_path()); !outside) return outside;
  }
  return write_log(file, log_);
}

std::string Batch::now_text() const {
  const auto& clock = document_.options().clock;
  return clock ? time_text(clock()).substr(0, 19) + " UTC" : std::string();
}

void Batch::settle() {
  do {
    looks_.wait();
    runs_.wait();
  } while (queue_.drain() > 0);
}

}  // namespace sonar
