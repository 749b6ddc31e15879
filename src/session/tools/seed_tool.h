// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/task_thread.h"
#include "session/listening.h"
#include "session/open/workspace.h"
#include "session/playing/animation_driver.h"
#include "session/tools/growth.h"

namespace sonar {

/// Schools by seeds, in whatever view a voxel was pointed at: one for all views of an app.
///
/// A press upon nothing grows a new school and selects it; upon a school it selects that one. With shift the growth joins
/// the selected school, with control it is taken from it. A double press carries the school under it through time: the
/// press before has grown or selected it, so that there is one school, made by two acts, each of which can be undone.
///
/// While the last act of all is a growth by this tool, a change of its parameters grows it anew: shown at once as the
/// preview; when the parameters have rested for kRest_s, and no hand holds a slider of theirs any more (or something else is
/// done), it is done instead of the old growth. A selected school grows anew with each other tolerance in the same way: one
/// that clicks and propagations have made from its own seeds, and is then carried on as before, all in one step; one that
/// no human has shaped in this ping, from its loudest member. So each drag of a slider is one step: undo brings back the
/// growth before, and the parameters that it was grown under; redo those of the drag.
/// threads  the window's
class SeedTool {
 public:
  /// Both outlive the tool.
  SeedTool(Workspace& workspace, AnimationDriver& animations);
  ~SeedTool();
  SeedTool(const SeedTool&) = delete;
  SeedTool& operator=(const SeedTool&) = delete;

  /// Sets workspace.preview to what a press there would select; latest wins.
  void hover(const Voxel& voxel, bool shift, bool control);
  /// The pointer is over no voxel.
  void leave();
  void press(const Voxel& voxel, bool shift, bool control, bool double_press);
  /// A press and a double press there in one step to undo: what was refused becomes a school after all.
  void take_in(const Voxel& voxel);
  /// Selects the school there, or none; grows nothing.
  void select(const Voxel& voxel);
  /// Index in the state of the school that has a voxel of the ping on show.
  [[nodiscard]] std::optional<std::size_t> school_under(const Voxel& voxel) const;

  /// How long parameters rest before a growth is done anew, s.
  static constexpr double kRest_s = 0.3;

  /// Returns when the last preview is on its way through the queue; for tests.
  void wait() { growing_.wait(); }

 private:
  /// Where a pointer asks for a growth.
  struct Place {
    Voxel voxel;
    bool shift = false;
    bool control = false;
  };
  /// A growth that stands last in the journal.
  struct Made {
    std::int64_t line = 0;
    std::size_t observation = 0;
    GrowCommand command;
    StagedPingPtr staged;     ///< the ping on show when it was done
    JournalStatePtr before;   ///< the state it was done upon
    std::int64_t number = 0;  ///< of the school that it made or changed
    std::int64_t ping = 0;    ///< that it was done on
    std::vector<PropagateCommand> followed = {};
  };
  /// A growth anew that was done: what undo and redo set the parameters to.
  struct Dragged {
    std::int64_t step = 0;  ///< JournalLine::step, or n of its only line
    GrowParams before;
    GrowParams after;
  };
  struct Pending {
    std::size_t observation = 0;
    StagedPingPtr staged;
    GrowCommand command;
    bool carry_on = false;    ///< a second press came meanwhile
    std::int64_t number = 0;  ///< of the school that is replaced; 0 = another growth
    std::int64_t ping = 0;
    std::vector<PropagateCommand> followed = {};  ///< of the same step
    std::vector<ActTicket> tickets = {};          ///< of the step's acts
    std::size_t done = 0;                         ///< of these
    JournalStatePtr before = {};                  ///< known with the first line
    std::int64_t first_line = 0;                  ///< its n
    std::optional<GrowParams> was = {};           ///< of a growth anew: the parameters before
    std::int64_t instead_of = 0;                  ///< JournalStep::instead_of
  };
  /// A growth that is looked at while its parameters move.
  struct Anew {
    std::size_t observation = 0;
    StagedPingPtr staged;
    JournalStatePtr before;  ///< the state it would be done upon
    GrowCommand command;
    std::int64_t number = 0;                      ///< of the school that it would give
    std::int64_t instead_of = 0;                  ///< made_'s line; 0 = the next act
    std::int64_t ping = 0;                        ///< of the seeds
    std::vector<PropagateCommand> followed = {};  ///< in the same step
    GrowParams was = {};                          ///< the parameters before the first change
  };

  // What would be selected:
  void show_place();
  void show(GrowthTrial trial, std::int64_t instead_of);
  void say(std::string text);
  void drop_preview();
  [[nodiscard]] Result<GrowCommand> command_at(const Place& place) const;
  // What is selected:
  void hear(DocumentChange change);
  void forget();
  void take_state();
  void take_own_act(JournalStatePtr before);
  void take_made(const Pending& done);
  void act(Pending what);
  void grow(GrowCommand command, std::vector<PropagateCommand> followed);
  [[nodiscard]] std::optional<PropagateCommand> propagation_from(std::size_t observation, std::int64_t ping,
                                                                 const SeedKey& seed) const;
  void carry_on(std::size_t observation, std::int64_t ping, const SeedKey& seed);
  // What is selected anew:
  void parameters_changed(bool tolerance, const GrowParams& was);
  bool grow_selected_anew(const GrowParams& was);
  [[nodiscard]] std::vector<PropagateCommand> as_set(std::vector<PropagateCommand> followed,
                                                     const SchoolKey& from) const;
  void grow_anew(Anew anew);
  [[nodiscard]] bool stands_last() const;
  bool rest(double now_s);
  void finish_growing_anew();
  void follow_undo();

  Workspace& workspace_;
  AnimationDriver& animations_;
  std::optional<Place> place_;
  bool over_ = false;       ///< the pointer is over place_
  std::int64_t asked_ = 0;  ///< previews so far
  std::int64_t stale_ = 0;  ///< those up to this one are wanted no more
  std::optional<Pending> pending_;
  std::optional<Made> made_;
  std::optional<Anew> anew_;
  std::vector<Dragged> dragged_;
  double rests_since_s_ = std::numeric_limits<double>::quiet_NaN();
  std::weak_ptr<OpenObservation> of_;  ///< the observation on show
  JournalStatePtr state_;              ///< of the observation on show, as it was last told
  GrowParams params_;
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);
  TaskThread growing_;
  Listening listening_;  // the last members: they end first
};

}  // namespace sonar
