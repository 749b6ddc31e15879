// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "base/task_thread.h"
#include "pipeline/commands/state.h"
#include "pipeline/journal/journal_place.h"
#include "pipeline/journal/named_lock.h"
#include "pipeline/journal/school_numbers.h"
#include "session/change_queue.h"
#include "session/history.h"
#include "session/open/open_observation.h"

namespace sonar {

using OpenObservationPtr = std::shared_ptr<OpenObservation>;
using JournalStatePtr = std::shared_ptr<const JournalState>;

/// Whoever asks for an act knows it again by this when it is shown; no other act on the survey has it. 0 = none.
using ActTicket = std::int64_t;

/// What humans have chosen so far, as it is shown. A value.
struct ChoicesShown {
  std::map<std::size_t, JournalStatePtr> states;  ///< of the observations that are open
  std::set<std::size_t> searched;  ///< of these, those whose state lies upon what was found without a human
  std::string undo_text;           ///< "Undo grow school 3"; empty where there is nothing
  std::string redo_text;
  /// Of all journals of the survey, numbered as among_all() does.
  std::shared_ptr<const std::vector<JournalLine>> lines = std::make_shared<std::vector<JournalLine>>();
  std::map<std::int64_t, std::string> names;  ///< what each line did, by n: "grow school 3"; undone ones too
  std::string failure;                        ///< of the act that was just tried; empty = it was done
  std::vector<std::string> notices;           ///< what a user must be told beside
  std::filesystem::path journal;              ///< ours
  std::int64_t done_line = 0;                 ///< n of the line that was just written; 0 = none
  ActTicket ticket = 0;                       ///< of the act that was just tried; 0 = another change
};

/// The line that was just written; null where none was.
[[nodiscard]] const JournalLine* line_done(const ChoicesShown& shown);
/// The line that was just taken back; null where none was.
[[nodiscard]] const JournalLine* line_undone(const ChoicesShown& shown);

/// Lines of the journal that are undone and redone together. Whoever asks for them hands the same one over with each;
/// after one that cannot be done the others are left.
/// threads  that of the acts alone
struct JournalStep {
  std::int64_t first = 0;  ///< n of its first line
  bool broken = false;
  /// n of the line that stands last, with its step: it is taken back within this one, whose undo brings it back. The first
  /// act is refused where another has come meanwhile. 0 = nothing is replaced.
  std::int64_t instead_of = 0;
};

/// Every human choice on a survey: carried out one after another behind the window, written into the journal and flushed,
/// and only then shown. Others may be at work on the same survey: what they choose is shown too, and an observation is held by
/// whoever chooses in it for as long as they look at it.
/// threads  members are called from the window's thread; what they bring about comes through the change queue
class Choices {
 public:
  using Shown = std::function<void(ChoicesShown)>;
  /// A ping of a propagation that runs.
  using Step = std::function<void(std::size_t observation, std::int64_t ping_index, const PingMask& mask)>;

  struct Options {
    std::string operator_name;
    std::function<TimeNs()> clock;  ///< UTC now; empty = 0
    /// While lines are carried out anew, as after opening; called when the queue is drained.
    std::function<void(std::int64_t done, std::int64_t total)> replayed = {};
  };

  /// shown, step  called when the queue is drained
  Choices(ChangeQueue& queue, JournalPlace place, Options options, Shown shown, Step step);
  ~Choices();
  Choices(const Choices&) = delete;
  Choices& operator=(const Choices&) = delete;

  /// An observation takes part from now on: what the journal says of it is carried out.
  /// detected  schools that were found in it; none = nobody looked
  /// earlier   what other versions found there; null = nothing
  void open(OpenObservationPtr observation, std::optional<std::vector<SchoolMasks>> detected = {},
            std::shared_ptr<const EarlierSchools> earlier = {});
  /// An observation that takes part has more pings: what was chosen stays as it is.
  void grow(OpenObservationPtr observation);
  /// On a ping of an open observation.
  /// step  that the act is part of; null = it stands alone
  ActTicket act(std::size_t observation, std::int64_t ping_index, Command command,
                std::shared_ptr<JournalStep> step = nullptr);
  /// This one is looked at from now on; others that were held are let go. What others have chosen since is taken in.
  void look_at(std::size_t observation);
  void undo() { turn_back(true); }
  void redo() { turn_back(false); }
  /// Ends the propagation that runs, if one does; what it reached stays.
  void stop() { stopping_ = true; }
  /// Whether something waits or runs.
  [[nodiscard]] bool busy() const { return waiting_ > 0; }
  /// Returns when nothing waits or runs; for tests and the program's end.
  void wait() { thread_.wait(); }

 private:
  struct OnObservation {
    OpenObservationPtr observation;
    bool searched = false;
    JournalState detected;  ///< lies under the journal where its lines ask for detection, and only there
    JournalStatePtr state;
    std::shared_ptr<const EarlierSchools> earlier;
    /// What the observation's choices stand on.
    [[nodiscard]] CommandContext context() const;
  };
  /// One act, and the states round it.
  struct Turn {
    std::int64_t n = 0;
    std::int64_t step = 0;  ///< JournalLine::step
    std::string name;
    std::map<std::size_t, JournalStatePtr> before;
    std::map<std::size_t, JournalStatePtr> after;
    std::vector<Turn> replaced = {};  ///< what it was done instead of, in order
  };

  // On the thread of the acts:
  void run(std::function<Result<std::int64_t>()> job, ActTicket ticket = 0);
  void publish(std::string failure, std::int64_t line, ActTicket ticket = 0);
  [[nodiscard]] const ReadLine& read(const JournalLine& line);
  [[nodiscard]] static JournalStatePtr base_of(const OnObservation& of, const std::vector<JournalLine>& lines);
  [[nodiscard]] bool asks_to_detect(std::int64_t n) const;
  [[nodiscard]] static JournalStatePtr after(const ReadLine& line, const OnObservation& of);
  void rebuild();
  void rebuild(std::size_t index);
  void tell_replayed(std::size_t done, std::size_t total);
  [[nodiscard]] std::string name_of(const JournalAct& act, const Turn& turn) const;
  [[nodiscard]] std::string step_name(std::int64_t n) const;
  [[nodiscard]] Result<std::int64_t> carry_out(std::size_t observation, std::int64_t ping_index, Command command,
                                               JournalStep* step);
  [[nodiscard]] Result<std::int64_t> carry_out_upon(std::vector<Turn>& replaced, std::size_t observation,
                                                    std::int64_t ping_index, Command command, JournalStep* step);
  [[nodiscard]] Result<void> write_replaced(std::vector<Turn>& replaced, JournalStep& step);
  [[nodiscard]] bool stand_last(const std::vector<Turn>& list, std::span<const std::int64_t> latest_first) const;
  [[nodiscard]] std::vector<Turn> take_last(std::size_t count);
  void put_back(std::vector<Turn> turns);
  bool turn_known(const std::vector<std::int64_t>& targets, const std::vector<std::int64_t>& replaced, bool undo);
  [[nodiscard]] Result<std::int64_t> turn(bool undo);
  [[nodiscard]] static History own_history(const JournalPlace& place);
  [[nodiscard]] Result<void> hold(const SurveyFiles& survey, std::size_t index);
  [[nodiscard]] Result<void> hold_journal();
  [[nodiscard]] Result<void> hold_turned(const std::vector<std::int64_t>& targets);
  void let_go_but_looked_at();
  void tell_unsearched();
  bool read_all();
  Result<void> write(const JournalLine& line);
  [[nodiscard]] CommandContext watched(std::size_t observation);
  [[nodiscard]] TimeNs now() const;
  void turn_back(bool undo);

  ChangeQueue& queue_;
  Options options_;
  Shown shown_;
  Step step_;
  std::atomic<bool> stopping_{false};
  std::atomic<int> waiting_{0};
  ActTicket tickets_ = 0;                                       ///< given so far
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);  ///< changes that come after the end are dropped
  // Touched by the thread of the acts alone:
  JournalPlace place_;
  History history_;  ///< of our own lines
  /// Size and time of the journals when they were read last; ours only while somebody else may write it.
  std::optional<std::map<std::filesystem::path, std::pair<std::uintmax_t, std::filesystem::file_time_type>>> read_;
  std::set<std::size_t> unsearched_told_;
  bool others_hold_ = false;  ///< why the last act was refused
  std::vector<std::string> notices_;
  std::map<std::size_t, OnObservation> open_;
  std::vector<Turn> done_;
  std::vector<Turn> undone_;
  std::map<std::int64_t, std::string> names_;
  std::map<std::pair<std::int64_t, TimeNs>, ReadLine> lines_read_;  ///< by n and time
  NamedLock lock_;                         ///< of our journal, taken with the first line that is written
  std::map<std::size_t, NamedLock> held_;  ///< observations
  std::size_t looked_at_ = 0;
  TaskThread thread_;  // the last member: it ends first
};

}  // namespace sonar
