// SPDX-License-Identifier: Apache-2.0
#include "session/open/survey_schools.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/units.h"
#include "pipeline/journal/continued.h"
#include "session/slices/slice_places.h"

namespace sonar {
namespace {

const SchoolRow* row_of(const ObservationProduct& product, std::int64_t number) {
  const auto found = std::lower_bound(product.schools.begin(), product.schools.end(), number,
                                      [](const SchoolRow& one, std::int64_t n) { return one.school_id < n; });
  return found == product.schools.end() || found->school_id != number ? nullptr : &*found;
}

SurveySchool made(const Document& document, std::size_t observation, std::shared_ptr<const StateSchool> state) {
  SurveySchool school;
  school.name = {observation, state->number};
  school.observation = document.open_observation(observation);
  school.product = document.product(observation);
  if (school.product) school.row = row_of(*school.product, state->number);
  school.state = std::move(state);
  return school;
}

/// By observation and number in it.
std::map<std::pair<std::size_t, std::int64_t>, std::int64_t> numbers_in_survey(const Document& document) {
  std::vector<std::size_t> indices;
  std::vector<ObservationProduct> light;
  for (const auto& [index, state] : document.choices().states) {
    const ProductPtr product = document.product(index);
    if (!product) continue;
    indices.push_back(index);
    ObservationProduct& one = light.emplace_back();
    one.observation = product->observation;
    one.source = product->source;
    one.schools = product->schools;
  }
  number_known(light, document.survey_numbers(), document.all_measured());
  std::map<std::pair<std::size_t, std::int64_t>, std::int64_t> numbers;
  for (std::size_t i = 0; i < light.size(); ++i) {
    for (const SchoolRow& row : light[i].schools) numbers[{indices[i], row.school_id}] = row.survey_school;
  }
  return numbers;
}

}  // namespace

Voxel middle_of(const PingMask& mask, int beams) {
  double fan = 0.0;
  double beam = 0.0;
  double sample = 0.0;
  double all = 0.0;
  std::size_t at = 0;
  for (const Run& run : mask.runs) {
    const int at_fan = run.row / beams;
    const int at_beam = run.row % beams;
    double weight = 0.0;
    for (int i = 0; i < run.count; ++i) {
      const double q = mask.confidence[at++];
      weight += q;
      sample += q * (run.first_sample + i);
    }
    fan += weight * at_fan;
    beam += weight * at_beam;
    all += weight;
  }
  if (!(all > 0.0)) return {};
  const auto nearest = [all](double sum) { return static_cast<int>(std::lround(sum / all)); };
  return {nearest(fan), nearest(beam), nearest(sample)};
}

std::string title_of(const Document& document, const SchoolName& school) {
  const auto& schools = document.state(school.observation).schools;
  const auto found =
      std::find_if(schools.begin(), schools.end(), [&](const auto& one) { return one->number == school.number; });
  return found == schools.end() ? fmt::format("school {}", school.number) : school_title(**found);
}

std::int64_t SurveySchool::middle_ping() const {
  const auto& there = state->masks.pings;
  return there.empty() ? 0 : there[there.size() / 2].ping_index;
}

double SurveySchool::snr_db() const {
  if (!product) return kUnknown;
  double signal = 0.0;
  double volume = 0.0;
  const auto& all = product->school_pings;
  auto ping = std::lower_bound(all.begin(), all.end(), name.number,
                               [](const SchoolPingRow& one, std::int64_t n) { return one.school_id < n; });
  for (; ping != all.end() && ping->school_id == name.number; ++ping) {
    if (std::isnan(ping->snr_db) || !(ping->volume_m3 > 0.0)) continue;
    signal += ping->volume_m3 * linear_from_db(ping->snr_db);
    volume += ping->volume_m3;
  }
  return volume > 0.0 ? db_from_linear(signal / volume) : kUnknown;
}

std::vector<SurveySchool> survey_schools(const Document& document) {
  std::vector<SurveySchool> schools;
  const auto numbers = numbers_in_survey(document);
  for (const auto& [index, state] : document.choices().states) {
    if (!state || !document.open_observation(index)) continue;
    for (const auto& school : state->schools) {
      SurveySchool& one = schools.emplace_back(made(document, index, school));
      const auto number = numbers.find({index, school->number});
      if (number != numbers.end()) one.survey_number = number->second;
    }
  }
  return schools;
}

std::int64_t school_count(const JournalState& state, const ProductPtr& product) {
  std::vector<const SchoolMasks*> masks;
  for (const auto& school : state.schools) masks.push_back(&school->masks);
  const std::vector<int> continues = continued(masks);
  ObservationProduct counted;
  counted.observation = product ? product->observation : std::string{};
  for (std::size_t i = 0; i < masks.size(); ++i) {
    SchoolRow row;
    row.observation = counted.observation;
    row.school_id = state.schools[i]->number;
    row.status = masks[i]->decided.status;
    if (continues[i] >= 0) {
      row.continues = school_name(row.observation, state.schools[static_cast<std::size_t>(continues[i])]->number);
    } else if (const SchoolRow* measured = product ? row_of(*product, row.school_id) : nullptr; measured != nullptr) {
      // Where a propagation had its reach, places tell what goes on.
      row.continues = measured->continues;
    }
    counted.schools.push_back(std::move(row));
  }
  return school_count(counted);
}

std::optional<SurveySchool> selected_school(const Workspace& workspace) {
  const auto& name = workspace.school();
  if (!name || !workspace.document.open_observation(name->observation)) return std::nullopt;
  for (const auto& school : workspace.document.state(name->observation).schools) {
    if (school->number == name->number) return made(workspace.document, name->observation, school);
  }
  return std::nullopt;
}

std::vector<SurveySchool> selected_schools(const Workspace& workspace) {
  const Document& document = workspace.document;
  std::vector<SurveySchool> schools;
  if (workspace.chosen_schools().empty()) {
    if (auto one = selected_school(workspace)) schools.push_back(std::move(*one));
    return schools;
  }
  for (const auto& [index, state] : document.choices().states) {
    if (!state || !document.open_observation(index)) continue;
    for (const auto& school : state->schools) {
      if (workspace.chosen_schools().contains({index, school->number}))
        schools.push_back(made(document, index, school));
    }
  }
  const auto selected = std::find_if(schools.begin(), schools.end(),
                                     [&](const SurveySchool& one) { return one.name == workspace.school(); });
  if (selected != schools.end()) std::rotate(schools.begin(), selected, selected + 1);
  return schools;
}

void decide_on(Workspace& workspace, const std::vector<SurveySchool>& schools, const Decision& decision) {
  DecideCommand command;
  for (const SurveySchool& school : schools) {
    command.decisions.push_back(decision);
    command.decisions.back().school = school.key();
  }
  workspace.document.act(schools.front().name.observation, schools.front().middle_ping(), std::move(command));
}

void go_to_ping(Workspace& workspace, std::size_t observation, std::int64_t ping_index) {
  const auto& shown = workspace.document.shown();
  if ((!shown || shown->index() != observation) && !workspace.document.show(observation)) return;
  workspace.document.look_at(ping_index);
}

void go_to_school(Workspace& workspace, const SurveySchool& school) {
  go_to_ping(workspace, school.name.observation, school.middle_ping());
  const auto* there = in_ping(school.state->masks, school.middle_ping());
  if (there != nullptr && !workspace.slices_locked()) {
    lay_slices_through(workspace, middle_of(there->mask, school.observation->sector().beams()));
  }
  workspace.school.set(school.name);
}

}  // namespace sonar
