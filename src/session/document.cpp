// SPDX-License-Identifier: Apache-2.0
#include "session/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "pipeline/observe.h"

namespace sonar {

Document::Document(ChangeQueue& queue, DocumentOptions options) : queue_(queue), options_(std::move(options)) {
  // What a window asks for is a choice of its own, and stands in the journal.
  options_.recipe.automatic = false;
  if (options_.memory_bytes == 0) options_.memory_bytes = usual_memory();
}

Document::~Document() {
  cancel();
  for (const auto& [index, wanted] : measuring_) wanted.give_up();
}

void Document::tell(std::string notice) {
  notices_.push_back(std::move(notice));
  changes_.tell(DocumentChange::notice);
}

void Document::post(const Wanted& wanted, std::function<void()> change) {
  queue_.post([alive = std::weak_ptr<bool>(alive_), wanted, change = std::move(change)] {
    if (!alive.expired() && wanted()) change();
  });
}

void Document::run(std::function<void(Work&, const Wanted&)> job) {
  cancel();
  work_ = std::make_shared<Work>(options_.threads);
  background_.post_latest([this, work = work_, job = std::move(job)](const Wanted& wanted) {
    const auto show = [this, wanted](Progress now) {
      queue_.post_latest("document progress",
                         [this, alive = std::weak_ptr<bool>(alive_), wanted, now = std::move(now)] {
                           if (alive.expired() || !wanted()) return;
                           progress_ = now;
                           changes_.tell(DocumentChange::progress);
                         });
    };
    work->set_progress([show](std::string_view stage, std::int64_t done, std::int64_t total) {
      show({std::string(stage), done, total});
    });
    job(*work, wanted);
    show({});
  });
}

void Document::cancel() {
  if (work_) work_->cancel();
}

void Document::open(std::vector<std::filesystem::path> paths, std::function<Result<void>(Work&)> first) {
  run([this, paths = std::move(paths), first = std::move(first)](Work& work, const Wanted& wanted) {
    if (const auto done = first ? first(work) : Result<void>{}; !done) {
      return post(wanted, [this, line = to_line(done.error())] { tell(line); });
    }
    auto survey = open_survey(paths, options_.recipe.survey, options_.recipe.navigation, options_.cache, work);
    if (!survey) {
      return post(wanted, [this, line = to_line(survey.error())] { tell(line); });
    }
    auto files = std::make_shared<const SurveyFiles>(std::move(*survey));
    Journal head;
    head.recipe = recipe_text(options_.recipe);
    head.recipe_hash = recipe_hash(options_.recipe);
    for (const ObservationFiles& observation : files->observations) {
      for (InputFile& file : input_files(*files, observation)) head.files.push_back(std::move(file));
    }
    const auto folders = options_.journal_folders && !paths.empty() ? options_.journal_folders(paths.front())
                                                                    : std::vector<std::filesystem::path>{};
    auto place = place_journal(folders, head);
    post(wanted, [this, files, paths, place = std::move(place)] {
      paths_ = paths;
      take_survey(files, place);
    });
  });
}

void Document::take_survey(std::shared_ptr<const SurveyFiles> survey, Result<JournalPlace> place) {
  choices_thread_.reset();
  chosen_on_.clear();
  unreplayed_.clear();
  undetected_.clear();
  open_.clear();
  calibration_.reset();
  shown_.reset();
  staged_.reset();
  choices_ = {};
  propagating_.clear();
  detected_.clear();
  products_.clear();
  measured_.clear();
  survey_ = std::move(survey);
  journal_path_ = place ? place->path : std::filesystem::path{};
  if (!place) notices_.push_back(to_line(place.error()));
  if (place) notices_.insert(notices_.end(), place->notices.begin(), place->notices.end());
  const std::vector<JournalLine> lines = place ? effective_lines(place->journal.lines) : std::vector<JournalLine>{};
  choices_thread_ = std::make_unique<Choices>(
      queue_, place ? std::move(*place) : JournalPlace{}, Choices::Options{options_.operator_name, options_.clock},
      [this](ChoicesShown shown) { take_choices(std::move(shown)); },
      [this](std::size_t observation, std::int64_t ping_index, const PingMask& mask) {
        take_step(observation, ping_index, mask);
      });
  changes_.tell(DocumentChange::survey);
  const auto& all = survey_->observations;
  const auto first = std::find_if(all.begin(), all.end(), [](const auto& one) { return one.grid.has_value(); });
  if (first == all.end()) {
    tell(all.empty() ? "there are no pings in what was opened" : "no observation has a grid of fans and beams");
    return;
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].grid && asks_for_detection(lines, datagram_times(*survey_, all[i]))) undetected_.push_back(i);
  }
  (void)show(static_cast<std::size_t>(first - all.begin()));
}

OpenObservationPtr Document::open_observation(std::size_t index) const {
  const auto found = open_.find(index);
  return found == open_.end() ? nullptr : found->second;
}

OpenObservationPtr Document::opened(std::size_t index) {
  OpenObservationPtr& observation = open_[index];
  if (observation) return observation;
  OpenObservationPtr& chosen_on = chosen_on_[index];
  chosen_on =
      std::make_shared<OpenObservation>(survey_, index, options_.recipe, options_.prefetch, options_.memory_bytes);
  observation = calibrated(chosen_on);
  measured_[index] = std::make_shared<MeasuredPings>();
  unreplayed_.insert(index);
  if (staged_) replay_journal();
  return observation;
}

/// The first picture does not wait for what the journal says of its observation.
void Document::replay_journal() {
  for (const std::size_t index : std::exchange(unreplayed_, {})) choices_thread_->open(chosen_on_.at(index));
  if (!undetected_.empty()) detect(std::exchange(undetected_, {}));
}

Result<void> Document::show(std::size_t observation) {
  if (!survey_ || observation >= survey_->observations.size()) return fail(ErrorCode::usage, "no such observation");
  if (!survey_->observations[observation].grid) {
    return fail(ErrorCode::usage, survey_->observations[observation].name + " has no grid of fans and beams");
  }
  // One observation is looked at, and one has its pings in memory.
  if (shown_ && shown_->index() != observation) shown_->cache().rest();
  staged_.reset();
  shown_ = opened(observation);
  propagating_.clear();
  ping_ = 0;
  changes_.tell(DocumentChange::observation);
  look_at(0);
  return {};
}

void Document::open_all() {
  if (!survey_) return;
  for (std::size_t i = 0; i < survey_->observations.size(); ++i) {
    if (survey_->observations[i].grid) opened(i);
  }
  changes_.tell(DocumentChange::observation);
}

void Document::look_at(std::int64_t ping_index) {
  if (!shown_) return;
  ping_ = std::clamp<std::int64_t>(ping_index, 0, shown_->pings() - 1);
  if (auto held = shown_->cache().held(ping_)) {
    staged_ = std::move(held);
    changes_.tell(DocumentChange::ping);
    shown_->cache().look_at(ping_);  // for what lies round it
    replay_journal();
    return;
  }
  // Weak: what runs on the cache's own thread must not be the last to hold the observation.
  const auto arrived = [this, alive = std::weak_ptr<bool>(alive_), of = std::weak_ptr(shown_),
                        wanted = ping_](const Result<StagedPingPtr>& staged) {
    queue_.post_latest("document ping", [this, alive, of, wanted, staged] {
      if (alive.expired() || of.lock() != shown_ || wanted != ping_) return;
      if (staged) {
        staged_ = *staged;
        changes_.tell(DocumentChange::ping);
      } else {
        tell(to_line(staged.error()));
      }
      replay_journal();
    });
  };
  shown_->cache().look_at(ping_, arrived);
}

void Document::act(std::int64_t ping_index, Command command) {
  if (shown_) act(shown_->index(), ping_index, std::move(command));
}

void Document::act(std::size_t observation, std::int64_t ping_index, Command command) {
  if (!choices_thread_) return;
  replay_journal();
  choices_thread_->act(observation, ping_index, std::move(command));
}

void Document::undo() {
  if (!choices_thread_) return;
  replay_journal();
  choices_thread_->undo();
}

void Document::redo() {
  if (!choices_thread_) return;
  replay_journal();
  choices_thread_->redo();
}

void Document::stop_propagation() {
  if (choices_thread_) choices_thread_->stop();
}

const JournalState& Document::state(std::size_t observation) const {
  static const JournalState kNothing;
  const auto found = choices_.states.find(observation);
  return found == choices_.states.end() || !found->second ? kNothing : *found->second;
}

const JournalState& Document::state() const { return state(shown_ ? shown_->index() : static_cast<std::size_t>(-1)); }

void Document::take_choices(ChoicesShown shown) {
  const ChoicesShown before = std::exchange(choices_, std::move(shown));
  propagating_.clear();
  follow_calibration();
  changes_.tell(DocumentChange::state);
  changes_.tell(DocumentChange::propagating);
  measure_changed(before);
  if (!choices_.failure.empty()) tell(choices_.failure);
}

void Document::take_step(std::size_t observation, std::int64_t ping_index, const PingMask& mask) {
  if (!shown_ || shown_->index() != observation) return;
  propagating_[ping_index] = mask;
  changes_.tell(DocumentChange::propagating);
}

void Document::detect(std::vector<std::size_t> observations) {
  if (!survey_) return;
  run([this, survey = survey_, observations = std::move(observations)](Work& work, const Wanted& wanted) {
    for (const std::size_t index : observations) {
      if (work.cancelled() || !wanted() || index >= survey->observations.size()) return;
      detect_one(survey, index, work, wanted);
    }
  });
}

void Document::detect_one(const std::shared_ptr<const SurveyFiles>& survey, std::size_t index, Work& work,
                          const Wanted& wanted) {
  const ObservationFiles& observation = survey->observations[index];
  if (!observation.grid) return;
  if (const auto room = room_for(observation, options_.memory_bytes); !room) {
    return post(wanted, [this, line = to_line(room.error())] { tell(line); });
  }
  Recipe recipe = options_.recipe;
  recipe.automatic = true;
  auto product = observe(*survey, observation, recipe, {{}, {}, options_.program_version}, work);
  if (!product) {
    if (product.error().code == ErrorCode::cancelled) return;
    return post(wanted, [this, line = to_line(product.error())] { tell(line); });
  }
  post(wanted, [this, survey, index, schools = detected_schools(*product)] {
    if (survey != survey_) return;
    take_detected(index, schools);
  });
}

void Document::take_detected(std::size_t index, std::vector<SchoolMasks> schools) {
  const OpenObservationPtr observation = opened(index);
  unreplayed_.erase(index);
  choices_thread_->open(chosen_on_[index], std::move(schools));
  detected_.insert(index);
  if (!asks_for_detection(effective_lines(*choices_.lines), observation->ground().times)) {
    act(index, 0, DetectCommand{});
  }
}

ProductPtr Document::product(std::size_t observation) const {
  const auto found = products_.find(observation);
  return found == products_.end() ? nullptr : found->second;
}

void Document::measure_changed(const ChoicesShown& before) {
  for (const auto& [index, state] : choices_.states) {
    const auto old = before.states.find(index);
    if (old == before.states.end() || old->second != state) measure(index);
  }
}

void Document::measure(std::size_t index) {
  const OpenObservationPtr observation = open_observation(index);
  const JournalStatePtr state = choices_.states[index];
  if (!observation || !state) return;
  if (const auto running = measuring_.find(index); running != measuring_.end()) running->second.give_up();
  const auto lines = choices_.lines;
  measuring_[index] = measures_.post([this, observation, state, lines, kept = measured_[index]](const Wanted& wanted) {
    if (!wanted()) return;
    for (const auto& school : state->schools) {
      for (const auto& there : school->masks.pings) observation->estimate_background(there.ping_index);
    }
    Work one(1);
    const std::vector<JournalLine> effective = effective_lines(*lines);
    auto product =
        state_product(observation->engine(), *state, {effective, options_.program_version, false, kept.get()}, one);
    if (!product) return;
    auto shared = std::make_shared<const ObservationProduct>(std::move(*product));
    post(wanted, [this, index = observation->index(), shared] {
      products_[index] = shared;
      changes_.tell(DocumentChange::measures);
    });
  });
}

void Document::settle() {
  // A change may start more work, and work may bring more changes.
  do {
    background_.wait();
    if (choices_thread_) choices_thread_->wait();
    for (const auto& [index, observation] : open_) observation->cache().wait();
    measures_.wait();
  } while (queue_.drain() > 0);
}

}  // namespace sonar
