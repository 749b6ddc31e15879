// SPDX-License-Identifier: Apache-2.0
#include "session/review/review.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sonar {
namespace {

constexpr const char* kWaits = "measuring; the strongest school is shown when all are measured";

bool unreviewed_first(const SurveySchool& a, const SurveySchool& b) {
  const bool a_waits = a.decided().status == "unreviewed";
  const bool b_waits = b.decided().status == "unreviewed";
  if (a_waits != b_waits) return a_waits;
  // Not measured yet = last.
  const double a_m2 = std::isnan(a.backscatter_m2()) ? -1.0 : a.backscatter_m2();
  const double b_m2 = std::isnan(b.backscatter_m2()) ? -1.0 : b.backscatter_m2();
  return a_m2 > b_m2;
}

}  // namespace

Review::Review(Workspace& workspace, const Preferences& preferences)
    : SchoolTable(workspace), preferences_(preferences) {
  measured_listening_.to(workspace.document.changes(), [this](DocumentChange change) {
    if (change == DocumentChange::survey) goes_on_ = false;
    if (change == DocumentChange::state) follow_act();
    if (change != DocumentChange::progress || !goes_on_ || this->workspace().document.measuring()) return;
    wait_no_longer();
    next();
  });
}

void Review::school_selected() {
  wait_no_longer();  // it is the one, or a human has gone elsewhere
  SchoolTable::school_selected();
}

void Review::wait_no_longer() {
  if (!goes_on_) return;
  goes_on_ = false;
  Document& document = workspace().document;
  if (document.notices().back() == kWaits) document.tell("no longer waiting for the strongest school");
}

bool Review::waits_for_figures() const {
  return workspace().document.measuring() &&
         std::any_of(schools().begin(), schools().end(),
                     [&](const SurveySchool& school) { return school.row == nullptr && waits(school); });
}

void Review::make() {
  SchoolTable::make();
  std::stable_sort(schools().begin(), schools().end(), unreviewed_first);
  if (!workspace().document.choices().failure.empty()) {
    decided_.clear();
    go_back();
  }
  std::erase_if(decided_, [&](const auto& name) {
    return std::none_of(schools().begin(), schools().end(), [&](const SurveySchool& school) {
      return school.name == SchoolName{name.first, name.second} && school.decided().status == "unreviewed";
    });
  });
}

bool Review::waits(const SurveySchool& school) const {
  return school.decided().status == "unreviewed" && !decided_.contains({school.name.observation, school.name.number});
}

std::size_t Review::unreviewed() const {
  return static_cast<std::size_t>(
      std::count_if(schools().begin(), schools().end(), [&](const SurveySchool& one) { return waits(one); }));
}

void Review::next() {
  Document& document = workspace().document;
  if (document.survey() == nullptr) return document.tell("no survey is open");
  const auto& observations = document.survey()->observations;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    if (!observations[i].grid || document.open_observation(i)) continue;
    document.open_all();
    break;
  }
  goes_on_ = waits_for_figures();
  if (goes_on_) return document.tell(kWaits);
  const auto at = selected();
  const std::size_t count = schools().size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t row = (at ? *at + 1 + i : i) % count;
    if ((at && row == *at) || !waits(schools()[row]) || !row_matches(*this, row, filter_)) continue;
    return select(row);
  }
  const bool here = at && waits(schools()[*at]);
  if (!document.progress().stage.empty() && unreviewed() == 0) {
    return document.tell(fmt::format("wait: {}", document.progress().stage));
  }
  if (schools().empty())
    return document.tell("no schools yet: press [schools.detect_all] to detect them, or click to select one");
  if (!here && unreviewed() > 0) return document.tell("no unreviewed school passes the filter");
  document.tell(here ? "this is the last school that is not reviewed" : "every school is reviewed");
}

void Review::decide(std::string status) {
  const std::vector<SurveySchool> schools = selected_schools(workspace());
  if (schools.empty()) return workspace().document.tell("no school is selected");
  Decision decision;
  decision.status = std::move(status);
  decide_on(workspace(), schools, decision);
  for (const SurveySchool& school : schools) {
    const std::pair name{school.name.observation, school.name.number};
    decision.status == "unreviewed" ? void(decided_.erase(name)) : void(decided_.insert(name));
  }
  if (!preferences_.advance || unreviewed() == 0) return;
  left_ = schools.front().name;
  next();
}

void Review::go_to(const SchoolName& school) {
  const auto row =
      std::find_if(schools().begin(), schools().end(), [&](const SurveySchool& one) { return one.name == school; });
  if (row != schools().end()) select(static_cast<std::size_t>(row - schools().begin()));
}

/// What could not be written down was not decided: it is shown again, instead of looking done.
void Review::go_back() {
  if (!left_) return;
  workspace().queue.post([this, left = *std::exchange(left_, std::nullopt), alive = std::weak_ptr<bool>(alive_)] {
    if (!alive.expired()) go_to(left);
  });
}

std::string Review::species(int digit) const {
  const auto at = static_cast<std::size_t>(digit - 1);
  return digit >= 1 && at < preferences_.species.size() ? preferences_.species[at] : std::string{};
}

void Review::set_species(int digit) {
  const std::vector<SurveySchool> schools = selected_schools(workspace());
  if (schools.empty()) return workspace().document.tell("no school is selected");
  if (digit != 0 && species(digit).empty()) {
    return workspace().document.tell(
        fmt::format("there is no species on {}: see Review > Species of the digits", digit));
  }
  Decision decision;
  decision.species = species(digit);
  decide_on(workspace(), schools, decision);
}

Result<void> Review::decide_all(std::string_view text) {
  const auto rule = bulk_rule(text, workspace().units().length());
  if (!rule) return pass_on(rule);
  DecideCommand command;
  command.rule = rule->text;
  const SurveySchool* first = nullptr;
  for (const SurveySchool& school : schools()) {
    if (school.decided().status != "unreviewed" || !meets(*rule, school)) continue;
    if (first == nullptr) first = &school;
    Decision decision;
    decision.school = school.key();
    decision.status = rule->status;
    command.decisions.push_back(std::move(decision));
  }
  if (first == nullptr) return fail(ErrorCode::usage, "no unreviewed school meets \"" + rule->text + "\"");
  workspace().document.act(first->name.observation, first->middle_ping(), std::move(command));
  return {};
}

}  // namespace sonar
