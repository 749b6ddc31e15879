// SPDX-License-Identifier: Apache-2.0
#include "pipeline/journal_place.h"

#include <fmt/format.h>

#include <optional>
#include <system_error>
#include <utility>

#include "io/atomic_file.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

/// session.jsonl, session-2.jsonl, ...
fs::path journal_name(const fs::path& folder, int number) {
  return folder / (number == 1 ? "session.jsonl" : fmt::format("session-{}.jsonl", number));
}

/// A folder that is not there is made with the first choice, not before: looking at a survey leaves nothing behind.
bool can_write(const fs::path& folder) {
  std::error_code error;
  fs::path there = fs::absolute(folder, error);
  while (!fs::exists(there, error) && there.has_parent_path() && there != there.parent_path())
    there = there.parent_path();
  return AtomicFile::create(journal_name(there, 1)).has_value();
}

/// Copies a journal along that lies in a folder before the chosen one.
void bring_along(std::span<const fs::path> before, const fs::path& path) {
  std::error_code error;
  for (const fs::path& folder : before) {
    if (fs::exists(path, error)) return;
    if (const auto bytes = read_file(journal_name(folder, 1))) (void)write_file(path, *bytes);
  }
}

bool is_link(const fs::path& path) {
  std::error_code absent;
  return fs::is_symlink(fs::symlink_status(path, absent));
}

/// The first journal of a folder that can be gone on with, or begun: one that cannot be read stands in nobody's way, and
/// those after it are found again at the next start.
void take_journal(const fs::path& folder, JournalPlace& place) {
  for (int number = 1;; ++number) {
    place.path = journal_name(folder, number);
    const std::string name = place.path.filename().string();
    std::error_code absent;
    if (is_link(place.path)) {
      place.notices.push_back(fmt::format("{} is a link: nothing is written through it", place.path.string()));
      continue;
    }
    const bool begun = fs::exists(place.path, absent) && fs::file_size(place.path, absent) > 0;
    auto journal = begun ? read_journal(place.path.string()) : Result<Journal>(place.journal);
    if (!journal) {
      place.notices.push_back(to_line(journal.error()));
      continue;
    }
    if (number > 1) place.notices.push_back(fmt::format("the journal goes on in {}", name));
    for (const Diagnostic& note : journal->diagnostics) {
      place.notices.push_back(fmt::format("{}: {}", name, note.text));
    }
    place.journal = std::move(*journal);
    return;
  }
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
    bring_along(folders.first(chosen), journal_name(folders[chosen], 1));
    place.notices.push_back(fmt::format("{} cannot be written to; the journal is kept in {}", folders.front().string(),
                                        folders[chosen].string()));
  }
  take_journal(folders[chosen], place);
  return place;
}

}  // namespace sonar
