// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "pipeline/commands/state.h"

namespace sonar {

/// One act at work on a copy of the state: what the commands have in common.
class Edit {
 public:
  Edit(const JournalAct& act, std::int64_t ping_index, const JournalState& state, const CommandContext& context)
      : act_(act), ping_(ping_index), context_(context), state_(state) {}

  [[nodiscard]] std::int64_t ping() const { return ping_; }
  [[nodiscard]] const CommandContext& context() const { return context_; }
  [[nodiscard]] const JournalState& state() const { return state_; }
  [[nodiscard]] const SchoolMasks& masks(std::size_t school) const { return state_.schools[school]->masks; }
  /// Index of the school that a key names; that it is known by an older product alone is noted. errors: bad_parameter
  [[nodiscard]] Result<std::size_t> find(const SchoolKey& key);
  /// The act's runs by rows of the grid. errors: bad_parameter: a run outside the grid
  [[nodiscard]] Result<std::vector<Run>> rows_of(const std::vector<RunKey>& runs, const Shape3& shape) const;
  /// Voxels of other schools than this one that humans gave or confirmed to them.
  [[nodiscard]] PingMask taken(std::int64_t ping_index, std::optional<std::size_t> but) const;
  [[nodiscard]] const PingMask& mask(std::size_t school, std::int64_t ping_index) const;

  /// A new school of the line's operator; nobody has decided about it yet.
  std::size_t add(SchoolMasks masks);
  /// Notes that a human changed a school, in whatever way; a detected one is `corrected` from now on.
  void touch(std::size_t school);
  void decide(std::size_t school, const Decision& decision);
  /// What was found gets its numbers, the next ones; so many are taken at least.
  void number_detected(std::int64_t at_least);
  /// After touch(): only such acts have made the school.
  void set_grown(std::size_t school, std::shared_ptr<const GrownFrom> grown) {
    writable(school).grown = std::move(grown);
  }
  /// An empty mask takes the ping away. threshold_db: NaN = as it was
  void set_mask(std::size_t school, std::int64_t ping_index, PingMask mask, double threshold_db = kUnknown);
  void set_pings(std::size_t school, std::vector<SchoolMasks::InPing> pings);
  /// All other schools lose these voxels. whole: a detected mask that shares much with them is the same fish and goes.
  void take(std::int64_t ping_index, const PingMask& voxels, std::size_t owner, bool whole);
  void set_reach(std::size_t school, const ReachEnds& ends) { writable(school).masks.reach = ends; }
  /// What is known of a school's ends holds for the one that it becomes part of.
  void take_ends(ReachEnds gone, std::size_t into);
  /// What is split off is another school: detection joins it no more with what it is split from.
  void part(std::size_t from, const std::vector<SchoolMasks::InPing>& apart);
  /// What was found of a detected school tells from now on what belongs to another one.
  void give_found(std::size_t from, std::size_t to);
  void note(DiagnosticCode code, std::string text);
  void add_event(const EventCommand& event);
  /// The propagation that gives what was made: as far as it was let go.
  void carried_out_as(PropagateCommand reached) { reached_ = std::move(reached); }
  [[nodiscard]] const std::optional<PropagateCommand>& reached() const { return reached_; }
  /// errors  bad_parameter: there is no such mark
  [[nodiscard]] Result<void> remove_event(const EventCommand& event);
  void calibrate(const CalibrationParams& calibration) {
    state_.calibration = std::make_shared<const CalibrationParams>(calibration);
  }
  void call_bad(const BadPingsCommand& bad) { state_.bad_pings.push_back(bad); }
  void call_good(const GoodPingsCommand& good);
  void remove(std::size_t school) { set_pings(school, {}); }

  /// The state without the schools that have nothing left.
  [[nodiscard]] JournalState done();

 private:
  StateSchool& writable(std::size_t school);
  /// A detected one of which a human takes voxels: what was found is kept.
  void reduce(std::size_t school);
  void note_carried(const SchoolKey& then, const SchoolKey& now);

  const JournalAct& act_;
  std::int64_t ping_;
  const CommandContext& context_;
  JournalState state_;
  std::optional<PropagateCommand> reached_;
  std::vector<std::int64_t> reduced_;  ///< numbers of detected schools of which a human took voxels
};

// One function a command; each is pure.
[[nodiscard]] Result<void> carry_out(Edit& edit, const PropagateCommand& command);
[[nodiscard]] Result<void> carry_out(Edit& edit, const GrowCommand& command);
[[nodiscard]] Result<void> carry_out(Edit& edit, const BrushCommand& command);
[[nodiscard]] Result<void> carry_out(Edit& edit, const EraseCommand& command);
[[nodiscard]] Result<void> carry_out(Edit& edit, const ReshapeCommand& command);
[[nodiscard]] Result<void> carry_out(Edit& edit, const MergeCommand& command);
[[nodiscard]] Result<void> carry_out(Edit& edit, const SplitCommand& command);
[[nodiscard]] Result<void> carry_out(Edit& edit, const HandOverCommand& command);
[[nodiscard]] Result<void> carry_out(Edit& edit, const DeleteCommand& command);
[[nodiscard]] Result<void> carry_out(Edit& edit, const DecideCommand& command);
[[nodiscard]] Result<void> carry_out(Edit& edit, const EventCommand& command);
[[nodiscard]] Result<void> carry_out(Edit& edit, const BadPingsCommand& command);
[[nodiscard]] Result<void> carry_out(Edit& edit, const RemoveEventCommand& command);
[[nodiscard]] Result<void> carry_out(Edit& edit, const GoodPingsCommand& command);
[[nodiscard]] Result<void> carry_out(Edit& edit, const CalibrateCommand& command);
/// Changes no mask: what is found lies under the first line.
[[nodiscard]] Result<void> carry_out(Edit& edit, const DetectCommand& command);

}  // namespace sonar
