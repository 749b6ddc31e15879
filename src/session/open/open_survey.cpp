// SPDX-License-Identifier: Apache-2.0
#include "session/open/open_survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/number_text.h"
#include "session/open/document.h"

namespace sonar {

OpenSurvey::OpenSurvey(Document& document, ChangeQueue& queue, SurveyRead read)
    : document_(document), queue_(queue), read_(std::move(read)) {
  if (!read_.files) return;
  JournalPlace place = read_.place ? std::move(*read_.place) : JournalPlace{};
  choices_.journal = place.path;
  journal_folder_ = place.path.parent_path();
  choices_.lines = std::make_shared<const std::vector<JournalLine>>(place.lines);  // known before they are replayed
  choices_thread_ = std::make_unique<Choices>(
      queue_, std::move(place),
      Choices::Options{document_.options().operator_name, document_.options().clock,
                       [this](std::int64_t done, std::int64_t total) {
                         replaying_ = {"reading the journal", done, total};
                         tell(DocumentChange::progress);
                       }},
      [this](ChoicesShown shown) { take_choices(std::move(shown)); },
      [this](std::size_t observation, std::int64_t ping_index, const PingMask& mask) {
        take_step(observation, ping_index, mask);
      });
}

OpenSurvey::~OpenSurvey() { keep_measures(); }

void OpenSurvey::tell(DocumentChange change) { document_.changes().tell(change); }

void OpenSurvey::tell(std::string notice) { document_.tell(std::move(notice)); }

void OpenSurvey::post(const CancelToken& token, std::function<void()> change) {
  queue_.post([here = weak_from_this(), token, change = std::move(change)] {
    if (const auto stays = here.lock(); stays && !token.cancelled()) change();
  });
}

void OpenSurvey::begin(const std::optional<std::pair<std::size_t, std::int64_t>>& back_to) {
  const auto& all = read_.files->observations;
  const auto first = std::find_if(all.begin(), all.end(), [](const auto& one) { return one.grid.has_value(); });
  if (first == all.end()) return tell(nothing_shown());
  await_schools();
  if (back_to && show(back_to->first, back_to->second)) return;
  begin_where_it_was_left(static_cast<std::size_t>(first - all.begin()));
}

/// first  observation with a grid
void OpenSurvey::begin_where_it_was_left(std::size_t first) {
  const auto left = document_.options().left_at ? document_.options().left_at(read_.named) : std::nullopt;
  const auto& all = read_.files->observations;
  const auto there =
      std::find_if(all.begin(), all.end(), [&](const auto& one) { return left && one.name == left->first; });
  if (there != all.end() && show(static_cast<std::size_t>(there - all.begin()), left->second)) return;
  (void)show(first);
}

/// After the first picture come the schools that the journal asks for, and those that a run found.
void OpenSurvey::await_schools() {
  const std::vector<JournalLine> lines = effective_lines(*choices_.lines);
  std::size_t lacking = 0;
  for (std::size_t i = 0; i < read_.files->observations.size(); ++i) {
    const ObservationFiles& observation = read_.files->observations[i];
    if (!observation.grid) continue;
    if (read_.found.contains(i) || read_.others.contains(i) ||
        asks_for_detection(lines, datagram_times(*read_.files, observation))) {
      undetected_.push_back(i);
    } else {
      ++lacking;
    }
  }
  if (lacking == 0 || read_.work_folders.empty()) return;
  tell(fmt::format(
      "{}: the schools of {} are not those of this version and recipe; [schools.detect_all] detects them again",
      read_.work_folders.front().string(), count_of(lacking, "observation")));
}

OpenObservationPtr OpenSurvey::open_observation(std::size_t index) const {
  const auto found = open_.find(index);
  return found == open_.end() ? nullptr : found->second.open;
}

OpenSurvey::AtWork& OpenSurvey::opened(std::size_t index) {
  AtWork& at = open_[index];
  if (at.open) return at;
  const DocumentOptions& options = document_.options();
  at.chosen_on =
      std::make_shared<OpenObservation>(read_.files, index, read_.recipe, options.prefetch, options.memory_bytes);
  at.open = calibrated(at.chosen_on);
  unreplayed_.insert(index);
  if (staged_ || !unreadable_.empty()) replay_journal();
  return at;
}

/// The first picture does not wait for what the journal says of its observation.
void OpenSurvey::replay_journal() {
  for (const std::size_t index : std::exchange(unreplayed_, {})) choices_thread_->open(open_.at(index).chosen_on);
  // Another survey that is being read would be given up for it.
  if (undetected_.empty() || document_.opening()) return;
  std::ranges::stable_partition(undetected_, [&](std::size_t index) { return shown_ && index == shown_->index(); });
  detect(std::exchange(undetected_, {}), true);
}

void OpenSurvey::go_on() {
  if (staged_ || !unreadable_.empty()) replay_journal();
}

Result<void> OpenSurvey::show(std::size_t observation, std::int64_t ping) {
  if (!read_.files || observation >= read_.files->observations.size())
    return fail(ErrorCode::usage, "no such observation");
  const ObservationFiles& files = read_.files->observations[observation];
  if (!files.grid) return fail(ErrorCode::usage, why_no_grid(files));
  const OpenObservationPtr before = shown_;
  staged_.reset();
  unreadable_.clear();
  shown_ = opened(observation).open;
  if (before && before->index() != observation) rest_unless_shown(before->index());
  others_looked_at_ = {};
  propagating_.clear();
  ping_ = std::clamp<std::int64_t>(ping, 0, shown_->pings() - 1);
  tell(DocumentChange::observation);
  look_at(ping_);
  return {};
}

/// One observation is looked at, and one has its pings in memory.
void OpenSurvey::rest_unless_shown(std::size_t observation) {
  if (shown_ && shown_->index() == observation) return;
  const auto found = open_.find(observation);
  if (found == open_.end()) return;
  found->second.open->rest();
  found->second.chosen_on->rest();
}

void OpenSurvey::open_all() {
  if (!read_.files) return;
  for (std::size_t i = 0; i < read_.files->observations.size(); ++i) {
    if (read_.files->observations[i].grid && !opened(i).unmeasured.empty()) measure(i);
  }
  tell(DocumentChange::observation);
}

void OpenSurvey::look_at(std::int64_t ping_index) {
  if (!shown_) return;
  ping_ = std::clamp<std::int64_t>(ping_index, 0, shown_->pings() - 1);
  unreadable_.clear();
  look_at_others();
  if (auto held = shown_->cache().held(ping_)) {
    staged_ = std::move(held);
    tell(DocumentChange::ping);
    shown_->cache().look_at(ping_);  // for what lies round it
    replay_journal();
    return;
  }
  // Until it arrives, what nobody waits for rests.
  const auto way = std::make_shared<std::shared_ptr<const void>>(document_.right_of_way().take());
  // Weak: what runs on the cache's own thread must not be the last to hold the observation, and may outlive the survey.
  const auto arrived = [here = weak_from_this(), &queue = queue_, way, of = std::weak_ptr(shown_),
                        asked = ping_](const Result<StagedPingPtr>& staged) {
    way->reset();  // its neighbours are made next, and nobody waits for them
    queue.post_latest("document ping", [here, of, asked, staged] {
      const auto survey = here.lock();
      if (survey && of.lock() == survey->shown_ && asked == survey->ping_) survey->take_ping(staged);
    });
  };
  shown_->cache().look_at(ping_, arrived);
  tell(DocumentChange::looking);
}

/// The one that is looked at.
void OpenSurvey::take_ping(const Result<StagedPingPtr>& staged) {
  if (staged) {
    staged_ = *staged;
    tell(DocumentChange::ping);
  } else {
    // That no raw file is here is told once, when the survey is opened.
    const std::string& gone = read_.files->raw_gone;
    unreadable_ = gone.empty() ? to_line(staged.error()) : gone;
    if (gone.empty()) tell(unreadable_);
    if (!staged_) tell(DocumentChange::ping);  // views say so instead of showing nothing
  }
  replay_journal();
}

/// While pings are played the disk is not asked for each.
void OpenSurvey::look_at_others() {
  constexpr std::chrono::seconds kBetweenLooks{2};
  const auto now = std::chrono::steady_clock::now();
  if (now - others_looked_at_ < kBetweenLooks) return;
  others_looked_at_ = now;
  choices_thread_->look_at(shown_->index());
}

ActTicket OpenSurvey::act(std::size_t observation, std::int64_t ping_index, Command command,
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
  if (!following_.stage.empty()) tell(DocumentChange::progress);
  return ticket;
}

Progress OpenSurvey::activity() const {
  if (!following_.stage.empty()) return following_;
  if (!replaying_.stage.empty()) return replaying_;
  // One observation is measured after each act, in no time.
  if (measures_begun_ > 1) return {"measuring", measures_done_, measures_begun_};
  return {};
}

void OpenSurvey::undo() {
  if (!choices_thread_) return;
  replay_journal();
  choices_thread_->undo();
}

void OpenSurvey::redo() {
  if (!choices_thread_) return;
  replay_journal();
  choices_thread_->redo();
}

void OpenSurvey::stop_propagation() {
  if (choices_thread_) choices_thread_->stop();
}

const JournalState& OpenSurvey::state(std::size_t observation) const {
  static const JournalState kNothing;
  const auto found = choices_.states.find(observation);
  return found == choices_.states.end() || !found->second ? kNothing : *found->second;
}

void OpenSurvey::take_choices(ChoicesShown shown) {
  const ChoicesShown before = std::exchange(choices_, std::move(shown));
  propagating_.clear();
  if (!std::exchange(replaying_, {}).stage.empty()) tell(DocumentChange::progress);
  if (!busy() && !std::exchange(following_, {}).stage.empty()) {
    followed_.reset();
    tell(DocumentChange::progress);
  }
  follow_calibration();
  follow_refused(before);
  tell(DocumentChange::state);
  tell(DocumentChange::propagating);
  measure_changed(before);
  tell_unseen(before);
  tell_beyond_reach();
  for (const std::string& notice : choices_.notices) tell(notice);
  if (!choices_.failure.empty()) tell(choices_.failure);
}

void OpenSurvey::take_step(std::size_t observation, std::int64_t ping_index, const PingMask& mask) {
  if (!shown_ || shown_->index() != observation) return;
  propagating_[ping_index] = mask;
  following_.done = std::min(following_.total, static_cast<std::int64_t>(propagating_.size()));
  tell(DocumentChange::propagating);
  if (!following_.stage.empty()) tell(DocumentChange::progress);
}

void OpenSurvey::wait() {
  if (choices_thread_) choices_thread_->wait();
  for (const auto& [index, at] : open_) at.open->cache().wait();
  measures_.wait();
}

}  // namespace sonar
