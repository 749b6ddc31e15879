// SPDX-License-Identifier: Apache-2.0
// The schools' figures: measured behind the window after each act, those of earlier acts given up.
#include <utility>

#include "base/within_memory.h"
#include "session/document.h"

namespace sonar {

ProductPtr Document::product(std::size_t observation) const {
  const auto found = products_.find(observation);
  return found == products_.end() ? nullptr : found->second;
}

bool Document::all_measured() const {
  if (!survey_) return false;
  const auto& all = survey_->observations;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].grid && !products_.contains(i)) return false;
  }
  return true;
}

void Document::keep_survey_numbers(std::vector<SurveyNumber> numbers) {
  survey_numbers_ = std::move(numbers);
  changes_.tell(DocumentChange::measures);
}

void Document::measure_changed(const ChoicesShown& before) {
  for (const auto& [index, state] : choices_.states) {
    const auto old = before.states.find(index);
    if (old == before.states.end() || old->second != state) measure(index);
  }
}

void Document::measure(std::size_t index) {
  const OpenObservationPtr observation = open_observation(index);
  const JournalStatePtr state = choices_.states[index];
  if (!observation || !state) return;
  if (const auto running = measuring_.find(index); running != measuring_.end()) running->second.cancel();
  if (++measures_begun_ > 1) changes_.tell(DocumentChange::progress);
  const auto lines = choices_.lines;
  const auto work = std::make_shared<Work>(1);
  work->set_progress([give_way = GivesWay(way_)](std::string_view, std::int64_t, std::int64_t) mutable { give_way(); });
  const CancelToken posted = measures_.post([this, observation, state, lines, work, kept = measured_[index],
                                             refused = refused(index)](const CancelToken& token) {
    if (!token.cancelled()) measure_behind(observation, *state, *lines, refused, *kept, token, *work);
    queue_.post([this, alive = std::weak_ptr<bool>(alive_)] {
      if (!alive.expired()) take_measured();
    });
  });
  measuring_[index] = {posted, work};
}

void Document::measure_behind(const OpenObservationPtr& observation, const JournalState& state,
                              const std::vector<JournalLine>& lines, const RefusedPtr& refused, KeptMeasures& kept,
                              const CancelToken& token, Work& work) {
  GivesWay give_way(way_);
  if (!kept.read) {
    kept.measured =
        kept_measured(measured_file(options_.cache, observation->survey(), observation->files()), key_of(*observation));
    kept.read = true;
  }
  for (const std::int64_t ping_index : pings_to_measure(observation->engine(), state, kept.measured)) {
    give_way();
    if (token.cancelled()) return;
    observation->estimate_background(ping_index);
  }
  const std::vector<JournalLine> effective = effective_lines(lines);
  auto product = within_memory([&] {
    return state_product(observation->engine(), state,
                         {effective, options_.program_version, false, &kept.measured, *refused}, work);
  });
  if (!product) {
    if (product.error().code != ErrorCode::no_space) return;
    return post(token, [this, line = to_line(product.error())] { tell(line); });
  }
  auto shared = std::make_shared<const ObservationProduct>(std::move(*product));
  post(token, [this, index = observation->index(), shared] { take_product(index, shared); });
}

std::string Document::key_of(OpenObservation& observation) const {
  return key_of(observation.survey(), observation.files(), observation.engine().recipe());
}

/// For the next time the survey is opened.
void Document::keep_measures() {
  for (const auto& [index, job] : measuring_) job.cancel();
  measures_.wait();
  for (const auto& [index, kept] : measured_) {
    if (!kept->measured.changed) continue;
    OpenObservation& observation = *open_.at(index);
    const auto file = measured_file(options_.cache, observation.survey(), observation.files());
    keep_measured(file, key_of(observation), kept->measured);
  }
}

void Document::take_measured() {
  const bool shown = measures_begun_ > 1;
  const bool all = ++measures_done_ == measures_begun_;
  if (all) measures_begun_ = measures_done_ = 0;
  if (shown || all) changes_.tell(DocumentChange::progress);
}

}  // namespace sonar
