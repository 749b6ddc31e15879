// SPDX-License-Identifier: Apache-2.0
// What a review tells of decisions that were made, and shows of those that were taken back.
#include <fmt/format.h>

#include <optional>

#include "base/number_text.h"
#include "session/review/review.h"

namespace sonar {
namespace {

std::optional<DecideCommand> decision_of(const JournalLine* line) {
  if (line == nullptr || !is_decision(line->command)) return std::nullopt;
  const auto act = act_of(*line);
  if (!act) return std::nullopt;
  return std::get<DecideCommand>(act->command);
}

/// In whichever open observation it lies.
std::optional<SchoolName> school_with(const Document& document, const SchoolKey& voxel) {
  for (const auto& [index, state] : document.choices().states) {
    const OpenObservationPtr observation = document.open_observation(index);
    if (!state || !observation) continue;
    const auto at = school_at(*state, observation->context(), voxel);
    if (at) return SchoolName{index, state->schools[*at]->number};
  }
  return std::nullopt;
}

}  // namespace

std::string Review::note() const {
  return schools().empty() ? std::string{} : fmt::format("{} of {} left", unreviewed(), schools().size());
}

void Review::follow_act() {
  const ChoicesShown& choices = workspace().document.choices();
  if (const auto made = decision_of(line_done(choices))) tell_decided(*made);
  const JournalLine* line = line_undone(choices);
  const auto undone = decision_of(line);
  if (!undone) return;
  const auto name = choices.names.find(line->n);
  const std::string what = name == choices.names.end() ? fmt::format("line {}", line->n) : name->second;
  workspace().document.tell(fmt::format("taken back: {}; {} to review", what, note()));
  show_again(*undone);
}

void Review::tell_decided(const DecideCommand& command) const {
  if (command.decisions.empty() || !command.decisions.front().status) return;  // a species, a comment, a name
  Document& document = workspace().document;
  const Decision& first = command.decisions.front();
  const std::size_t count = command.decisions.size();
  const auto alone = count == 1 ? school_with(document, first.school) : std::nullopt;
  document.tell(fmt::format("{} {}; {} to review", alone ? title_of(document, *alone) : count_of(count, "school"),
                            *first.status == "unreviewed" ? "not reviewed" : *first.status, note()));
}

/// Whoever looks at one of the schools already stays there.
void Review::show_again(const DecideCommand& undone) {
  workspace().queue.post([this, undone, alive = std::weak_ptr<bool>(alive_)] {
    if (alive.expired()) return;
    const Document& document = workspace().document;
    std::optional<SchoolName> first;
    for (const Decision& decision : undone.decisions) {
      const auto school = school_with(document, decision.school);
      if (!school) continue;
      const bool on_show = document.shown() && document.shown()->index() == school->observation;
      if (on_show && school == workspace().school()) return;
      if (!first) first = school;
    }
    if (first) go_to(*first);
  });
}

}  // namespace sonar
