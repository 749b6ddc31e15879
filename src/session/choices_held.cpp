// SPDX-License-Identifier: Apache-2.0
// Several people at work on one survey: a journal each, an observation held by one.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <system_error>
#include <utility>

#include "session/choices.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

fs::path locks_beside(const fs::path& journal) { return journal.parent_path() / "locks"; }

/// Of an observation: its names move on when files are added, its first ping stays.
std::string lock_name(const OpenObservation& observation) {
  std::string name = iso_time(observation.ground().times.front()) + "-" + observation.files().config.sounder_name;
  std::erase_if(name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-'; });
  return name + ".lock";
}

/// Numbers of the lines that were decided on an observation.
std::vector<std::int64_t> lines_on(const std::vector<JournalLine>& lines, const CommandGround& ground) {
  std::vector<std::int64_t> numbers;
  for (const JournalLine& line : effective_lines(lines)) {
    if (ping_at(ground, line.ping_time)) numbers.push_back(line.n);
  }
  return numbers;
}

}  // namespace

void Choices::look_at(std::size_t observation) {
  thread_.post([this, observation](const Wanted&) {
    looked_at_ = observation;
    let_go_but_looked_at();
    if (!read_others()) return;
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
    if (of.searched || !asks_for_detection(lines, of.observation->ground().times)) continue;
    notices_.push_back(fmt::format("others have looked for schools in {}: look for them there to see theirs",
                                   of.observation->files().name));
  }
}

void Choices::let_go_but_looked_at() {
  std::erase_if(held_, [this](const auto& held) { return held.first != looked_at_; });
}

/// Takes in what other journals have said since; false where that is nothing.
bool Choices::read_others() {
  std::map<fs::path, std::pair<std::uintmax_t, fs::file_time_type>> now;
  for (const OneJournal& one : journals_in(place_.folders)) {
    std::error_code gone;
    if (one.place == place_.place) continue;
    now[one.path] = {fs::file_size(one.path, gone), fs::last_write_time(one.path, gone)};
  }
  if (now == read_) return false;
  read_ = std::move(now);
  const std::vector<JournalLine> before = std::exchange(place_.lines, {});
  place_.read_lines();
  return !std::equal(before.begin(), before.end(), place_.lines.begin(), place_.lines.end(),
                     [](const JournalLine& a, const JournalLine& b) { return a.n == b.n && a.decided == b.decided; });
}

/// Ours, or the next one that can be.
Result<void> Choices::hold_journal() {
  if (place_.path.empty()) return fail(ErrorCode::io, "the journal can be kept nowhere: choices would be lost");
  while (!lock_.held()) {
    if (place_.may_write()) {
      const fs::path file = locks_beside(place_.path) / (place_.path.filename().string() + ".lock");
      auto taken = lock_.take(file, options_.operator_name, now());
      if (!taken) return pass_on(taken);
      if (taken->held_by.empty()) {
        if (!taken->notice.empty()) notices_.push_back(taken->notice);
        break;
      }
      notices_.push_back(fmt::format("{} is at work on this survey too", taken->held_by));
    }
    place_.begin_next();
    history_ = own_history(place_);
    read_.clear();
    notices_.push_back(fmt::format("your choices go into {}", place_.path.filename().string()));
  }
  // Whoever wrote it before let it go since it was read.
  std::error_code unknown;
  const bool begun = fs::file_size(place_.path, unknown) > 0 && !unknown;
  if (!begun) return {};
  auto now = read_journal(place_.path.string());
  if (!now || now->lines.size() <= place_.journal.lines.size()) return {};
  place_.journal = std::move(*now);
  history_ = own_history(place_);
  read_.clear();  // what was ours is among the lines in another order, perhaps
  return {};
}

/// For a choice in it. Where others have chosen there since, that is shown first.
Result<void> Choices::hold(std::size_t observation) {
  if (held_.contains(observation)) return {};
  const OpenObservation& open = *open_.at(observation).observation;
  if (auto held = hold_journal(); !held) return held;
  auto taken = held_[observation].take(locks_beside(place_.path) / lock_name(open), options_.operator_name, now());
  if (!taken || !taken->held_by.empty()) held_.erase(observation);
  if (!taken) return pass_on(taken);
  const std::string& name = open.files().name;
  if (!taken->held_by.empty()) {
    return fail(ErrorCode::io,
                fmt::format("{} is at work on {}: nothing is changed there until that is over", taken->held_by, name));
  }
  if (!taken->notice.empty()) notices_.push_back(taken->notice);
  const auto before = lines_on(place_.lines, open.ground());
  if (!read_others()) return {};
  rebuild();
  tell_unsearched();
  if (lines_on(place_.lines, open.ground()) == before) return {};
  return fail(ErrorCode::io, fmt::format("others have chosen in {} since: that is shown now, choose again", name));
}

/// What is undone or redone may lie in several observations.
Result<void> Choices::hold_turned(const std::vector<std::int64_t>& targets) {
  for (const JournalLine& line : place_.lines) {
    if (std::find(targets.begin(), targets.end(), line.n) == targets.end()) continue;
    for (const auto& [index, of] : open_) {
      if (!ping_at(of.observation->ground(), line.ping_time)) continue;
      if (auto held = hold(index); !held) return held;
      break;
    }
  }
  return {};
}

}  // namespace sonar
