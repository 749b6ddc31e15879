// SPDX-License-Identifier: Apache-2.0
// What an act did where nobody looks is told.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <variant>

#include "base/number_text.h"
#include "pipeline/journal/continued.h"
#include "session/open/document.h"

namespace sonar {
namespace {

/// Numbers of schools that are gone.
std::vector<std::int64_t> gone(const JournalState& before, const JournalState& after) {
  std::vector<std::int64_t> numbers;
  for (const auto& school : before.schools) {
    const bool stays = std::any_of(after.schools.begin(), after.schools.end(),
                                   [&](const auto& one) { return one->number == school->number; });
    if (!stays) numbers.push_back(school->number);
  }
  return numbers;
}

/// Whether two states choose the same; a state that was built anew shares nothing with the one before.
bool same_choices(const JournalState& a, const JournalState& b) {
  const auto same_school = [](const auto& one, const auto& other) {
    if (one == other) return true;
    const SchoolRow& x = one->masks.decided;
    const SchoolRow& y = other->masks.decided;
    const auto same_ping = [](const auto& p, const auto& q) {
      return p.ping_index == q.ping_index && p.mask == q.mask;
    };
    return one->number == other->number && x.status == y.status && x.species == y.species && x.comment == y.comment &&
           x.name == y.name && std::ranges::equal(one->masks.pings, other->masks.pings, same_ping);
  };
  return std::ranges::equal(a.schools, b.schools, same_school) && a.events == b.events && a.bad_pings == b.bad_pings &&
         (a.calibration == nullptr) == (b.calibration == nullptr);
}

/// The school that a propagation made, or carried on; null where there is none.
/// n  of its line
const StateSchool* followed_school(const JournalState& state, const CommandContext& context, std::int64_t n,
                                   const PropagateCommand& command) {
  if (command.school) {
    const auto known = school_at(state, context, *command.school);
    return known ? state.schools[*known].get() : nullptr;
  }
  const auto made =
      std::find_if(state.schools.begin(), state.schools.end(), [n](const auto& one) { return one->made_by == n; });
  return made == state.schools.end() ? nullptr : made->get();
}

/// "30 pings"; by two numbers a line would be a riddle.
std::string reach_text(std::int64_t backward, std::int64_t forward) {
  if (backward > 0 && forward > 0 && backward != forward) return "its reach";
  const std::int64_t pings = std::max(backward, forward);
  return count_of(static_cast<std::size_t>(pings), "ping");
}

std::vector<std::string> names_of(const std::vector<std::filesystem::path>& paths) {
  std::vector<std::string> names;
  for (const auto& path : paths) names.push_back(path.string());
  return names;
}

}  // namespace

std::string why_no_grid(const ObservationFiles& observation) {
  for (const Diagnostic& note : observation.diagnostics) {
    if (note.code == DiagnosticCode::no_grid || note.code == DiagnosticCode::no_common_range) {
      return fmt::format("{} cannot be shown: {}", observation.name, note.text);
    }
  }
  return observation.name + " cannot be shown: it has no grid of fans and beams";
}

std::string OpenSurvey::nothing_shown() const {
  if (!read_.files) return {};
  if (shown_) return staged_ ? std::string{} : unreadable_;
  const auto& all = read_.files->observations;
  if (all.empty()) return fmt::format("there are no pings in {}", fmt::join(names_of(read_.paths), ", "));
  if (std::any_of(all.begin(), all.end(), [](const auto& one) { return one.grid.has_value(); })) return {};
  std::string why = why_no_grid(all.front());
  if (all.size() > 1) why += fmt::format("; nor can {} more observations", all.size() - 1);
  return why;
}

void OpenSurvey::tell_beyond_reach() {
  const JournalLine* line = line_done(choices_);
  if (line == nullptr || line->command != "propagate") return;
  const auto act = act_of(*line);
  if (!act) return;
  const auto& command = std::get<PropagateCommand>(act->command);
  for (const auto& [index, state] : choices_.states) {
    const OpenObservationPtr observation = open_observation(index);
    if (!observation || !state || !ping_at(observation->context(), line->ping_time)) continue;
    const StateSchool* school = followed_school(*state, observation->context(), line->n, command);
    const std::string ends = school == nullptr ? std::string{} : open_ends(*state, *school);
    // Of the sides that it was just followed to.
    std::int64_t backward = 0;
    std::int64_t forward = 0;
    if (ends_first(ends) && goes_backward(command)) backward = command.reach_backward.value_or(command.reach);
    if (ends_last(ends) && goes_forward(command)) forward = command.reach_forward.value_or(command.reach);
    if (backward == 0 && forward == 0) continue;
    tell(fmt::format("{} goes on beyond {}: continue? ([school.continue])", school_title(*school),
                     reach_text(backward, forward)));
  }
}

void OpenSurvey::tell_unseen(const ChoicesShown& before) {
  const JournalLine* line = line_done(choices_);
  if (line == nullptr) return;
  const bool turned = line->command == "undo" || line->command == "redo";
  const bool takes_over = line->command == "propagate" || line->command == "grow" || line->command == "brush";
  if (!turned && !takes_over) return;
  // A review goes to the school that it was about.
  if (const JournalLine* undone = line_undone(choices_); undone != nullptr && is_decision(undone->command)) return;
  for (const auto& [index, now] : choices_.states) {
    const auto old = before.states.find(index);
    if (old == before.states.end() || !old->second || !now || same_choices(*old->second, *now)) continue;
    const std::string& name = read_.files->observations[index].name;
    if (takes_over) {
      const auto numbers = gone(*old->second, *now);
      if (!numbers.empty()) {
        tell(fmt::format("school{} {} of {} became part of what was selected (undo takes it back)",
                         numbers.size() == 1 ? "" : "s", fmt::join(numbers, ", "), name));
      }
    } else if (!shown_ || shown_->index() != index) {
      const std::int64_t target = line->args->value("target", std::int64_t{0});
      const auto what = choices_.names.find(target);
      tell(fmt::format("{} in {}: {}", line->command == "undo" ? "taken back" : "done again", name,
                       what == choices_.names.end() ? fmt::format("line {}", target) : what->second));
    }
  }
}

}  // namespace sonar
