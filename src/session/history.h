// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/commands/state.h"
#include "pipeline/journal/journal.h"

namespace sonar {

/// What can be undone and redone, as a journal's lines say it. A new act ends what could be redone. An undo that is a line of a
/// step (JournalStep::instead_of) is part of what that step did: to undo the step brings back what it replaced.
class History {
 public:
  /// first  number of the first line
  explicit History(std::int64_t first) : last_(first - 1) {}

  void add(const JournalLine& line);
  /// n of the lines that undo takes back, in the order in which it does: of a step all, else one. Empty where there is
  /// none.
  [[nodiscard]] std::vector<std::int64_t> undoable() const { return step_at_end(done_); }
  [[nodiscard]] std::vector<std::int64_t> redoable() const { return step_at_end(undone_); }
  /// n of the lines that a step was done instead of, in their order; empty where it replaced none.
  /// step  JournalLine::step
  [[nodiscard]] const std::vector<std::int64_t>& replaced_by(std::int64_t step) const;
  /// JournalLine::step of an act's line; 0 = it stands alone.
  [[nodiscard]] std::int64_t step_of(std::int64_t n) const;
  /// n of the next line.
  [[nodiscard]] std::int64_t next() const { return last_ + 1; }

 private:
  [[nodiscard]] std::vector<std::int64_t> step_at_end(const std::vector<std::int64_t>& list) const;
  void turn(std::int64_t target, bool undo, std::int64_t step);

  std::vector<std::int64_t> done_;
  std::vector<std::int64_t> undone_;
  std::map<std::int64_t, std::int64_t> step_;                   ///< by n, of those that are part of one
  std::map<std::int64_t, std::vector<std::int64_t>> replaced_;  ///< by step
  std::int64_t last_ = 0;
};

/// What an act did, for people: "grow school 3". before, after: the observation's states round it; null = not known.
[[nodiscard]] std::string act_name(const JournalAct& act, const CommandContext& context, const JournalState* before,
                                   const JournalState* after);

}  // namespace sonar
