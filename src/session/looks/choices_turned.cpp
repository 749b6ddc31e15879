// SPDX-License-Identifier: Apache-2.0
// Undo, redo, and acts that are done instead of the last one.
#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <ranges>
#include <utility>

#include "session/looks/choices.h"

namespace sonar {

/// Takes them back in the journal too, as part of a step. Where one cannot be written after another was, everything is
/// carried out anew and nothing is left to put back.
Result<void> Choices::write_replaced(std::vector<Turn>& replaced, JournalStep& step) {
  const std::vector<Turn> turns = std::exchange(replaced, {});
  for (const Turn& turn : std::views::reverse(turns)) {
    JournalLine line;
    line.n = history_.next();
    line.decided = now();
    line.operator_name = options_.operator_name;
    line.command = "undo";
    *line.args = {{"target", turn.n}};
    line.step = step.first == 0 ? line.n : step.first;
    if (auto written = write(line); !written) {
      step.first == 0 ? put_back(turns) : rebuild();
      return written;
    }
    step.first = line.step;
  }
  return {};
}

/// Whether the states round these are known, and nothing was done after them.
bool Choices::stand_last(const std::vector<Turn>& list, std::span<const std::int64_t> latest_first) const {
  if (latest_first.size() > list.size()) return false;
  for (std::size_t i = 0; i < latest_first.size(); ++i) {
    const Turn& turn = list[list.size() - 1 - i];
    if (turn.n != latest_first[i] || turn.before.size() != open_.size() || asks_to_detect(turn.n)) return false;
  }
  return true;
}

/// The last turns, whose states are known; the state is that before them.
std::vector<Choices::Turn> Choices::take_last(std::size_t count) {
  const auto first = done_.end() - static_cast<std::ptrdiff_t>(count);
  std::vector<Turn> turns(std::make_move_iterator(first), std::make_move_iterator(done_.end()));
  done_.erase(first, done_.end());
  for (auto& [index, of] : open_) of.state = turns.front().before.at(index);
  return turns;
}

void Choices::put_back(std::vector<Turn> turns) {
  for (Turn& turn : turns) {
    for (auto& [index, of] : open_) of.state = turn.after.at(index);
    done_.push_back(std::move(turn));
  }
}

/// False where the states are not known, and everything must be carried out anew.
/// replaced  what the turned step was done instead of, in order
bool Choices::turn_known(const std::vector<std::int64_t>& targets, const std::vector<std::int64_t>& replaced,
                         bool undo) {
  std::vector<Turn>& from = undo ? done_ : undone_;
  if (!stand_last(from, targets)) return false;
  Turn& first = undo ? from[from.size() - targets.size()] : from.back();
  const std::vector<std::int64_t> latest_first(replaced.rbegin(), replaced.rend());
  if (undo ? first.replaced.size() != replaced.size() || !stand_last(first.replaced, latest_first)
           : !stand_last(done_, latest_first)) {
    return false;
  }
  if (!undo && !replaced.empty()) first.replaced = take_last(replaced.size());
  for (std::size_t i = 0; i < targets.size(); ++i) {
    for (auto& [index, of] : open_) of.state = undo ? from.back().before[index] : from.back().after[index];
    (undo ? undone_ : done_).push_back(std::move(from.back()));
    from.pop_back();
  }
  if (undo) put_back(std::exchange(undone_.back().replaced, {}));
  return true;
}

Result<std::int64_t> Choices::turn(bool undo) {
  const auto turned = [&] { return undo ? history_.undoable() : history_.redoable(); };
  const auto none = [&] {
    return fail(ErrorCode::usage, undo ? "there is nothing to undo" : "there is nothing to redo");
  };
  if (turned().empty()) return none();
  if (auto held = hold_journal(); !held) return pass_on(held);
  const std::vector<std::int64_t> targets = turned();  // the journal may have proved another's
  if (targets.empty()) return none();
  if (auto held = hold_turned(targets); !held) return pass_on(held);
  const std::int64_t step = history_.step_of(targets.front());
  const std::vector<std::int64_t> replaced = history_.replaced_by(step);
  std::vector<std::pair<bool, std::int64_t>> turns;  // undone?, which
  if (undo) {
    for (const std::int64_t n : replaced) turns.emplace_back(false, n);
  } else {
    for (const std::int64_t n : std::views::reverse(replaced)) turns.emplace_back(true, n);
  }
  for (const std::int64_t n : targets) turns.emplace_back(undo, n);
  JournalLine line;
  line.decided = now();
  line.operator_name = options_.operator_name;
  if (!replaced.empty()) line.step = step;
  for (const auto& [undone, target] : turns) {
    line.n = history_.next();
    line.command = undone ? "undo" : "redo";
    *line.args = {{"target", target}};
    const auto written = write(line);
    if (written) continue;
    if (target != turns.front().second) rebuild();  // some of the step's lines were turned
    return pass_on(written);
  }
  if (!turn_known(targets, replaced, undo)) rebuild();  // what was undone before this run began
  return line.n;
}

}  // namespace sonar
