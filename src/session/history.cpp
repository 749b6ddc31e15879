// SPDX-License-Identifier: Apache-2.0
#include "session/history.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ranges>

namespace sonar {
namespace {

std::optional<std::int64_t> target_of(const JournalLine& line) {
  const auto found = line.args->find("target");
  if (found == line.args->end() || !found->is_number_integer()) return std::nullopt;
  return found->get<std::int64_t>();
}

/// Moves a number from one list to the end of another.
void move_over(std::int64_t n, std::vector<std::int64_t>& from, std::vector<std::int64_t>& to) {
  const auto found = std::find(from.begin(), from.end(), n);
  if (found == from.end()) return;
  from.erase(found);
  to.push_back(n);
}

/// " school 3", or nothing where the number is not known.
std::string school_text(const JournalState* state, const CommandContext& context, const SchoolKey& key) {
  if (state == nullptr) return " school";
  const auto at = school_at(*state, context, key);
  return at ? " " + school_title(*state->schools[*at]) : " school";
}

/// The school that an act made.
std::string made_text(const JournalState* after, std::int64_t n) {
  if (after == nullptr) return " school";
  for (const auto& school : after->schools) {
    if (school->made_by == n) return " " + school_title(*school);
  }
  return " school";
}

}  // namespace

void History::add(const JournalLine& line) {
  last_ = std::max(last_, line.n);
  if (line.command == "undo" || line.command == "redo") {
    const auto target = target_of(line);
    if (target) turn(*target, line.command == "undo", line.step);
    return;
  }
  done_.push_back(line.n);
  if (line.step != 0) step_[line.n] = line.step;
  undone_.clear();
}

/// step  of the undo or redo itself; 0 = it is of none
void History::turn(std::int64_t target, bool undo, std::int64_t step) {
  undo ? move_over(target, done_, undone_) : move_over(target, undone_, done_);
  if (step == 0) return;
  std::vector<std::int64_t>& replaced = replaced_[step];
  const auto known = std::find(replaced.begin(), replaced.end(), target);
  if (step_of(target) != step) {
    // What the step replaces; until its first act is written it can be had back by redo.
    if (undo && known == replaced.end()) replaced.insert(replaced.begin(), target);
    if (!undo && std::find(done_.begin(), done_.end(), target) == done_.end()) done_.push_back(target);
  } else if (!undo) {
    for (const std::int64_t n : replaced) std::erase(undone_, n);
  }
}

const std::vector<std::int64_t>& History::replaced_by(std::int64_t step) const {
  static const std::vector<std::int64_t> kNone;
  const auto found = replaced_.find(step);
  return found == replaced_.end() ? kNone : found->second;
}

std::int64_t History::step_of(std::int64_t n) const {
  const auto found = step_.find(n);
  return found == step_.end() ? 0 : found->second;
}

std::vector<std::int64_t> History::step_at_end(const std::vector<std::int64_t>& list) const {
  if (list.empty()) return {};
  const auto step = step_.find(list.back());
  if (step == step_.end()) return {list.back()};
  std::vector<std::int64_t> lines;
  for (const std::int64_t line : std::views::reverse(list)) {
    const auto of = step_.find(line);
    if (of != step_.end() && of->second == step->second) lines.push_back(line);
  }
  return lines;
}

std::string act_name(const JournalAct& act, const CommandContext& context, const JournalState* before,
                     const JournalState* after) {
  const Sentence said = sentence_of(act.command);
  std::string name = said.words;
  if (said.school) name += school_text(before, context, *said.school);
  if (said.makes_school) name += made_text(after, act.n);
  return name + said.end;
}

}  // namespace sonar
