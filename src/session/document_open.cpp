// SPDX-License-Identifier: Apache-2.0
// How a survey comes to be open: its files' ends first, then all of them, then what was chosen in it before.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/number_text.h"
#include "pipeline/journal/session_recipe.h"
#include "pipeline/stages/detected_cache.h"
#include "pipeline/stages/observe.h"
#include "pipeline/tasks/work_folders.h"
#include "session/document.h"

namespace sonar {
namespace {

/// Takes the recipe of a run, for schools that are detected when that is asked for. False where it is the same.
bool take_recipe(const std::optional<Recipe>& of_run, Recipe& recipe) {
  if (!of_run) return false;
  Recipe taken = *of_run;
  taken.automatic = false;
  if (recipe_hash(taken) == recipe_hash(recipe)) return false;
  recipe = std::move(taken);
  return true;
}

/// What a journal begins with.
Journal head_of(const SurveyFiles& files, const Recipe& recipe) {
  Journal head;
  head.recipe = recipe_text(recipe);
  head.recipe_hash = recipe_hash(recipe);
  for (const ObservationFiles& observation : files.observations) {
    for (InputFile& file : input_files(files, observation)) head.files.push_back(std::move(file));
  }
  return head;
}

}  // namespace

void Document::open(std::vector<std::filesystem::path> paths, std::function<Result<void>(Work&)> first) {
  if (std::exchange(glance_, nullptr)) changes_.tell(DocumentChange::glance);
  opening_first_ = first;
  run([this, paths, first = std::move(first), none = survey_ == nullptr, asked = asked_recipe_,
       back = std::exchange(back_to_, std::nullopt)](Work& work, const CancelToken& token) {
    if (const auto done = first ? first(work) : Result<void>{}; !done) return end_opening(done.error(), token);
    const auto named = told_apart(paths);
    if (!named) return end_opening(named.error(), token);
    const auto folders = options_.journal_folders && !named->raw.empty() ? options_.journal_folders(named->raw.front())
                                                                         : std::vector<std::filesystem::path>{};
    Recipe recipe = asked ? *asked : recipe_of(folders, token);
    recipe.automatic = false;  // schools are detected when that is asked for
    const bool of_run = !asked && take_recipe(named->recipe, recipe);
    if (none) glance_at(named->raw, recipe, work, token);
    auto survey = open_survey(named->raw, recipe.survey, recipe.navigation, options_.cache, work);
    if (!survey) return end_opening(survey.error(), token);
    auto files = std::make_shared<const SurveyFiles>(std::move(*survey));
    auto place = place_journal(folders, head_of(*files, recipe), options_.operator_name);
    if ((asked || of_run) && place) {
      const auto kept = keep_recipe(place->path.parent_path(), recipe);
      if (!kept) place->notices.push_back("the recipe is not kept: " + to_line(kept.error()));
    }
    if (of_run && place) {
      place->notices.push_back(fmt::format("from now on this survey is opened under the recipe of {}",
                                           named->work_folders.front().string()));
    }
    const auto found = found_in(named->work_folders, *files, recipe);
    post(token, [this, files, paths, named = *named, recipe, asked, back, found, place = std::move(place)] {
      paths_ = named.raw;
      named_ = paths;
      work_folders_ = named.work_folders;
      opening_.clear();
      if (asked == asked_recipe_) asked_recipe_.reset();
      options_.recipe = recipe;
      take_survey(files, place, found);
      if (back) (void)show(back->first, back->second);
    });
  });
  opening_ = std::move(paths);
}

void Document::end_opening(const Error& error, const CancelToken& token) {
  post(token, [this, line = to_line(error)] {
    opening_.clear();
    tell(line);
  });
}

void Document::use_recipe(Recipe recipe) {
  asked_recipe_ = std::make_shared<const Recipe>(std::move(recipe));
  if (!opening_.empty()) return open(opening_, opening_first_);
  if (!survey_) return;
  if (shown_) back_to_ = {shown_->index(), ping_};
  open(paths_);
}

/// The one that was chosen for a survey before, else the usual one.
Recipe Document::recipe_of(const std::vector<std::filesystem::path>& folders, const CancelToken& token) {
  const auto kept = kept_recipe(session_folders(folders));
  if (!kept) post(token, [this, line = to_line(kept.error())] { tell(line + "; the usual recipe is used"); });
  if (kept && *kept) {
    for (const std::string& note : (*kept)->notes) post(token, [this, note] { tell("the recipe: " + note); });
  }
  return kept ? kept->value_or(usual_recipe_) : usual_recipe_;
}

/// What ends in an error ends in the same when all is read.
void Document::glance_at(const std::vector<std::filesystem::path>& paths, const Recipe& recipe, Work& work,
                         const CancelToken& token) {
  auto glance = glance_at_survey(paths, recipe.survey, recipe.navigation, work);
  if (!glance) return;
  post(token, [this, seen = std::make_shared<const SurveyFiles>(std::move(*glance))] {
    if (survey_) return;  // it stays until the other is there
    glance_ = seen;
    changes_.tell(DocumentChange::glance);
  });
}

void Document::open_glanced(std::size_t observation) {
  if (!glance_ || observation >= glance_->observations.size()) return;
  std::vector<std::filesystem::path> files;
  for (const std::uint32_t file : glance_->observations[observation].files) files.push_back(glance_->files[file].path);
  open(std::move(files));
}

/// Of a find under this recipe.
std::string Document::key_of(const SurveyFiles& survey, const ObservationFiles& observation, Recipe recipe) const {
  recipe.automatic = true;
  return observation_key(survey, observation, recipe, {{}, {}, options_.program_version});
}

/// Observations whose schools one of these folders has as detect() would find them.
std::set<std::size_t> Document::found_in(const std::vector<std::filesystem::path>& work_folders,
                                         const SurveyFiles& survey, const Recipe& recipe) const {
  std::set<std::size_t> found;
  for (std::size_t i = 0; i < survey.observations.size() && !work_folders.empty(); ++i) {
    const ObservationFiles& observation = survey.observations[i];
    if (!product_in(work_folders, observation.name, key_of(survey, observation, recipe)).empty()) found.insert(i);
  }
  return found;
}

void Document::take_survey(std::shared_ptr<const SurveyFiles> survey, Result<JournalPlace> place,
                           const std::set<std::size_t>& found) {
  keep_measures();
  choices_thread_.reset();
  chosen_on_.clear();
  unreadable_.clear();
  unreplayed_.clear();
  undetected_.clear();
  open_.clear();
  calibration_.reset();
  shown_.reset();
  staged_.reset();
  choices_ = {};
  replaying_ = {};
  propagating_.clear();
  detected_.clear();
  found_refused_.clear();
  refused_.clear();
  products_.clear();
  survey_numbers_.clear();
  measured_.clear();
  glance_.reset();
  survey_ = std::move(survey);
  journal_path_ = place ? place->path : std::filesystem::path{};
  const std::vector<std::string> to_tell = place ? place->notices : std::vector{to_line(place.error())};
  const std::vector<JournalLine> all_lines = place ? place->lines : std::vector<JournalLine>{};
  const std::vector<JournalLine> lines = effective_lines(all_lines);
  choices_.lines = std::make_shared<const std::vector<JournalLine>>(all_lines);  // known before they are replayed
  choices_thread_ = std::make_unique<Choices>(
      queue_, place ? std::move(*place) : JournalPlace{},
      Choices::Options{options_.operator_name, options_.clock,
                       [this](std::int64_t done, std::int64_t total) {
                         replaying_ = {"reading the journal", done, total};
                         changes_.tell(DocumentChange::progress);
                       }},
      [this](ChoicesShown shown) { take_choices(std::move(shown)); },
      [this](std::size_t observation, std::int64_t ping_index, const PingMask& mask) {
        take_step(observation, ping_index, mask);
      });
  changes_.tell(DocumentChange::survey);
  for (const std::string& notice : to_tell) tell(notice);
  const auto& all = survey_->observations;
  const auto first = std::find_if(all.begin(), all.end(), [](const auto& one) { return one.grid.has_value(); });
  if (first == all.end()) {
    return tell(nothing_shown());
  }
  await_schools(lines, found);
  begin_where_it_was_left(static_cast<std::size_t>(first - all.begin()));
}

/// first  observation with a grid
void Document::begin_where_it_was_left(std::size_t first) {
  const auto left = options_.left_at ? options_.left_at(named_) : std::nullopt;
  const auto& all = survey_->observations;
  const auto there =
      std::find_if(all.begin(), all.end(), [&](const auto& one) { return left && one.name == left->first; });
  if (there != all.end() && show(static_cast<std::size_t>(there - all.begin()), left->second)) return;
  (void)show(first);
}

/// After the first picture come the schools that the journal asks for, and those that a run found.
/// found  in work folders
void Document::await_schools(const std::vector<JournalLine>& lines, const std::set<std::size_t>& found) {
  std::size_t lacking = 0;
  for (std::size_t i = 0; i < survey_->observations.size(); ++i) {
    const ObservationFiles& observation = survey_->observations[i];
    if (!observation.grid) continue;
    if (found.contains(i) || asks_for_detection(lines, datagram_times(*survey_, observation))) {
      undetected_.push_back(i);
    } else {
      ++lacking;
    }
  }
  if (lacking == 0 || work_folders_.empty()) return;
  tell(fmt::format(
      "{}: the schools of {} are not those of this version and recipe; [schools.detect_all] detects them again",
      work_folders_.front().string(), count_of(lacking, "observation")));
}

}  // namespace sonar
