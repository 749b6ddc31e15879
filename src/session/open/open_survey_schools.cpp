// SPDX-License-Identifier: Apache-2.0
// Schools and refused echoes that are found, for choices to be laid upon.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "base/number_text.h"
#include "pipeline/stages/detected_cache.h"
#include "pipeline/stages/observe.h"
#include "pipeline/stages/refused_echoes.h"
#include "pipeline/tasks/work_folders.h"
#include "session/open/document.h"

namespace sonar {

std::string key_of_find(const SurveyFiles& survey, const ObservationFiles& observation, Recipe recipe,
                        const std::string& program_version) {
  recipe.automatic = true;
  return observation_key(survey, observation, recipe, {{}, {}, program_version});
}

void OpenSurvey::detect(std::vector<std::size_t> observations, bool as_made) {
  if (!read_.files) return;
  const auto step = observations.size() > 1 ? std::make_shared<JournalStep>() : nullptr;
  document_.run([this, survey = read_.files, observations = std::move(observations), as_made, step](
                    Work& work, const CancelToken& token) {
    for (const std::size_t index : observations) {
      if (work.cancelled() || token.cancelled() || index >= survey->observations.size()) break;
      detect_one(survey, index, as_made, step, work, token);
    }
    if (as_made) post(token, [this, observations] { tell_as_made(observations); });
    if (!work.cancelled()) return;
    post({}, [this, survey, observations] {
      if (survey == read_.files) tell_lacking(observations);
    });
  });
}

bool OpenSurvey::asks_for_schools(std::size_t observation) const {
  return choices_.lines && observation < read_.files->observations.size() &&
         asks_for_detection(effective_lines(*choices_.lines),
                            datagram_times(*read_.files, read_.files->observations[observation]));
}

bool OpenSurvey::lacks_detected(std::size_t observation) const {
  return !choices_.searched.contains(observation) && asks_for_schools(observation);
}

void OpenSurvey::tell_lacking(const std::vector<std::size_t>& observations) {
  const auto lacking = std::count_if(observations.begin(), observations.end(),
                                     [this](std::size_t index) { return !detected(index) && lacks_detected(index); });
  if (lacking == 0) return;
  tell(
      fmt::format("stopped: the schools that were found before in {} are not shown; detect schools "
                  "again to have them back (nothing is lost)",
                  count_of(static_cast<std::size_t>(lacking), "observation")));
}

void OpenSurvey::tell_as_made(const std::vector<std::size_t>& observations) {
  std::set<std::string> versions;
  std::size_t count = 0;
  for (const std::size_t index : observations) {
    const ProductPtr made = as_made(index);
    if (!made) continue;
    ++count;
    versions.insert(made->program_version);
  }
  if (count == 0) return;
  const std::string shown = fmt::format("{}: the schools of {} are shown as ", read_.work_folders.front().string(),
                                        count_of(count, "observation"));
  if (versions == std::set{document_.options().program_version}) {
    return tell(shown + "the run left them; [schools.detect_all] detects them anew");
  }
  tell(fmt::format("{}version {} made them; [schools.detect_all] detects them by this version", shown,
                   fmt::join(versions, ", ")));
}

void OpenSurvey::detect_one(const std::shared_ptr<const SurveyFiles>& survey, std::size_t index, bool as_made,
                            const std::shared_ptr<JournalStep>& step, Work& work, const CancelToken& token) {
  const ObservationFiles& observation = survey->observations[index];
  if (!observation.grid) return;
  if (!survey->raw_gone.empty()) {
    const ObservationProduct& product = *read_.products[index];
    return post(token, [this, survey, index, step, found = found_in(product, decided_schools(product))] {
      if (survey == read_.files) take_detected(index, found, step);
    });
  }
  const DocumentOptions& options = document_.options();
  if (const auto room = room_for(observation, options.memory_bytes); !room) {
    return post(token, [this, line = to_line(room.error())] { tell(line); });
  }
  Recipe recipe = read_.recipe;
  recipe.automatic = true;
  const ObserveOptions observe_options{{}, {}, options.program_version};
  std::vector<std::filesystem::path> files;
  for (const IndexCache& in : kept_in()) files.push_back(detected_file(in, *survey, observation));
  const std::string key = key_of_find(*survey, observation, recipe, options.program_version);
  // Read once, and first: this is what every opening but the first waits for.
  std::optional<ObservationProduct> kept;
  const auto of_now = std::ranges::find_if(files, [&](const auto& file) {
    kept = kept_detected(file, key);
    return kept.has_value();
  });
  std::shared_ptr<const EarlierSchools> earlier;
  for (auto file = files.begin(); file != files.end() && !earlier; ++file) {
    earlier = earlier_found(*file, *survey, observation, file == of_now);
  }
  const auto take = [&](const ObservationProduct& product) {
    post(token, [this, survey, index, step, found = found_in(product, detected_schools(product), earlier)] {
      if (survey == read_.files) take_detected(index, found, step);
    });
  };
  if (kept) return take(*kept);
  if (const auto of_run = kept_detected(product_in(read_.work_folders, observation.name, key), key)) {
    take(*of_run);
    return keep_detected(files.front(), *of_run);
  }
  if (const auto other = read_.others.find(index); as_made && other != read_.others.end()) {
    // It is this version's find under no key: what is kept of it is for choices upon it alone.
    hold_earlier(files.front(), other->second.file);
    auto found = found_in(*other->second.product, detected_schools(*other->second.product), earlier);
    found.as_made = other->second.product;
    return post(token, [this, survey, index, step, found = std::move(found)] {
      if (survey == read_.files) take_detected(index, found, step);
    });
  }
  auto product = observe(*survey, observation, recipe, observe_options, work);
  if (!product) {
    if (product.error().code == ErrorCode::cancelled) return;
    return post(token, [this, line = to_line(product.error())] { tell(line); });
  }
  take(*product);
  keep_detected(files.front(), *product);
}

OpenSurvey::Found OpenSurvey::found_in(const ObservationProduct& product, std::vector<SchoolMasks> schools,
                                       std::shared_ptr<const EarlierSchools> earlier) {
  auto events = std::make_shared<const std::vector<PlacedEvent>>(placed_events(noted_events(product), schools));
  return {std::move(schools), product.rejected, std::move(earlier), std::move(events), nullptr};
}

void OpenSurvey::take_detected(std::size_t index, Found found, const std::shared_ptr<JournalStep>& step) {
  const auto number = static_cast<std::int64_t>(found.schools.size());
  AtWork& at = opened(index);
  unreplayed_.erase(index);
  choices_thread_->open(at.chosen_on, std::move(found.schools), std::move(found.earlier));
  at.found_refused = std::move(found.refused);
  at.found_events = std::move(found.events);
  at.as_made = std::move(found.as_made);
  if (!asks_for_detection(effective_lines(*choices_.lines), at.open->context().times)) {
    act(index, 0, DetectCommand{number}, step);
  }
}

void OpenSurvey::take_schools(std::size_t observation, const ObservationProduct& found) {
  if (!read_.files || observation >= read_.files->observations.size()) return;
  take_detected(observation, found_in(found, detected_schools(found)), nullptr);
}

bool OpenSurvey::detected(std::size_t observation) const {
  const auto found = open_.find(observation);
  return found != open_.end() && found->second.found_refused.has_value();
}

RefusedPtr OpenSurvey::refused(std::size_t observation) const {
  static const auto kNone = std::make_shared<const std::vector<RefusedEcho>>();
  const auto found = open_.find(observation);
  return found == open_.end() || !found->second.refused ? kNone : found->second.refused;
}

EventsPtr OpenSurvey::found_events(std::size_t observation) const {
  static const auto kNone = std::make_shared<const std::vector<PlacedEvent>>();
  const auto found = open_.find(observation);
  return found == open_.end() || !found->second.found_events ? kNone : found->second.found_events;
}

/// Those that are no school by what humans have chosen since.
void OpenSurvey::follow_refused(const ChoicesShown& before) {
  if (std::ranges::none_of(open_, [](const auto& one) { return one.second.found_refused.has_value(); })) return;
  const std::vector<JournalLine> lines = effective_lines(*choices_.lines);
  for (auto& [index, at] : open_) {
    const auto state = choices_.states.find(index);
    const auto old = before.states.find(index);
    if (!at.found_refused || state == choices_.states.end() || !state->second) continue;
    if (old != before.states.end() && old->second == state->second) continue;
    const CommandContext& context = at.chosen_on->context();
    const bool asked = asks_for_detection(lines, context.times);
    at.refused = std::make_shared<const std::vector<RefusedEcho>>(
        still_refused(asked ? *at.found_refused : std::vector<RefusedEcho>{}, *state->second, *context.grid));
  }
}

}  // namespace sonar
