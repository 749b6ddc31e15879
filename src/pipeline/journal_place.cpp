// SPDX-License-Identifier: Apache-2.0
#include "pipeline/journal_place.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ranges>
#include <system_error>
#include <utility>
#include <vector>

#include "io/atomic_file.h"
#include "pipeline/journals.h"

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

/// A journal that can be gone on with; an empty one has nothing that can be wrong with it.
Result<Journal> journal_at(const fs::path& path, const Journal& head) {
  std::error_code absent;
  if (fs::is_symlink(fs::symlink_status(path, absent))) {
    return fail(ErrorCode::io, "is a link: nothing is written through it", {path.string()});
  }
  if (fs::exists(path, absent) && fs::file_size(path, absent) == 0) return head;
  return read_journal(path.string());
}

/// The last journal of the last folder that can be read is gone on with: it was begun because those before it could not be,
/// or were another's. Where none can, the next is begun. Whatever else holds choices is read.
void take_journal(JournalPlace& place, std::int64_t first) {
  const Journal head = place.journal;
  const std::vector<OneJournal> journals = journals_in(place.folders);
  place.place = journals.empty() ? first : std::max(first, journals.back().place + 1);
  bool taken = false;
  for (const OneJournal& one : std::views::reverse(journals)) {
    auto journal = journal_at(one.path, head);
    if (!journal) {
      place.notices.push_back(to_line(journal.error()));
      continue;
    }
    for (const Diagnostic& note : journal->diagnostics) {
      place.notices.push_back(fmt::format("{}: {}", one.path.filename().string(), note.text));
    }
    if (taken || one.place < first) continue;
    taken = true;
    place.place = one.place;
    place.journal = std::move(*journal);
  }
  place.path = journal_name(place.folders.back(), place.place - first + 1);
  if (place.place > first) {
    place.notices.push_back(fmt::format("the journal goes on in {}", place.path.filename().string()));
  }
}

}  // namespace

void JournalPlace::read_lines() {
  std::vector<std::vector<JournalLine>> of_each;
  const auto add = [&](const std::vector<JournalLine>& its_lines, std::int64_t its_place) {
    auto& numbered = of_each.emplace_back();
    for (const JournalLine& line : its_lines) numbered.push_back(among_all(line, its_place));
  };
  std::vector<OneJournal> journals = journals_in(folders);
  std::erase_if(journals, [this](const OneJournal& one) { return one.place == place; });
  journals.push_back({path, place});
  std::ranges::sort(journals, {}, &OneJournal::place);
  for (const OneJournal& one : journals) {
    if (one.place == place) {
      add(journal.lines, place);
    } else if (const auto theirs = journal_at(one.path, {})) {
      add(theirs->lines, one.place);
    }
  }
  lines = joined(std::move(of_each));
}

bool JournalPlace::may_write() const {
  std::error_code absent;
  return !fs::exists(path, absent) || ::access(path.c_str(), W_OK) == 0 || errno != EACCES;
}

void JournalPlace::begin_next() {
  std::error_code absent;
  while (fs::exists(fs::symlink_status(path, absent))) {
    path = journal_name(folders.back(), ++place - first_place() + 1);
  }
  journal.lines.clear();
  journal.diagnostics.clear();
}

Result<JournalPlace> place_journal(std::span<const fs::path> folders, const Journal& head) {
  std::size_t chosen = 0;
  while (chosen < folders.size() && !can_write(folders[chosen])) ++chosen;
  if (chosen == folders.size()) {
    return fail(ErrorCode::io, "the journal can be kept nowhere: no folder can be written to",
                {folders.empty() ? std::string{} : folders.front().string()});
  }
  JournalPlace place;
  place.journal = head;
  place.folders.assign(folders.begin(), folders.begin() + static_cast<std::ptrdiff_t>(chosen) + 1);
  if (chosen > 0) {
    place.notices.push_back(fmt::format("{} cannot be written to; the journal is kept in {}", folders.front().string(),
                                        folders[chosen].string()));
  }
  take_journal(place, static_cast<std::int64_t>(chosen) * kMostJournals);
  place.read_lines();
  return place;
}

}  // namespace sonar
