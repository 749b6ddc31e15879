// SPDX-License-Identifier: Apache-2.0
#include "pipeline/journal_place.h"

#include <fmt/format.h>

#include <ranges>
#include <system_error>
#include <utility>
#include <vector>

#include "io/atomic_file.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

/// session.jsonl, session-2.jsonl, ...
fs::path journal_name(const fs::path& folder, int number) {
  return folder / (number == 1 ? "session.jsonl" : fmt::format("session-{}.jsonl", number));
}

/// A folder that is not there is made with the first choice, not before: looking at a survey leaves nothing behind. One that
/// is a link is not ours.
bool can_write(const fs::path& folder) {
  std::error_code error;
  fs::path there = fs::absolute(folder, error);
  while (!fs::exists(there, error) && there.has_parent_path() && there != there.parent_path())
    there = there.parent_path();
  return require_own_folder(folder) && AtomicFile::create(journal_name(there, 1)).has_value();
}

/// Numbers of the journals that lie in a folder, rising.
std::vector<int> journals_in(const fs::path& folder) {
  constexpr int kMost = 1000;
  std::vector<int> numbers;
  std::error_code absent;
  for (int number = 1; number <= kMost; ++number) {
    if (fs::exists(fs::symlink_status(journal_name(folder, number), absent))) numbers.push_back(number);
  }
  return numbers;
}

/// Copies journals along that lie in a folder before the chosen one, where that has none.
void bring_along(std::span<const fs::path> before, const fs::path& chosen) {
  for (const fs::path& folder : before) {
    if (!journals_in(chosen).empty()) return;
    for (const int number : journals_in(folder)) {
      if (const auto bytes = read_file(journal_name(folder, number))) {
        (void)write_file(journal_name(chosen, number), *bytes);
      }
    }
  }
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

/// The last journal of a folder that can be read is gone on with: it was begun because those before it could not be. Where
/// none can, the next is begun. Whatever else holds choices is named.
void take_journal(const fs::path& folder, JournalPlace& place) {
  const Journal head = place.journal;
  const std::vector<int> numbers = journals_in(folder);
  place.path = journal_name(folder, numbers.empty() ? 1 : numbers.back() + 1);
  bool taken = false;
  for (const int number : std::views::reverse(numbers)) {
    const fs::path path = journal_name(folder, number);
    auto journal = journal_at(path, head);
    if (!journal) {
      place.notices.push_back(to_line(journal.error()));
    } else if (taken) {
      if (journal->lines.empty()) continue;
      place.notices.push_back(
          fmt::format("{} holds {} choices that are not shown", path.string(), journal->lines.size()));
    } else {
      taken = true;
      place.path = path;
      for (const Diagnostic& note : journal->diagnostics) {
        place.notices.push_back(fmt::format("{}: {}", path.filename().string(), note.text));
      }
      place.journal = std::move(*journal);
    }
  }
  const std::string name = place.path.filename().string();
  if (name != journal_name(folder, 1).filename())
    place.notices.push_back(fmt::format("the journal goes on in {}", name));
}

}  // namespace

Result<JournalPlace> place_journal(std::span<const fs::path> folders, const Journal& head) {
  std::size_t chosen = 0;
  while (chosen < folders.size() && !can_write(folders[chosen])) ++chosen;
  if (chosen == folders.size()) {
    return fail(ErrorCode::io, "the journal can be kept nowhere: no folder can be written to",
                {folders.empty() ? std::string{} : folders.front().string()});
  }
  JournalPlace place;
  place.journal = head;
  if (chosen > 0) {
    bring_along(folders.first(chosen), folders[chosen]);
    place.notices.push_back(fmt::format("{} cannot be written to; the journal is kept in {}", folders.front().string(),
                                        folders[chosen].string()));
  }
  take_journal(folders[chosen], place);
  return place;
}

}  // namespace sonar
