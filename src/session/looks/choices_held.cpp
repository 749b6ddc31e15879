// SPDX-License-Identifier: Apache-2.0
// Several people at work on one survey: a journal each, an observation held by one.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <system_error>
#include <utility>

#include "pipeline/journal/manual.h"
#include "session/looks/choices.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

/// Of an observation: its names move on when files are added, its first ping stays.
std::string lock_name(const SurveyFiles& survey, const ObservationFiles& observation) {
  std::string name = iso_time(survey.ping_time(observation, 0)) + "-" + observation.config.sounder_name;
  std::erase_if(name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-'; });
  return name + ".lock";
}

/// Numbers of the lines that were decided on an observation.
std::vector<std::int64_t> lines_on(const std::vector<JournalLine>& lines, const SurveyFiles& survey,
                                   const ObservationFiles& observation) {
  std::vector<std::int64_t> numbers;
  for (const JournalLine& line : effective_lines(lines)) {
    if (ping_at(survey, observation, line.ping_time)) numbers.push_back(line.n);
  }
  return numbers;
}

}  // namespace

void Choices::look_at(std::size_t observation) {
  thread_.post([this, observation](const CancelToken&) {
    looked_at_ = observation;
    let_go_but_looked_at();
    if (!read_all()) return;
    ++waiting_;
    rebuild();
    tell_unsearched();
    publish({}, 0);
  });
}

/// Others may have looked for schools where nobody did here.
void Choices::tell_unsearched() {
  const std::vector<JournalLine> lines = effective_lines(place_.lines);
  for (const auto& [index, of] : open_) {
    if (of.searched || !asks_for_detection(lines, of.observation->context().times)) continue;
    if (!unsearched_told_.insert(index).second) continue;
    notices_.push_back(fmt::format("others have detected schools in {}: detect them there to see theirs",
                                   of.observation->files().name));
  }
}

void Choices::let_go_but_looked_at() {
  std::erase_if(held_, [this](const auto& held) { return held.first != looked_at_; });
}

/// Takes in what the journals have said since; false where that is nothing.
bool Choices::read_all() {
  std::map<fs::path, std::pair<std::uintmax_t, fs::file_time_type>> now;
  for (const OneJournal& one : journals_in(place_.folders)) {
    std::error_code gone;
    if (one.place == place_.place && lock_.held()) continue;
    now[one.path] = {fs::file_size(one.path, gone), fs::last_write_time(one.path, gone)};
  }
  if (now == read_) return false;
  read_ = std::move(now);
  if (!lock_.held() && place_.read_ours()) history_ = own_history(place_);
  const std::vector<JournalLine> before = place_.lines;
  if (!place_.read_lines()) read_.reset();
  return !std::equal(before.begin(), before.end(), place_.lines.begin(), place_.lines.end(),
                     [](const JournalLine& a, const JournalLine& b) { return a.n == b.n && a.decided == b.decided; });
}

/// Ours, or the next one that can be.
Result<void> Choices::hold_journal() {
  if (place_.path.empty()) return fail(ErrorCode::io, "the journal can be kept nowhere: choices would be lost");
  while (!lock_.held()) {
    if (place_.may_write()) {
      auto taken = lock_.take(journal_lock(place_.path), options_.operator_name, now());
      if (!taken) return pass_on(taken);
      if (!taken->notice.empty()) notices_.push_back(taken->notice);
      if (taken->held_by.empty()) {
        // Others may have written it since it was read, and let it go.
        if (place_.read_ours()) history_ = own_history(place_);
        read_.reset();
        if (place_.is_of(options_.operator_name)) return {};
        lock_.let_go();
      } else {
        notices_.push_back(fmt::format("{} is at work on this survey too", taken->held_by));
      }
    }
    if (auto next = place_.begin_next(); !next) return next;
    history_ = own_history(place_);
    notices_.push_back(fmt::format("your choices go into {}", place_.path.filename().string()));
  }
  return {};
}

/// For a choice in it. Where others have chosen there since, that is shown first.
Result<void> Choices::hold(const SurveyFiles& survey, std::size_t index) {
  if (held_.contains(index)) return {};
  const ObservationFiles& observation = survey.observations[index];
  const auto before = lines_on(place_.lines, survey, observation);
  if (auto held = hold_journal(); !held) return held;
  const std::string file = lock_name(survey, observation);
  std::string held_by;
  for (const fs::path& folder : place_.folders) {  // in those that we may only read others are at work
    if (folder != place_.folders.back() && held_by.empty()) held_by = NamedLock::holder(folder / kLocks / file);
  }
  if (held_by.empty()) {
    auto taken = held_[index].take(place_.path.parent_path() / kLocks / file, options_.operator_name, now());
    if (!taken || !taken->held_by.empty()) held_.erase(index);
    if (!taken) return pass_on(taken);
    held_by = taken->held_by;
    if (!taken->notice.empty()) notices_.push_back(taken->notice);
  }
  if (!held_by.empty()) {
    others_hold_ = true;
    return fail(ErrorCode::io, fmt::format("{} is at work on {}: nothing is changed there until that is over", held_by,
                                           observation.name));
  }
  if (!read_all()) return {};
  rebuild();
  tell_unsearched();
  if (lines_on(place_.lines, survey, observation) == before) return {};
  others_hold_ = true;
  return fail(ErrorCode::io,
              fmt::format("others have chosen in {} since: that is shown now, choose again", observation.name));
}

/// What is undone or redone may lie in several observations, also in such as are not open.
Result<void> Choices::hold_turned(const std::vector<std::int64_t>& targets) {
  if (open_.empty()) return {};
  const SurveyFiles& survey = open_.begin()->second.observation->survey();
  for (const JournalLine& line : std::vector<JournalLine>(place_.lines)) {  // holding may bring others
    if (std::find(targets.begin(), targets.end(), line.n) == targets.end()) continue;
    for (std::size_t index = 0; index < survey.observations.size(); ++index) {
      if (!ping_at(survey, survey.observations[index], line.ping_time)) continue;
      if (auto held = hold(survey, index); !held) return held;
      break;
    }
  }
  return {};
}

}  // namespace sonar
