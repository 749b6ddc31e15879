// SPDX-License-Identifier: Apache-2.0
#include "session/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/number_text.h"
#include "base/within_memory.h"
#include "pipeline/stages/detected_cache.h"
#include "pipeline/stages/observe.h"
#include "pipeline/tasks/work_folders.h"

namespace sonar {

Document::Document(ChangeQueue& queue, DocumentOptions options)
    : queue_(queue), options_(std::move(options)), usual_recipe_(options_.recipe) {
  // What a window asks for is a choice of its own, and stands in the journal.
  options_.recipe.automatic = false;
  if (options_.memory_bytes == 0) options_.memory_bytes = usual_memory();
}

Document::~Document() {
  cancel();
  keep_measures();
}

void Document::tell(std::string notice) {
  notices_.push_back(options_.with_keys ? options_.with_keys(notice) : std::move(notice));
  changes_.tell(DocumentChange::notice);
}

void Document::post(const CancelToken& token, std::function<void()> change) {
  queue_.post([alive = std::weak_ptr<bool>(alive_), token, change = std::move(change)] {
    if (!alive.expired() && !token.cancelled()) change();
  });
}

void Document::run(std::function<void(Work&, const CancelToken&)> job) {
  cancel();
  work_ = std::make_shared<Work>(options_.threads);
  background_.post_latest([this, work = work_, job = std::move(job)](const CancelToken& token) {
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
      post(token, [this, line = to_line(done.error())] { tell(line); });
    }
    show({});
  });
}

void Document::cancel() {
  if (work_) work_->cancel();
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
  measured_[index] = std::make_shared<KeptMeasures>();
  unreplayed_.insert(index);
  if (staged_) replay_journal();
  return observation;
}

/// The first picture does not wait for what the journal says of its observation.
void Document::replay_journal() {
  for (const std::size_t index : std::exchange(unreplayed_, {})) choices_thread_->open(chosen_on_.at(index));
  if (!undetected_.empty()) detect(std::exchange(undetected_, {}));
}

Result<void> Document::show(std::size_t observation, std::int64_t ping) {
  if (!survey_ || observation >= survey_->observations.size()) return fail(ErrorCode::usage, "no such observation");
  const ObservationFiles& files = survey_->observations[observation];
  if (!files.grid) return fail(ErrorCode::usage, why_no_grid(files));
  const OpenObservationPtr before = shown_;
  staged_.reset();
  unreadable_.clear();
  shown_ = opened(observation);
  if (before && before->index() != observation) rest_unless_shown(before->index());
  others_looked_at_ = {};
  propagating_.clear();
  ping_ = std::clamp<std::int64_t>(ping, 0, shown_->pings() - 1);
  changes_.tell(DocumentChange::observation);
  look_at(ping_);
  return {};
}

/// One observation is looked at, and one has its pings in memory.
void Document::rest_unless_shown(std::size_t observation) {
  if (shown_ && shown_->index() == observation) return;
  for (const auto* kept : {&open_, &chosen_on_}) {
    if (const auto found = kept->find(observation); found != kept->end() && found->second) found->second->rest();
  }
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
  unreadable_.clear();
  look_at_others();
  if (auto held = shown_->cache().held(ping_)) {
    staged_ = std::move(held);
    changes_.tell(DocumentChange::ping);
    shown_->cache().look_at(ping_);  // for what lies round it
    replay_journal();
    return;
  }
  // Until it arrives, what nobody waits for rests.
  const auto way = std::make_shared<std::shared_ptr<const void>>(way_.take());
  // Weak: what runs on the cache's own thread must not be the last to hold the observation.
  const auto arrived = [this, way, alive = std::weak_ptr<bool>(alive_), of = std::weak_ptr(shown_),
                        asked = ping_](const Result<StagedPingPtr>& staged) {
    way->reset();  // its neighbours are made next, and nobody waits for them
    queue_.post_latest("document ping", [this, alive, of, asked, staged] {
      if (alive.expired() || of.lock() != shown_ || asked != ping_) return;
      if (staged) {
        staged_ = *staged;
        changes_.tell(DocumentChange::ping);
      } else {
        unreadable_ = to_line(staged.error());
        tell(unreadable_);
        if (!staged_) changes_.tell(DocumentChange::ping);  // views say so instead of showing nothing
      }
      replay_journal();
    });
  };
  shown_->cache().look_at(ping_, arrived);
  changes_.tell(DocumentChange::looking);
}

/// While pings are played the disk is not asked for each.
void Document::look_at_others() {
  constexpr std::chrono::seconds kBetweenLooks{2};
  const auto now = std::chrono::steady_clock::now();
  if (now - others_looked_at_ < kBetweenLooks) return;
  others_looked_at_ = now;
  choices_thread_->look_at(shown_->index());
}

void Document::act(std::int64_t ping_index, Command command) {
  if (shown_) act(shown_->index(), ping_index, std::move(command));
}

ActTicket Document::act(std::size_t observation, std::int64_t ping_index, Command command,
                        std::shared_ptr<JournalStep> step) {
  if (!choices_thread_) return 0;
  replay_journal();
  if (const auto* propagate = std::get_if<PropagateCommand>(&command); propagate != nullptr && shown_) {
    const std::int64_t later = shown_->pings() - 1 - ping_index;
    const std::int64_t reach = propagate->reach < 0 ? shown_->pings() : propagate->reach;
    const std::int64_t before = std::min(propagate->reach_backward.value_or(reach), ping_index);
    const std::int64_t after = std::min(propagate->reach_forward.value_or(reach), later);
    following_ = {"propagating", 0, std::max<std::int64_t>(1, before + after)};
    const OpenObservationPtr on = open_observation(observation);
    const auto known = propagate->school && on ? school_at(state(observation), on->context(), *propagate->school)
                                               : std::optional<std::size_t>{};
    followed_ = known ? std::optional(state(observation).schools[*known]->number) : std::nullopt;
  }
  const ActTicket ticket = choices_thread_->act(observation, ping_index, std::move(command), std::move(step));
  if (!following_.stage.empty()) changes_.tell(DocumentChange::progress);
  return ticket;
}

Progress Document::activity() const {
  if (!progress_.stage.empty()) return progress_;
  if (!following_.stage.empty()) return following_;
  if (!replaying_.stage.empty()) return replaying_;
  // One observation is measured after each act, in no time.
  if (measures_begun_ > 1) return {"measuring", measures_done_, measures_begun_};
  return {};
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
  journal_path_ = choices_.journal;
  propagating_.clear();
  if (!std::exchange(replaying_, {}).stage.empty()) changes_.tell(DocumentChange::progress);
  if (!busy() && !std::exchange(following_, {}).stage.empty()) {
    followed_.reset();
    changes_.tell(DocumentChange::progress);
  }
  follow_calibration();
  follow_refused(before);
  changes_.tell(DocumentChange::state);
  changes_.tell(DocumentChange::propagating);
  measure_changed(before);
  tell_unseen(before);
  tell_beyond_reach();
  for (const std::string& notice : choices_.notices) tell(notice);
  if (!choices_.failure.empty()) tell(choices_.failure);
}

void Document::take_step(std::size_t observation, std::int64_t ping_index, const PingMask& mask) {
  if (!shown_ || shown_->index() != observation) return;
  propagating_[ping_index] = mask;
  following_.done = std::min(following_.total, static_cast<std::int64_t>(propagating_.size()));
  changes_.tell(DocumentChange::propagating);
  if (!following_.stage.empty()) changes_.tell(DocumentChange::progress);
}

void Document::detect(std::vector<std::size_t> observations) {
  if (!survey_) return;
  const auto step = observations.size() > 1 ? std::make_shared<JournalStep>() : nullptr;
  run([this, survey = survey_, observations = std::move(observations), step](Work& work, const CancelToken& token) {
    for (const std::size_t index : observations) {
      if (work.cancelled() || token.cancelled() || index >= survey->observations.size()) break;
      detect_one(survey, index, step, work, token);
    }
    if (!work.cancelled()) return;
    queue_.post([this, alive = std::weak_ptr<bool>(alive_), survey, observations] {
      if (!alive.expired() && survey == survey_) tell_lacking(observations);
    });
  });
}

bool Document::asks_for_schools(std::size_t observation) const {
  return choices_.lines && observation < survey_->observations.size() &&
         asks_for_detection(effective_lines(*choices_.lines),
                            datagram_times(*survey_, survey_->observations[observation]));
}

bool Document::lacks_detected(std::size_t observation) const {
  return !choices_.searched.contains(observation) && asks_for_schools(observation);
}

void Document::tell_lacking(const std::vector<std::size_t>& observations) {
  const auto lacking = std::count_if(observations.begin(), observations.end(),
                                     [this](std::size_t index) { return !detected(index) && lacks_detected(index); });
  if (lacking == 0) return;
  tell(
      fmt::format("stopped: the schools that were found before in {} are not shown; detect schools "
                  "again to have them back (nothing is lost)",
                  count_of(static_cast<std::size_t>(lacking), "observation")));
}

void Document::detect_one(const std::shared_ptr<const SurveyFiles>& survey, std::size_t index,
                          const std::shared_ptr<JournalStep>& step, Work& work, const CancelToken& token) {
  const ObservationFiles& observation = survey->observations[index];
  if (!observation.grid) return;
  if (const auto room = room_for(observation, options_.memory_bytes); !room) {
    return post(token, [this, line = to_line(room.error())] { tell(line); });
  }
  Recipe recipe = options_.recipe;
  recipe.automatic = true;
  const ObserveOptions observe_options{{}, {}, options_.program_version};
  const auto file = detected_file(options_.cache, *survey, observation);
  const std::string key = key_of(*survey, observation, recipe);
  const auto take = [&, earlier = earlier_found(file, *survey, observation)](const ObservationProduct& product) {
    post(token, [this, survey, index, step, found = Found{detected_schools(product), product.rejected, earlier}] {
      if (survey == survey_) take_detected(index, found, step);
    });
  };
  if (const auto kept = kept_detected(file, key)) return take(*kept);
  if (const auto of_run = kept_detected(product_in(work_folders_, observation.name, key), key)) {
    take(*of_run);
    return keep_detected(file, *of_run);
  }
  auto product = observe(*survey, observation, recipe, observe_options, work);
  if (!product) {
    if (product.error().code == ErrorCode::cancelled) return;
    return post(token, [this, line = to_line(product.error())] { tell(line); });
  }
  take(*product);
  keep_detected(file, *product);
}

void Document::take_detected(std::size_t index, Found found, const std::shared_ptr<JournalStep>& step) {
  const auto number = static_cast<std::int64_t>(found.schools.size());
  const OpenObservationPtr observation = opened(index);
  unreplayed_.erase(index);
  choices_thread_->open(chosen_on_[index], std::move(found.schools), std::move(found.earlier));
  detected_.insert(index);
  found_refused_[index] = std::move(found.refused);
  if (!asks_for_detection(effective_lines(*choices_.lines), observation->context().times)) {
    act(index, 0, DetectCommand{number}, step);
  }
}

void Document::settle() {
  // A change may start more work, and work may bring more changes.
  do {
    background_.wait();
    beside_.wait();
    if (choices_thread_) choices_thread_->wait();
    for (const auto& [index, observation] : open_) observation->cache().wait();
    measures_.wait();
  } while (queue_.drain() > 0);
}

}  // namespace sonar
