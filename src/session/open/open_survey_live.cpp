// SPDX-License-Identifier: Apache-2.0
// A survey that is being recorded: more pings, more observations, the same choices.
#include <algorithm>
#include <utility>

#include "session/open/document.h"

namespace sonar {
namespace {

/// Whether a survey is another one with pings and observations added behind. The last ping of the one before may have been
/// opened in the middle of its being written: it counts when it is whole.
bool goes_on(const SurveyFiles& before, const SurveyFiles& grown) {
  return before.observations.size() <= grown.observations.size() &&
         std::equal(before.observations.begin(), before.observations.end(), grown.observations.begin(),
                    [&](const ObservationFiles& a, const ObservationFiles& b) {
                      return a.name == b.name && a.pings.size() <= b.pings.size() + 1 &&
                             a.grid.has_value() == b.grid.has_value() &&
                             before.ping_time(a, 0) == grown.ping_time(b, 0);
                    });
}

bool same_pings(const OpenObservation& open, const SurveyFiles& grown) {
  const ObservationFiles& before = open.files();
  const ObservationFiles& now = grown.observations[open.index()];
  return before.pings.size() == now.pings.size() &&
         open.survey().entry(before.pings.back()).channels == grown.entry(now.pings.back()).channels;
}

/// A product of fewer pings, with those that came since: whoever draws it may look at any of them.
ProductPtr with_pings(const ProductPtr& product, const ObservationFiles& observation) {
  if (!product || product->pings.size() == observation.navigation.size()) return product;
  if (product->pings.size() > observation.navigation.size()) return nullptr;
  ObservationProduct grown = *product;
  grown.pings = observation.navigation;
  for (std::size_t i = 0; i < product->pings.size(); ++i) grown.pings[i].bad = product->pings[i].bad;
  return std::make_shared<const ObservationProduct>(std::move(grown));
}

}  // namespace

void OpenSurvey::take_product(std::size_t observation, const ProductPtr& product) {
  open_.at(observation).product = with_pings(product, read_.files->observations[observation]);
  rest_unless_shown(observation);
  tell(DocumentChange::measures);
}

bool OpenSurvey::grow(std::shared_ptr<const SurveyFiles> survey) {
  if (!read_.files || !choices_thread_ || !goes_on(*read_.files, *survey)) return false;
  read_.files = std::move(survey);
  const DocumentOptions& options = document_.options();
  for (auto& [index, at] : open_) {
    if (same_pings(*at.chosen_on, *read_.files)) continue;
    at.chosen_on =
        std::make_shared<OpenObservation>(*at.chosen_on, read_.files, options.prefetch, options.memory_bytes);
    at.open = calibrated(at.chosen_on);
    at.product = with_pings(at.product, read_.files->observations[index]);
    choices_thread_->grow(at.chosen_on);
  }
  const OpenObservationPtr before = shown_;
  if (shown_) {
    shown_ = open_.at(shown_->index()).open;
    ping_ = std::min(ping_, shown_->pings() - 1);
  }
  tell(DocumentChange::observation);
  // One that was on its way to the observation as it was comes no more.
  if (shown_ != before && (!staged_ || staged_->ping_index != ping_)) look_at(ping_);
  return true;
}

}  // namespace sonar
