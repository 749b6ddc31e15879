// SPDX-License-Identifier: Apache-2.0
#include "pipeline/journal/journal_place.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <ranges>
#include <system_error>
#include <utility>
#include <vector>

#include "io/atomic_file.h"
#include "pipeline/journal/journals.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

/// A folder that is not there is made with the first choice, not before: looking at a survey leaves nothing behind. One that
/// is a link is not ours.
bool can_write(const fs::path& folder) {
  std::error_code error;
  fs::path there = fs::absolute(folder, error);
  while (!fs::exists(there, error) && there.has_parent_path() && there != there.parent_path())
    there = there.parent_path();
  return require_own_folder(folder) && AtomicFile::create(journal_name(there, 1)).has_value();
}

std::size_t first_writable(std::span<const fs::path> folders) {
  std::size_t chosen = 0;
  while (chosen < folders.size() && !can_write(folders[chosen])) ++chosen;
  return chosen;
}

bool written_by(const Journal& journal, const std::string& operator_name) {
  return journal.lines.empty() || journal.lines.back().operator_name == operator_name;
}

void take_journal(JournalPlace& place, std::int64_t first, const std::string& operator_name) {
  const std::vector<OneJournal> journals = journals_in(place.folders);
  place.place = journals.empty() ? first : std::max(first, journals.back().place + 1);
  bool taken = false;
  for (const OneJournal& one : std::views::reverse(journals)) {
    auto journal = read_one(one.path);
    if (!journal) {
      place.notices.push_back(to_line(journal.error()));
      continue;
    }
    for (const Diagnostic& note : journal->diagnostics) {
      place.notices.push_back(fmt::format("{}: {}", one.path.filename().string(), note.text));
    }
    if (taken || one.place < first || !written_by(*journal, operator_name)) continue;
    taken = true;
    place.place = one.place;
    if (!journal->recipe.empty() || !journal->lines.empty()) place.journal = std::move(*journal);
  }
  place.path = journal_name(place.folders.back(), place.place - first + 1);
  if (place.place > first) {
    place.notices.push_back(fmt::format("the journal goes on in {}", place.path.filename().string()));
  }
}

}  // namespace

bool JournalPlace::read_lines() {
  std::vector<std::vector<JournalLine>> of_each;
  bool all = true;
  std::vector<OneJournal> journals = journals_in(folders);
  std::erase_if(journals, [this](const OneJournal& one) { return one.place == place; });
  journals.push_back({path, place});
  std::ranges::sort(journals, {}, &OneJournal::place);
  for (const OneJournal& one : journals) {
    auto& its_lines = of_each.emplace_back();
    const auto add = [&](const Journal& its) {
      for (const JournalLine& line : its.lines) its_lines.push_back(among_all(line, one.place));
    };
    if (one.place == place) {
      add(journal);
    } else if (const auto theirs = read_one(one.path)) {
      add(*theirs);
    } else {
      all = false;
      std::ranges::copy_if(lines, std::back_inserter(its_lines),
                           [&](const JournalLine& line) { return place_of(line.n) == one.place; });
    }
  }
  lines = joined(std::move(of_each));
  return all;
}

bool JournalPlace::read_ours() {
  std::error_code absent;
  if (!fs::exists(path, absent)) return false;
  auto now = read_one(path);
  if (!now || now->lines.size() == journal.lines.size()) return false;
  journal = std::move(*now);
  return true;
}

bool JournalPlace::is_of(const std::string& operator_name) const { return written_by(journal, operator_name); }

bool JournalPlace::may_write() const {
  std::error_code absent;
  return !fs::exists(path, absent) || ::access(path.c_str(), W_OK) == 0 || errno != EACCES;
}

Result<void> JournalPlace::begin_next() {
  std::error_code absent;
  do {
    if (++place - first_place() >= kMostJournals) {
      return fail(ErrorCode::io, fmt::format("holds {} journals, and no more are read", kMostJournals),
                  {folders.back().string()});
    }
    path = journal_name(folders.back(), place - first_place() + 1);
  } while (fs::exists(fs::symlink_status(path, absent)));
  journal.lines.clear();
  journal.diagnostics.clear();
  return {};
}

std::span<const fs::path> session_folders(std::span<const fs::path> folders) {
  return folders.first(std::min(first_writable(folders) + 1, folders.size()));
}

Result<JournalPlace> place_journal(std::span<const fs::path> folders, const Journal& head,
                                   const std::string& operator_name) {
  const std::size_t chosen = first_writable(folders);
  if (chosen == folders.size()) {
    return fail(ErrorCode::io, "the journal can be kept nowhere: no folder can be written to",
                {folders.empty() ? std::string{} : folders.front().string()});
  }
  JournalPlace place;
  place.journal = head;
  place.folders.assign(folders.begin(), folders.begin() + static_cast<std::ptrdiff_t>(chosen) + 1);
  if (chosen > 0) {
    place.notices.push_back(
        fmt::format("{} cannot be written to; the journal is kept in {}, where others do not see it",
                    folders.front().string(), folders[chosen].string()));
  }
  take_journal(place, static_cast<std::int64_t>(chosen) * kMostJournals, operator_name);
  (void)place.read_lines();
  return place;
}

}  // namespace sonar
