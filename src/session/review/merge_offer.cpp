// SPDX-License-Identifier: Apache-2.0
#include "session/review/merge_offer.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "session/app_model.h"
#include "session/open/survey_schools.h"

namespace sonar {
namespace {

/// Numbers of schools that are not the same object as before.
std::set<std::int64_t> changed_schools(const JournalState* before, const JournalState& now) {
  std::set<std::int64_t> numbers;
  for (const auto& school : now.schools) {
    const bool known = before != nullptr && std::ranges::find(before->schools, school) != before->schools.end();
    if (!known) numbers.insert(school->number);
  }
  return numbers;
}

const StateSchool* school_of(const JournalState& state, std::int64_t number) {
  const auto found = std::ranges::find(state.schools, number, [](const auto& school) { return school->number; });
  return found == state.schools.end() ? nullptr : found->get();
}

std::string offer_text(const MergeProposal& proposal, const JournalState& state) {
  const StateSchool* first = school_of(state, proposal.first);
  const StateSchool* other = school_of(state, proposal.other);
  if (first == nullptr || other == nullptr) return {};
  if (proposal.touching()) {
    return fmt::format("{} and {} touch in ping {}: merge them? ([school.merge_proposed])", school_title(*first),
                       school_title(*other), proposal.first_ping);
  }
  return fmt::format("{} begins in ping {} where {} ends in ping {}: merge them? ([school.merge_proposed])",
                     school_title(*other), proposal.other_ping, school_title(*first), proposal.first_ping);
}

}  // namespace

MergeOffer::MergeOffer(Workspace& workspace)
    : workspace_(workspace),
      listening_(workspace.document.changes(), [this](DocumentChange change) { hear(change); }) {}

void MergeOffer::hear(DocumentChange change) {
  if (change == DocumentChange::survey) {
    offers_.clear();
    declined_.clear();
    states_.clear();
    return changed_.tell();
  }
  if (change == DocumentChange::observation) return changed_.tell();
  if (change != DocumentChange::state) return;
  const ChoicesShown& now = workspace_.document.choices();
  const JournalLine* line = line_done(now);
  const std::string command = line == nullptr ? std::string{} : line->command;
  for (const auto& [index, state] : now.states) {
    const JournalStatePtr before = std::exchange(states_[index], state);
    if (!state || before == state) continue;
    std::set<std::int64_t> changed;
    if (command == "propagate" || command == "detect" || command == "split")
      changed = changed_schools(before.get(), *state);
    if (command == "split") {  // a human told them apart
      for (const std::int64_t a : changed) {
        for (const std::int64_t b : changed) declined_.emplace(index, std::min(a, b), std::max(a, b));
      }
    } else if (!changed.empty()) {
      look(index, state, std::move(changed));
    }
  }
  changed_.tell();
}

/// Behind the window: a survey may have thousands of pairs.
void MergeOffer::look(std::size_t observation, JournalStatePtr state, std::set<std::int64_t> changed) {
  const OpenObservationPtr open = workspace_.document.open_observation(observation);
  if (!open) return;
  ProposalLimits limits;
  limits.track = workspace_.document.recipe().track;
  limits.placement = [open](std::int64_t ping_index) { return open->placement(ping_index); };
  workspace_.document.run_beside([this, alive = std::weak_ptr<bool>(alive_), &queue = workspace_.queue, observation,
                                  open, state = std::move(state), changed = std::move(changed),
                                  limits = std::move(limits)](const CancelToken& token) mutable {
    limits.stopped = [&token] { return token.cancelled(); };
    auto found = merge_proposals(*state, open->context(), limits, changed);
    queue.post([this, alive, observation, state, found = std::move(found)] {
      if (!alive.expired()) take_found(observation, state, found);
    });
  });
}

void MergeOffer::take_found(std::size_t observation, const JournalStatePtr& state,
                            const std::vector<MergeProposal>& found) {
  const Offer* before = first();
  const auto shown = before == nullptr ? std::nullopt : std::optional(before->proposal);
  for (const MergeProposal& proposal : found) {
    std::erase_if(offers_, [&](const Offer& offer) {
      return offer.observation == observation && offer.proposal.first == proposal.first &&
             offer.proposal.other == proposal.other;
    });
    offers_.push_back({observation, proposal, state});
  }
  const Offer* now = first();
  if (now != nullptr && now->proposal != shown) {
    workspace_.document.tell(offer_text(now->proposal, workspace_.document.state(now->observation)));
  }
  changed_.tell();
}

const MergeOffer::Offer* MergeOffer::first() const {
  const auto& shown = workspace_.document.shown();
  if (!shown) return nullptr;
  const auto found = std::ranges::find_if(offers_, [&](const Offer& offer) {
    const auto [low, high] = std::minmax(offer.proposal.first, offer.proposal.other);
    return offer.observation == shown->index() && !declined_.contains({offer.observation, low, high}) &&
           still_holds(offer.proposal, *offer.told, workspace_.document.state());
  });
  return found == offers_.end() ? nullptr : &*found;
}

std::optional<MergeProposal> MergeOffer::standing() const {
  const Offer* offer = first();
  return offer == nullptr ? std::nullopt : std::optional(offer->proposal);
}

std::string MergeOffer::text() const {
  const auto offer = standing();
  return offer ? fmt::format("Merge school {} and school {}", offer->first, offer->other) : std::string{};
}

void MergeOffer::take() {
  const auto offer = standing();
  if (!offer) return;
  Document& document = workspace_.document;
  const StateSchool* first = school_of(document.state(), offer->first);
  const StateSchool* other = school_of(document.state(), offer->other);
  const CommandContext& context = document.shown()->context();
  const std::size_t observation = document.shown()->index();
  document.act(observation, offer->first_ping,
               MergeCommand{{key_of(first->masks, context), key_of(other->masks, context)}});
  workspace_.school.set(SchoolName{observation, offer->first});
}

void MergeOffer::decline() {
  const auto offer = standing();
  if (!offer) return;
  const auto [low, high] = std::minmax(offer->first, offer->other);
  declined_.emplace(workspace_.document.shown()->index(), low, high);
  changed_.tell();
}

void add_merge_offer(AppModel& app) {
  app.merge_offer = std::make_shared<MergeOffer>(app.workspace);
  MergeOffer& offer = *app.merge_offer;
  const auto stands = [&offer] { return offer.standing().has_value(); };
  app.actions.add({.id = std::string(kMergeProposedAction),
                   .menu = "&Schools",
                   .text = "Merge the two schools proposed",
                   .keys = {"Ctrl+J"},
                   .tip = "After a propagation or a detection: two schools touch, or one begins where the other ends",
                   .run = [&offer] { offer.take(); },
                   .enabled = stands,
                   .text_now = [&offer] { return offer.text(); }});
  app.actions.add({.id = "school.keep_apart",
                   .menu = "&Schools",
                   .text = "Keep the two schools proposed apart",
                   .keys = {"Ctrl+Shift+J"},
                   .tip = "They are not proposed to be merged again",
                   .run = [&offer] { offer.decline(); },
                   .enabled = stands});
}

}  // namespace sonar
