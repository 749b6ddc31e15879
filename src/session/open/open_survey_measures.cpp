// SPDX-License-Identifier: Apache-2.0
// The schools' figures: measured behind the window after each act, those of earlier acts given up.
#include <algorithm>
#include <utility>

#include "base/within_memory.h"
#include "session/open/document.h"

namespace sonar {
namespace {

/// Whether figures of other masks are needed: those of two versions never stand in one table.
bool all_known(const ObservationProduct& known, const ObservationProduct& as_made) {
  return known.masks.size() == as_made.masks.size() && known.school_pings.size() == as_made.school_pings.size();
}

}  // namespace

ProductPtr OpenSurvey::product(std::size_t observation) const {
  const auto found = open_.find(observation);
  return found == open_.end() ? nullptr : found->second.product;
}

ProductPtr OpenSurvey::as_made(std::size_t observation) const {
  const auto found = open_.find(observation);
  return found == open_.end() ? nullptr : found->second.as_made;
}

bool OpenSurvey::all_measured() const {
  if (!read_.files) return false;
  const auto& all = read_.files->observations;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].grid && !product(i)) return false;
  }
  return true;
}

const std::string& OpenSurvey::unmeasured() const {
  static const std::string none;
  const auto failed =
      std::find_if(open_.begin(), open_.end(), [](const auto& at) { return !at.second.unmeasured.empty(); });
  return failed == open_.end() ? none : failed->second.unmeasured;
}

void OpenSurvey::keep_survey_numbers(std::vector<SurveyNumber> numbers) {
  survey_numbers_ = std::move(numbers);
  tell(DocumentChange::measures);
}

void OpenSurvey::measure_changed(const ChoicesShown& before) {
  for (const auto& [index, state] : choices_.states) {
    const auto old = before.states.find(index);
    if (old == before.states.end() || old->second != state) measure(index);
  }
}

void OpenSurvey::measure(std::size_t index) {
  const auto at = open_.find(index);
  const JournalStatePtr state = choices_.states[index];
  if (at == open_.end() || !state) return;
  if (at->second.measuring) at->second.measuring->cancel();
  at->second.unmeasured.clear();
  if (++measures_begun_ > 1) tell(DocumentChange::progress);
  const auto work = std::make_shared<Work>(1);
  work->set_progress([give_way = GivesWay(document_.right_of_way())](std::string_view, std::int64_t,
                                                                     std::int64_t) mutable { give_way(); });
  const CancelToken posted =
      measures_.post([this, observation = at->second.open, state, lines = choices_.lines, work, kept = at->second.kept,
                      refused = refused(index), events = found_events(index), as_made = at->second.as_made,
                      memory = document_.options().memory_bytes](const CancelToken& token) {
        const auto measured = within_memory([&]() -> Result<void> {
          if (token.cancelled()) return {};
          return measure_behind(observation, *state, *lines, refused, events, as_made, *kept, memory, token, *work);
        });
        if (!measured && measured.error().code != ErrorCode::cancelled) {
          post(token, [this, index = observation->index(), line = to_line(measured.error())] {
            take_unmeasured(index, line);
          });
        }
        post({}, [this] { take_measured(); });
      });
  at->second.measuring = {posted, work};
}

Result<void> OpenSurvey::measure_behind(const OpenObservationPtr& observation, const JournalState& state,
                                        const std::vector<JournalLine>& lines, const RefusedPtr& refused,
                                        const EventsPtr& events, const ProductPtr& as_made, KeptMeasures& kept,
                                        std::uint64_t memory_bytes, const CancelToken& token, Work& work) {
  const auto take = [&](ObservationProduct product) {
    auto shared = std::make_shared<const ObservationProduct>(std::move(product));
    post(token, [this, index = observation->index(), shared] { take_product(index, shared); });
    return Result<void>{};
  };
  if (!observation->survey().raw_gone.empty()) {
    return take(state_product_of_results(observation->engine(), state, *read_.products[observation->index()]));
  }
  if (as_made && as_made->pings.size() == observation->files().pings.size()) {
    auto known = state_product_of_results(observation->engine(), state, *as_made);
    if (all_known(known, *as_made)) return take(std::move(known));
  }
  GivesWay give_way(document_.right_of_way());
  if (!kept.read) {
    for (const IndexCache& in : kept_in()) {
      if (!kept.measured.pings.empty()) break;
      kept.measured =
          kept_measured(measured_file(in, observation->survey(), observation->files()), key_of(*observation));
    }
    kept.read = true;
  }
  const std::vector<std::int64_t> to_read = pings_to_measure(observation->engine(), state, kept.measured);
  if (!to_read.empty()) {
    if (auto room = room_for(observation->files(), memory_bytes); !room) return room;
  }
  for (const std::int64_t ping_index : to_read) {
    give_way();
    if (token.cancelled()) return {};
    observation->estimate_background(ping_index);
  }
  const std::vector<JournalLine> effective = effective_lines(lines);
  auto product =
      state_product(observation->engine(), state,
                    {effective, document_.options().program_version, false, &kept.measured, *refused, *events}, work);
  if (!product) return pass_on(product);
  return take(std::move(*product));
}

/// Figures of choices before would pass for those of now.
void OpenSurvey::take_unmeasured(std::size_t index, const std::string& line) {
  AtWork& at = open_.at(index);
  at.product = nullptr;
  at.unmeasured = line;
  tell(line);
  tell(DocumentChange::measures);
}

std::string OpenSurvey::key_of(OpenObservation& observation) const {
  return key_of_find(observation.survey(), observation.files(), observation.engine().recipe(),
                     document_.options().program_version);
}

/// Where what was found and measured is kept: beside the journal, so that it goes where that goes; else in the user's cache,
/// where versions before kept it. Nowhere where there is no cache.
std::vector<IndexCache> OpenSurvey::kept_in() const {
  const IndexCache& cache = document_.options().cache;
  if (cache.folder.empty() || journal_folder_.empty()) return {cache};
  return {{journal_folder_ / "found"}, cache};
}

/// For the next time the survey is opened.
void OpenSurvey::keep_measures() {
  for (const auto& [index, at] : open_) {
    if (at.measuring) at.measuring->cancel();
  }
  measures_.wait();
  for (const auto& [index, at] : open_) {
    if (!at.kept->measured.changed) continue;
    const auto file = measured_file(kept_in().front(), at.open->survey(), at.open->files());
    keep_measured(file, key_of(*at.open), at.kept->measured);
  }
}

void OpenSurvey::take_measured() {
  const bool shown = measures_begun_ > 1;
  const bool all = ++measures_done_ == measures_begun_;
  if (all) measures_begun_ = measures_done_ = 0;
  if (shown || all) tell(DocumentChange::progress);
}

}  // namespace sonar
