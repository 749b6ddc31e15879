// SPDX-License-Identifier: Apache-2.0
// How a survey comes to be open: its files' ends first, then all of them, then what was chosen in it before.
#include <algorithm>
#include <utility>

#include "pipeline/journal/session_recipe.h"
#include "pipeline/stages/detected_cache.h"
#include "pipeline/stages/observe.h"
#include "session/document.h"

namespace sonar {

void Document::open(std::vector<std::filesystem::path> paths, std::function<Result<void>(Work&)> first) {
  if (std::exchange(glance_, nullptr)) changes_.tell(DocumentChange::glance);
  opening_first_ = first;
  run([this, paths, first = std::move(first), none = survey_ == nullptr, asked = asked_recipe_,
       back = std::exchange(back_to_, std::nullopt)](Work& work, const CancelToken& token) {
    if (const auto done = first ? first(work) : Result<void>{}; !done) {
      return post(token, [this, line = to_line(done.error())] {
        opening_.clear();
        tell(line);
      });
    }
    const auto folders = options_.journal_folders && !paths.empty() ? options_.journal_folders(paths.front())
                                                                    : std::vector<std::filesystem::path>{};
    Recipe recipe = asked ? *asked : recipe_of(folders, token);
    recipe.automatic = false;  // schools are detected when that is asked for
    if (none) glance_at(paths, recipe, work, token);
    auto survey = open_survey(paths, recipe.survey, recipe.navigation, options_.cache, work);
    if (!survey) {
      return post(token, [this, line = to_line(survey.error())] {
        opening_.clear();
        tell(line);
      });
    }
    auto files = std::make_shared<const SurveyFiles>(std::move(*survey));
    Journal head;
    head.recipe = recipe_text(recipe);
    head.recipe_hash = recipe_hash(recipe);
    for (const ObservationFiles& observation : files->observations) {
      for (InputFile& file : input_files(*files, observation)) head.files.push_back(std::move(file));
    }
    auto place = place_journal(folders, head, options_.operator_name);
    if (asked && place) {
      const auto kept = keep_recipe(place->path.parent_path(), recipe);
      if (!kept) place->notices.push_back("the recipe is not kept: " + to_line(kept.error()));
    }
    post(token, [this, files, paths, recipe, asked, back, place = std::move(place)] {
      paths_ = paths;
      opening_.clear();
      if (asked == asked_recipe_) asked_recipe_.reset();
      options_.recipe = recipe;
      take_survey(files, place);
      if (back) (void)show(back->first, back->second);
    });
  });
  opening_ = std::move(paths);
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

void Document::take_survey(std::shared_ptr<const SurveyFiles> survey, Result<JournalPlace> place) {
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
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].grid && asks_for_detection(lines, datagram_times(*survey_, all[i]))) undetected_.push_back(i);
  }
  (void)show(static_cast<std::size_t>(first - all.begin()));
}

}  // namespace sonar
