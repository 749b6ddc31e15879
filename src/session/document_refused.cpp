// SPDX-License-Identifier: Apache-2.0
// Echoes that detection refused: those that are no school by what humans have chosen since.
#include <utility>

#include "pipeline/stages/refused_echoes.h"
#include "session/document.h"

namespace sonar {

RefusedPtr Document::refused(std::size_t observation) const {
  static const auto kNone = std::make_shared<const std::vector<RefusedEcho>>();
  const auto found = refused_.find(observation);
  return found == refused_.end() ? kNone : found->second;
}

void Document::follow_refused(const ChoicesShown& before) {
  if (found_refused_.empty()) return;
  const std::vector<JournalLine> lines = effective_lines(*choices_.lines);
  for (const auto& [index, found] : found_refused_) {
    const auto state = choices_.states.find(index);
    const auto old = before.states.find(index);
    if (state == choices_.states.end() || !state->second) continue;
    if (old != before.states.end() && old->second == state->second) continue;
    const CommandContext& context = chosen_on_.at(index)->context();
    const bool asked = asks_for_detection(lines, context.times);
    refused_[index] = std::make_shared<const std::vector<RefusedEcho>>(
        still_refused(asked ? found : std::vector<RefusedEcho>{}, *state->second, *context.grid));
  }
}

}  // namespace sonar
