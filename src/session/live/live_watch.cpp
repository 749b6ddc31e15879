// SPDX-License-Identifier: Apache-2.0
#include "session/live/live_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/machine_memory.h"
#include "pipeline/live/live_schools.h"
#include "pipeline/stages/observe.h"

namespace sonar {
namespace {

constexpr const char* kName = "live";
constexpr double kPoll_s = 0.2;

}  // namespace

LiveWatch::LiveWatch(Workspace& workspace, AnimationDriver& animations)
    : workspace_(workspace),
      animations_(animations),
      listening_(workspace.document.changes(), [this](DocumentChange change) {
        if (change == DocumentChange::survey) {
          set_on(false);
          // When the document has shown what it opens with.
          if (std::exchange(follows_next_, false)) {
            workspace_.queue.post([this, alive = std::weak_ptr<bool>(alive_)] {
              if (!alive.expired()) set_on(true);
            });
          }
        }
        if (!on() || (change != DocumentChange::looking && change != DocumentChange::ping)) return;
        if (workspace_.document.ping() != asked_ping_) chasing_ = false;  // somebody looks elsewhere
        if (change == DocumentChange::ping && chasing_) go_on_with_newest();
        changed_.tell();
      }) {}

LiveWatch::~LiveWatch() { set_on(false); }

void LiveWatch::set_on(bool on) {
  if (on == this->on()) return;
  if (!on) {
    animations_.stop(kName);
    work_->cancel();
    survey_.reset();
    watched_.reset();
    memory_.clear();
    last_found_.clear();
    asked_.clear();
    looking_ = finding_ = false;
    text_.clear();
    return changed_.tell();
  }
  const Document& document = workspace_.document;
  if (document.survey() == nullptr || !document.survey()->raw_gone.empty()) return;
  const Recipe& recipe = document.recipe();
  survey_ = std::make_shared<LiveSurvey>(document.paths(), recipe.survey, recipe.navigation, document.options().cache);
  watched_ = std::make_shared<bool>(true);
  work_ = std::make_shared<Work>(document.options().threads);
  looked_s_ = 0.0;
  asked_ping_ = -1;
  chasing_ = false;
  found_in_.clear();
  left_out_ = 0;
  looked_at_ = LiveClock::now();
  text_ = "waiting for pings";
  animations_.run(kName, [this](double now_s) { return tick(now_s); });
  look_at_newest();
  changed_.tell();
}

/// Of the sounder on show; before anything is, of the first that can be shown.
std::size_t LiveWatch::newest() const {
  const Document& document = workspace_.document;
  const auto& all = document.survey()->observations;
  if (document.shown()) return newest_observation(*document.survey(), &document.shown()->files());
  const auto first = std::find_if(all.begin(), all.end(), [](const auto& one) { return one.grid.has_value(); });
  return newest_observation(*document.survey(), first == all.end() ? nullptr : &*first);
}

Result<void> LiveWatch::set_alarm(const std::string& rule) {
  std::vector<Alarm> alarms;
  if (!rule.empty()) {
    auto alarm = Alarm::parse(rule);
    if (!alarm) return pass_on(alarm);
    alarms.push_back(std::move(*alarm));
  }
  alarm_ = rule;
  alarms_ = Alarms(std::move(alarms));
  return {};
}

bool LiveWatch::at_newest() const {
  const Document& document = workspace_.document;
  if (!on() || !document.shown() || document.survey()->observations.empty()) return false;
  return document.shown()->index() == newest() && document.ping() + 1 == document.shown()->pings();
}

void LiveWatch::look_at_newest() {
  Document& document = workspace_.document;
  if (!on() || document.survey()->observations.empty()) return;
  const std::size_t newest = this->newest();
  const std::int64_t last = std::ssize(document.survey()->observations[newest].pings) - 1;
  if (asked_ping_ >= 0 && last > asked_ping_ + 1) left_out_ += last - asked_ping_ - 1;
  if (document.shown() && document.shown()->index() == newest) {
    document.look_at(last);
  } else if (auto shown = document.show(newest, last); !shown) {
    document.tell(to_line(shown.error()));
  }
  asked_ping_ = document.ping();
  changed_.tell();
}

/// Not before the last one that was asked for has come: where pings come faster than pictures, some are shown instead of none.
void LiveWatch::go_on_with_newest() {
  const Document& document = workspace_.document;
  const bool on_its_way = document.shown() && document.ping() == asked_ping_ && document.staged() &&
                          document.staged()->ping_index != document.ping();
  chasing_ = on_its_way;
  if (on_its_way) return;
  look_at_newest();
}

bool LiveWatch::tick(double now_s) {
  if (!on()) return false;
  // A survey that is being opened again is not looked at meanwhile.
  const bool opening = follows_next_ && !workspace_.document.progress().stage.empty();
  if (looking_ || opening || now_s - looked_s_ < kPoll_s) return true;
  looking_ = true;
  looked_s_ = now_s;
  const auto written_since = std::exchange(looked_at_, LiveClock::now());
  (void)looks_.post([this, survey = survey_, written_since, watched = std::weak_ptr<bool>(watched_), work = work_,
                     out = workspace_.document.journal_path().parent_path()](const CancelToken&) {
    const auto begun = LiveClock::now();
    Seen seen;
    const auto news = survey->look(begun, *work);
    if (news && news->cannot) {
      seen.cannot = to_line(*news->cannot) + (news->cannot->code != ErrorCode::mismatch ? "; waiting for it" : "");
    }
    if (news && news->changed && !survey->survey()->observations.empty()) {
      seen.survey = survey->survey();
      seen.written_since = written_since;
      seen.status = live_status(*seen.survey, 0.0, out.empty() ? "." : out);
    }
    workspace_.queue.post([this, watched, seen] {
      if (watched.lock()) take(seen);
    });
  });
  return true;
}

void LiveWatch::take(const Seen& seen) {
  looking_ = false;
  Document& document = workspace_.document;
  if (seen.cannot != cannot_) {
    cannot_ = seen.cannot;
    if (!cannot_.empty()) document.tell(cannot_);
  }
  if (seen.survey) {
    const bool follows = at_newest() || chasing_ || !document.shown();
    if (!document.grow(seen.survey)) {
      if (document.opening()) return;  // what was asked for meanwhile is not lost
      // A file before the others, say: as good as another survey.
      follow_next();
      const auto paths = document.paths();
      return document.open(paths);
    }
    if (follows) {
      go_on_with_newest();
    } else {
      asked_ping_ = -1;
    }
    LiveStatus status = *seen.status;
    status.behind_s = std::chrono::duration<double>(LiveClock::now() - seen.written_since).count();
    text_ = status_line(status);
    if (left_out_ > 0) text_ += fmt::format("; {} pings not drawn, all are searched", left_out_);
    changed_.tell();
  }
  find_schools();
}

/// Observations that ended while their last pings were not searched yet come first.
std::optional<std::size_t> LiveWatch::to_be_searched() const {
  const Document& document = workspace_.document;
  const auto& all = document.survey()->observations;
  std::set<std::size_t> followed{newest()};
  for (const auto& [index, memory] : memory_) followed.insert(index);
  for (const std::size_t index : followed) {
    if (index >= all.size() || !all[index].grid) continue;
    const auto found = found_in_.find(index);
    const bool refused = asked_.contains(index) && !document.asks_for_schools(index);  // somebody undid it
    if (!refused && (found == found_in_.end() || found->second != std::ssize(all[index].pings))) return index;
  }
  return std::nullopt;
}

void LiveWatch::find_schools() {
  Document& document = workspace_.document;
  if (finding_ || document.busy() || document.survey()->observations.empty()) return;
  const auto next = to_be_searched();
  if (!next) return;
  const auto survey = document.survey_files();
  const std::size_t index = *next;
  finding_ = true;
  found_in_[index] = std::ssize(survey->observations[index].pings);
  auto& memory = memory_[index];
  if (!memory) memory = std::make_shared<ObserveMemory>();
  work_->set_progress([give_way = GivesWay(document.right_of_way())](std::string_view, std::int64_t,
                                                                     std::int64_t) mutable { give_way(); });
  (void)finds_.post([this, survey, index, memory, work = work_, watched = std::weak_ptr<bool>(watched_),
                     before = last_found_[index], recipe = document.recipe(),
                     version = document.options().program_version](const CancelToken&) mutable {
    recipe.automatic = true;
    ObserveOptions options{{}, {}, version};
    options.memory = memory.get();
    std::optional<EarlierSchools> numbers;
    if (before) numbers = numbers_of(*before);
    if (numbers) options.earlier = &*numbers;
    auto found = observe(*survey, survey->observations[index], recipe, options, *work);
    const auto product = found ? std::make_shared<const ObservationProduct>(std::move(*found)) : nullptr;
    give_memory_back();
    workspace_.queue.post([this, watched, index, product] {
      if (watched.lock()) take_found(index, product);
    });
  });
}

void LiveWatch::take_found(std::size_t observation, const std::shared_ptr<const ObservationProduct>& found) {
  finding_ = false;
  Document& document = workspace_.document;
  if (found && !(asked_.contains(observation) && !document.asks_for_schools(observation))) {
    const auto before = std::exchange(last_found_[observation], found);
    const std::vector<LiveSchool> schools = live_schools(*found, before.get());
    for (const LiveSchool& school : schools) {
      if (school.is_new) document.tell(school_line(school));
    }
    for (const auto& ringing : alarms_.ring(schools)) {
      document.tell(fmt::format("ALARM {}: {}", ringing.rule, school_line(ringing.school)));
    }
    document.take_schools(observation, *found);
    asked_.insert(observation);
  }
  if (observation != newest()) {
    memory_.erase(observation);  // it is over
    last_found_.erase(observation);
  }
  find_schools();
}

void LiveWatch::settle() {
  looks_.wait();
  finds_.wait();
}

}  // namespace sonar
