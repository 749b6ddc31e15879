// SPDX-License-Identifier: Apache-2.0
#include "session/batch/batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "pipeline/tasks/work_folders.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

std::size_t last_of(const std::vector<BatchSurvey>& surveys) { return surveys.empty() ? 0 : surveys.size() - 1; }

}  // namespace

Batch::Batch(ChangeQueue& queue, Document& document) : queue_(queue), document_(document) {}

Batch::~Batch() {
  if (work_) work_->cancel();
}

BatchSurvey* Batch::find(std::int64_t id) {
  const auto found = std::find_if(surveys_.begin(), surveys_.end(), [id](const auto& one) { return one.id == id; });
  return found == surveys_.end() ? nullptr : &*found;
}

Result<void> Batch::add(const std::vector<fs::path>& paths) {
  std::vector<fs::path> whole;
  for (const fs::path& path : paths) whole.push_back(whole_path(path));
  const auto named = named_surveys(whole);
  if (!named) return pass_on(named);
  Result<void> done;
  for (const NamedSurvey& survey : *named) {
    if (auto added = add_one(survey.paths, survey.out); !added && done) done = added;
  }
  changed_.tell(BatchChange::surveys);
  return done;
}

Result<void> Batch::add_survey(const std::vector<fs::path>& paths) {
  std::vector<fs::path> whole;
  for (const fs::path& path : paths) whole.push_back(whole_path(path));
  const auto added = add_one(whole, {});
  changed_.tell(BatchChange::surveys);
  return added;
}

void Batch::take_up(const std::vector<ListedSurvey>& surveys) {
  // Where results cannot go any more, the folder is asked for again.
  for (const ListedSurvey& one : surveys) (void)add_one(one.paths, one.out);
  changed_.tell(BatchChange::surveys);
}

std::vector<ListedSurvey> Batch::listed() const {
  std::vector<ListedSurvey> out;
  for (const BatchSurvey& one : surveys_) out.push_back({one.paths, one.out});
  return out;
}

Result<void> Batch::add_one(const std::vector<fs::path>& paths, const fs::path& out) {
  const auto same = [&](const BatchSurvey& other) { return places_of(other.paths) == places_of(paths); };
  if (std::any_of(surveys_.begin(), surveys_.end(), same)) {
    return fail(ErrorCode::usage, "is in the list already", {paths.front().string()});
  }
  BatchSurvey survey;
  survey.id = ++last_id_;
  survey.paths = paths;
  surveys_.push_back(std::move(survey));
  const std::size_t at = last_of(surveys_);
  look_at_size(surveys_[at]);
  if (!out.empty()) return set_out(at, out);
  surveys_[at].out = free_folder_beside(paths.front(), "-out",
                                        [&](const fs::path& folder) { return !require_free(at, folder).has_value(); });
  return {};
}

void Batch::look_at_size(const BatchSurvey& survey) {
  (void)looks_.post(
      [this, alive = std::weak_ptr<bool>(alive_), id = survey.id, paths = survey.paths](const CancelToken&) {
        const auto size = raw_size(paths);
        if (!size) return;
        queue_.post([this, alive, id, size = *size] {
          BatchSurvey* of = alive.expired() ? nullptr : find(id);
          if (of == nullptr) return;
          of->size = size;
          changed_.tell(BatchChange::surveys);
        });
      });
}

Result<void> Batch::remove(std::size_t at) {
  if (at >= surveys_.size()) return {};
  if (surveys_[at].state == BatchState::running) {
    return fail(ErrorCode::usage, "is running: stop it first", {surveys_[at].paths.front().string()});
  }
  surveys_.erase(surveys_.begin() + static_cast<std::ptrdiff_t>(at));
  changed_.tell(BatchChange::surveys);
  return {};
}

void Batch::move(std::size_t at, bool later) {
  if (at >= surveys_.size() || (later ? at + 1 == surveys_.size() : at == 0)) return;
  std::swap(surveys_[at], surveys_[later ? at + 1 : at - 1]);
  changed_.tell(BatchChange::surveys);
}

/// Whether a survey's results may go there.
Result<void> Batch::require_free(std::size_t at, const fs::path& folder) const {
  for (std::size_t i = 0; i < surveys_.size(); ++i) {
    const BatchSurvey& other = surveys_[i];
    if (auto outside = require_outside_raw(other.paths, folder); !outside) return outside;
    if (i == at || other.out.empty() || !are_nested(other.out, folder)) continue;
    return fail(ErrorCode::usage, fmt::format("results of {} go there", other.paths.front().string()),
                {folder.string()});
  }
  if (auto clear = require_not_beneath_raw(folder); !clear) return clear;
  return require_results_of(folder, surveys_[at].paths);
}

Result<void> Batch::set_out(std::size_t at, const fs::path& folder) {
  if (at >= surveys_.size()) return {};
  BatchSurvey& survey = surveys_[at];
  if (survey.state == BatchState::running) {
    return fail(ErrorCode::usage, "is running: its results stay where they are", {survey.paths.front().string()});
  }
  const fs::path whole = whole_path(folder);
  if (auto free = require_free(at, whole); !free) return free;
  if (survey.out != whole) survey.state = BatchState::waiting;
  survey.out = whole;
  changed_.tell(BatchChange::surveys);
  return {};
}

BatchRecipe Batch::recipe_choice() const {
  return recipe_ == BatchRecipe::of_window && document_.survey() == nullptr ? BatchRecipe::preset : recipe_;
}

Result<void> Batch::set_recipe(BatchRecipe choice, const fs::path& file) {
  if (choice == BatchRecipe::of_file) {
    if (const auto read = read_recipe(file.string()); !read) return pass_on(read);
    recipe_file_ = file;
  }
  recipe_ = choice;
  changed_.tell(BatchChange::surveys);
  return {};
}

Result<Recipe> Batch::chosen_recipe() const {
  switch (recipe_choice()) {
    case BatchRecipe::of_file:
      return read_recipe(recipe_file_.string());
    case BatchRecipe::preset:
      return named_recipe("");
    case BatchRecipe::of_window:
      break;
  }
  // The window finds schools when that is asked for, and here it is.
  Recipe recipe = document_.measuring_recipe();
  recipe.automatic = true;
  return recipe;
}

}  // namespace sonar
