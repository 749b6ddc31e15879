// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "base/task_thread.h"
#include "pipeline/live/alarm.h"
#include "pipeline/live/live_status.h"
#include "pipeline/live/live_survey.h"
#include "pipeline/stages/observe_memory.h"
#include "session/listeners.h"
#include "session/listening.h"
#include "session/open/workspace.h"
#include "session/playing/animation_driver.h"

namespace sonar {

/// Follows a survey while it is recorded: what came is there within a moment, the newest ping is shown unless somebody looks
/// elsewhere, schools are found and told behind the window. Every picture is of the newest state; those between that the
/// machine could not draw are left out, no ping is.
/// threads  the window's
class LiveWatch {
 public:
  /// Both outlive the watch.
  LiveWatch(Workspace& workspace, AnimationDriver& animations);
  ~LiveWatch();
  LiveWatch(const LiveWatch&) = delete;
  LiveWatch& operator=(const LiveWatch&) = delete;

  [[nodiscard]] bool on() const { return survey_ != nullptr; }
  /// On: the newest ping is shown.
  void set_on(bool on);
  /// The survey that is opened next is followed.
  void follow_next() { follows_next_ = true; }
  /// A school that begins to fit the rule is told; an empty rule is none.
  /// errors  usage, as Alarm::parse()
  Result<void> set_alarm(const std::string& rule);
  [[nodiscard]] const std::string& alarm() const { return alarm_; }
  /// Whether the newest ping is the one looked at.
  [[nodiscard]] bool at_newest() const;
  /// Back to the newest ping, and on with it.
  void look_at_newest();
  /// How the recording goes, in a line; empty while it is off.
  [[nodiscard]] const std::string& text() const { return text_; }
  /// Called when on(), at_newest() or text() have changed.
  [[nodiscard]] Listeners<>& changed() { return changed_; }

  /// Returns when nothing runs behind; for tests.
  void settle();

 private:
  /// What one look brought.
  struct Seen {
    std::shared_ptr<const SurveyFiles> survey;  ///< null = nothing new
    std::optional<LiveStatus> status;
    LiveClock::time_point written_since;  ///< what is new was written then at the earliest
    std::string cannot;
  };
  bool tick(double now_s);
  void take(const Seen& seen);
  void go_on_with_newest();
  [[nodiscard]] std::size_t newest() const;
  [[nodiscard]] std::optional<std::size_t> to_be_searched() const;
  void find_schools();
  void take_found(std::size_t observation, const std::shared_ptr<const ObservationProduct>& found);

  Workspace& workspace_;
  AnimationDriver& animations_;
  std::shared_ptr<LiveSurvey> survey_;  ///< touched by the thread of the looks alone; null = off
  std::shared_ptr<bool> watched_;       ///< changes that come after the end are dropped
  bool looking_ = false;                ///< a look is on its way
  bool follows_next_ = false;
  std::int64_t asked_ping_ = -1;  ///< the newest, when it was asked for
  bool chasing_ = false;          ///< a newer one came before that was there
  std::int64_t left_out_ = 0;     ///< pings that were never drawn
  double looked_s_ = 0.0;
  LiveClock::time_point looked_at_;  ///< when the look before began to read
  std::string text_;
  std::string cannot_;
  std::string alarm_;
  Alarms alarms_;
  bool finding_ = false;
  std::map<std::size_t, std::int64_t> found_in_;  ///< pings of each that schools were looked for in
  std::set<std::size_t> asked_;                   ///< observations whose journal asks for schools on our behalf
  std::map<std::size_t, std::shared_ptr<ObserveMemory>> memory_;
  std::map<std::size_t, std::shared_ptr<const ObservationProduct>> last_found_;
  Listeners<> changed_;
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);  ///< changes that come after the end are dropped
  std::shared_ptr<Work> work_;
  TaskThread looks_;
  TaskThread finds_;
  Listening listening_;  // the last members: they end first
};

}  // namespace sonar
