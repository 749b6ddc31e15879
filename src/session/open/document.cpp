// SPDX-License-Identifier: Apache-2.0
#include "session/open/document.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <span>
#include <system_error>
#include <utility>

#include "base/number_text.h"
#include "base/within_memory.h"
#include "pipeline/journal/journals.h"
#include "pipeline/journal/manual.h"
#include "pipeline/journal/session_recipe.h"
#include "pipeline/journal/taken_lines.h"
#include "pipeline/tasks/other_finds.h"
#include "pipeline/tasks/work_folders.h"

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

/// Observations whose schools one of these folders has as detect() would find them; some of them when cancelled.
std::set<std::size_t> found_in(const std::vector<std::filesystem::path>& work_folders, const SurveyFiles& survey,
                               const Recipe& recipe, const std::string& program_version, Work& work) {
  std::vector<char> has(survey.observations.size());
  const auto look = [&](std::int64_t i) {
    const ObservationFiles& observation = survey.observations[static_cast<std::size_t>(i)];
    const std::string key = key_of_find(survey, observation, recipe, program_version);
    has[static_cast<std::size_t>(i)] = product_in(work_folders, observation.name, key).empty() ? 0 : 1;
  };
  if (!work_folders.empty()) work.for_each(static_cast<std::int64_t>(has.size()), look);
  std::set<std::size_t> found;
  for (std::size_t i = 0; i < has.size(); ++i) {
    if (has[i] != 0) found.insert(i);
  }
  return found;
}

/// Whether the folder is here that raw files lay in. An empty one may be where a disk is mounted: what is written there is
/// out of sight when the disk is back.
bool is_here(const std::filesystem::path& folder) {
  std::error_code absent;
  return std::filesystem::is_directory(folder, absent) && !std::filesystem::is_empty(folder, absent) && !absent;
}

/// What the journal of a survey lies beside: its raw files, or the place where they lay, or its results. These it is where
/// they have decisions in them: the journal beside the raw files may be the one that these are of, and nothing is decided twice.
std::filesystem::path home_of(const NamedToOpen& named) {
  if (!named.raw.empty()) return named.raw.front();
  const bool beside_raw =
      named.sessions.empty() && !named.expected.empty() && is_here(named.expected.front().parent_path());
  if (beside_raw) return named.expected.front();
  return named.work_folders.empty() ? std::filesystem::path{} : named.work_folders.front();
}

/// "12 decisions of /data/session.jsonl (Ann, Bob) are taken over into session-2.jsonl; ...".
std::string taken_text(const TakenLines& taken, const std::filesystem::path& session,
                       const std::string& operator_name) {
  const bool own = taken.operators == std::vector{operator_name};
  return fmt::format("{} of {} ({}) {} taken over into {}{}; Diagnostics lists those that find no school",
                     count_of(taken.lines, "decision"), session.string(), fmt::join(taken.operators, ", "),
                     taken.lines == 1 ? "is" : "are", taken.into.filename().string(),
                     own ? ", as one step to undo" : "");
}

/// Where raw files lie, or lay.
std::vector<std::filesystem::path> raw_of(const NamedToOpen& named) {
  if (!named.raw.empty()) return named.raw;
  return named.expected.empty() ? named.work_folders : named.expected;
}

/// Every one with a grid.
std::set<std::size_t> all_with_grid(const SurveyFiles& survey) {
  std::set<std::size_t> all;
  for (std::size_t i = 0; i < survey.observations.size(); ++i) {
    if (survey.observations[i].grid) all.insert(i);
  }
  return all;
}

}  // namespace

Document::Document(ChangeQueue& queue, DocumentOptions options) : queue_(queue), options_(std::move(options)) {
  // What a window asks for is a choice of its own, and stands in the journal.
  options_.recipe.automatic = false;
  use_memory(options_.memory_bytes);
  survey_ = std::make_shared<OpenSurvey>(*this, queue_, SurveyRead{options_.recipe});
}

Document::~Document() { cancel(); }

void Document::tell(std::string notice) {
  notices_.push_back(options_.with_keys ? options_.with_keys(notice) : std::move(notice));
  changes_.tell(DocumentChange::notice);
}

void Document::post(const CancelToken& token, std::function<void()> change) {
  queue_.post([alive = std::weak_ptr<bool>(alive_), token, change = std::move(change)] {
    if (!alive.expired() && !token.cancelled()) change();
  });
}

void Document::run(std::function<void(Work&, const CancelToken&)> job, const OpeningPtr& opening) {
  cancel();
  opening_ = opening;
  work_ = std::make_shared<Work>(options_.threads);
  background_.post_latest([this, work = work_, job = std::move(job), opening](const CancelToken& token) {
    const auto show = [this, token](Progress now) {
      queue_.post_latest("document progress", [this, alive = std::weak_ptr<bool>(alive_), token, now = std::move(now)] {
        if (alive.expired() || token.cancelled()) return;
        progress_ = now;
        changes_.tell(DocumentChange::progress);
      });
    };
    work->set_progress(
        [show, give_way = GivesWay(way_)](std::string_view stage, std::int64_t done, std::int64_t total) mutable {
          show({std::string(stage), done, total});
          give_way();
        });
    if (const auto done = within_memory([&] { job(*work, token); }); !done) {
      end_with(done.error(), token, opening);
    }
    show({});
    post(token, [this] {
      if (!opening_) survey_->go_on();
    });
  });
}

void Document::cancel() {
  if (work_) work_->cancel();
}

void Document::read(Opening what) {
  if (std::exchange(glance_, nullptr)) changes_.tell(DocumentChange::glance);
  const auto opening = std::make_shared<const Opening>(std::move(what));
  const auto job = [this, opening, none = survey() == nullptr](Work& work, const CancelToken& token) {
    if (const auto done = opening->first ? opening->first(work) : Result<void>{}; !done) {
      return end_with(done.error(), token, opening);
    }
    const auto named = told_apart(opening->paths);
    if (!named) return end_with(named.error(), token, opening);
    const auto home = home_of(*named);
    const auto folders = options_.journal_folders && !home.empty() ? options_.journal_folders(home)
                                                                   : std::vector<std::filesystem::path>{};
    Recipe recipe = opening->recipe ? *opening->recipe : recipe_of(folders, token);
    recipe.automatic = false;  // schools are detected when that is asked for
    const bool of_run = !opening->recipe && take_recipe(named->recipe, recipe);
    if (none && !named->raw.empty()) glance_at(named->raw, recipe, work, token);
    auto survey = survey_of(*named, recipe, work);
    if (!survey) return end_with(survey.error(), token, opening);
    const auto files = std::make_shared<const SurveyFiles>(std::move(survey->survey));
    auto place = placed(*named, folders, *files, recipe);
    if (of_run && place) {
      place->notices.push_back(fmt::format("from now on this survey is opened under the recipe of {}",
                                           named->work_folders.front().string()));
    }
    if (place) place->notices.insert(place->notices.end(), survey->notices.begin(), survey->notices.end());
    if (!files->raw_gone.empty() && place) place->notices.push_back(files->raw_gone + " ([file.find_raw])");
    const auto found = files->raw_gone.empty()
                           ? found_in(named->work_folders, *files, recipe, options_.program_version, work)
                           : all_with_grid(*files);
    if (work.cancelled()) return end_with(Error{ErrorCode::cancelled, "stopped on request", {}}, token, opening);
    auto others = files->raw_gone.empty()
                      ? other_finds(named->work_folders, *files, recipe, options_.program_version, found)
                      : std::map<std::size_t, OtherFind>{};
    post(token, [this, opening, chosen = opening->recipe || of_run,
                 read = SurveyRead{recipe, files, opening->paths, raw_of(*named), named->work_folders, found,
                                   std::move(others), place, survey->products, opening->recipe_before}] {
      if (opening_ != opening) return;  // something else was asked for since
      take(read, chosen, opening->back_to);
    });
  };
  run(job, opening);
}

/// Where the journal goes, with what humans had decided of the results that are opened, told in one notice.
Result<JournalPlace> Document::placed(const NamedToOpen& named, const std::vector<std::filesystem::path>& folders,
                                      const SurveyFiles& files, const Recipe& recipe) const {
  const Journal head = head_of(files, recipe);
  const auto has_ping = [&files](TimeNs time) {
    return std::ranges::any_of(files.observations,
                               [&](const ObservationFiles& one) { return ping_at(files, one, time).has_value(); });
  };
  auto place = place_journal(folders, head, options_.operator_name);
  if (!place) return place;
  std::vector<std::filesystem::path> sessions;
  // Without raw files their products, which have the run's decisions in them, are what is shown.
  if (named.raw_gone.empty()) {
    sessions = named.sessions;
    for (const auto& raw : named.expected) add_sessions_beside(raw, folders, sessions);
  }
  for (const auto& out : named.work_folders) add_sessions_beside(out, folders, sessions);
  std::vector<std::string> notices;
  bool taken = false;
  for (const auto& session : sessions) {
    const auto lines = take_lines(*place, session, has_ping);
    if (!lines) notices.push_back("decisions of the results are not taken over: " + to_line(lines.error()));
    if (!lines || lines->lines == 0) continue;
    taken = true;
    notices.push_back(taken_text(*lines, session, options_.operator_name));
  }
  if (taken) place = place_journal(folders, head, options_.operator_name);
  if (place) place->notices.insert(place->notices.end(), notices.begin(), notices.end());
  return place;
}

/// Where results are opened alone, decisions lie beside them, or beside the place where their raw files lay.
void Document::add_sessions_beside(const std::filesystem::path& home, const std::vector<std::filesystem::path>& folders,
                                   std::vector<std::filesystem::path>& sessions) const {
  if (!options_.journal_folders) return;
  for (const auto& beside : options_.journal_folders(home)) {
    const bool ours = std::find(folders.begin(), folders.end(), beside) != folders.end();
    if (!ours && !journals_in(std::span(&beside, 1)).empty()) sessions.push_back(beside);
  }
}

/// As its files tell it, or, without these, its results.
Result<ResultsAlone> Document::survey_of(const NamedToOpen& named, const Recipe& recipe, Work& work) const {
  if (!named.raw_gone.empty()) return open_results(named.work_folders, named.raw_gone, work);
  auto survey = open_survey(named.raw, recipe.survey, recipe.navigation, options_.cache, work);
  if (!survey) return pass_on(survey);
  return ResultsAlone{std::move(*survey), {}, {}};
}

void Document::end_with(const Error& error, const CancelToken& token, const OpeningPtr& opening) {
  post(token, [this, opening, line = to_line(error)] {
    if (opening_ == opening) opening_.reset();
    tell(line);
  });
}

void Document::take(SurveyRead read, bool recipe_chosen,
                    const std::optional<std::pair<std::size_t, std::int64_t>>& back_to) {
  if (recipe_chosen && read.place) {
    const auto kept = keep_recipe(read.place->path.parent_path(), read.recipe);
    if (!kept) read.place->notices.push_back("the recipe is not kept: " + to_line(kept.error()));
  }
  const std::vector<std::string> notices = read.place ? read.place->notices : std::vector{to_line(read.place.error())};
  opening_.reset();
  asked_recipe_.reset();
  glance_.reset();
  survey_ = std::make_shared<OpenSurvey>(*this, queue_, std::move(read));
  changes_.tell(DocumentChange::survey);
  changes_.tell(DocumentChange::progress);  // whatever ran in the one before
  for (const std::string& notice : notices) tell(notice);
  survey_->begin(back_to);
}

void Document::use_recipe(Recipe recipe) {
  const auto asked = std::make_shared<const Recipe>(std::move(recipe));
  if (opening_) {
    Opening again = *opening_;
    again.recipe = asked;
    return read(std::move(again));
  }
  if (survey() == nullptr) {
    asked_recipe_ = asked;
    return;
  }
  std::optional<std::pair<std::size_t, std::int64_t>> back_to;
  if (shown()) back_to = {shown()->index(), ping()};
  read({survey()->raw_gone.empty() ? paths() : named(), {}, back_to, asked, this->recipe()});
}

Result<void> Document::use_named_recipe(const std::string& path_or_preset) {
  auto recipe = named_recipe(path_or_preset);
  if (!recipe) return pass_on(recipe);
  use_recipe(std::move(*recipe));
  return {};
}

/// The one that was chosen for a survey before, else the usual one.
Recipe Document::recipe_of(const std::vector<std::filesystem::path>& folders, const CancelToken& token) {
  const auto kept = kept_recipe(session_folders(folders));
  if (!kept) post(token, [this, line = to_line(kept.error())] { tell(line + "; the usual recipe is used"); });
  if (kept && *kept) {
    for (const std::string& note : (*kept)->notes) post(token, [this, note] { tell("the recipe: " + note); });
  }
  return kept ? kept->value_or(options_.recipe) : options_.recipe;
}

/// What ends in an error ends in the same when all is read.
void Document::glance_at(const std::vector<std::filesystem::path>& paths, const Recipe& recipe, Work& work,
                         const CancelToken& token) {
  auto glance = glance_at_survey(paths, recipe.survey, recipe.navigation, work);
  if (!glance) return;
  post(token, [this, seen = std::make_shared<const SurveyFiles>(std::move(*glance))] {
    if (survey() != nullptr) return;  // it stays until the other is there
    glance_ = seen;
    changes_.tell(DocumentChange::glance);
  });
}

void Document::open_glanced(std::size_t observation) {
  if (!glance_ || observation >= glance_->observations.size()) return;
  std::vector<std::filesystem::path> files;
  for (const std::uint32_t file : glance_->observations[observation].files) files.push_back(glance_->files[file].path);
  read({std::move(files), {}, std::nullopt, opening_ ? opening_->recipe : asked_recipe_, std::nullopt});
}

Progress Document::activity() const { return progress_.stage.empty() ? survey_->activity() : progress_; }

void Document::settle() {
  // A change may start more work, and work may bring more changes.
  do {
    background_.wait();
    beside_.wait();
    survey_->wait();
  } while (queue_.drain() > 0);
}

}  // namespace sonar
