// SPDX-License-Identifier: Apache-2.0
#include "session/journal_place.h"

#include <fmt/format.h>

#include <fstream>
#include <optional>
#include <system_error>
#include <utility>

namespace sonar {
namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "session.jsonl";

/// A folder that is not there is made with the first choice, not before: looking at a survey leaves nothing behind.
bool can_write(const fs::path& folder) {
  std::error_code error;
  fs::path there = fs::absolute(folder, error);
  while (!fs::exists(there, error) && there.has_parent_path() && there != there.parent_path())
    there = there.parent_path();
  const fs::path probe = there / ".session-probe";
  const bool written = std::ofstream(probe, std::ios::trunc).put('x').flush().good();
  fs::remove(probe, error);
  return written;
}

/// A folder's journal name that is free: session-2.jsonl, ...
fs::path free_name(const fs::path& folder) {
  std::error_code error;
  for (int i = 2;; ++i) {
    fs::path path = folder / fmt::format("session-{}.jsonl", i);
    if (!fs::exists(path, error)) return path;
  }
}

/// Copies a journal along that lies in a folder before the chosen one.
void bring_along(std::span<const fs::path> before, const fs::path& path) {
  std::error_code error;
  for (const fs::path& folder : before) {
    if (fs::exists(path, error) || !fs::exists(folder / kName, error)) continue;
    fs::create_directories(path.parent_path(), error);
    fs::copy_file(folder / kName, path, error);
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
  place.path = folders[chosen] / kName;
  place.journal = head;
  if (chosen > 0) {
    bring_along(folders.first(chosen), place.path);
    place.notices.push_back(fmt::format("{} cannot be written to; the journal is kept in {}", folders.front().string(),
                                        folders[chosen].string()));
  }
  std::error_code error;
  if (!fs::exists(place.path, error) || fs::file_size(place.path, error) == 0) return place;
  auto journal = read_journal(place.path.string());
  if (!journal) {
    place.notices.push_back(to_line(journal.error()));
    place.path = free_name(folders[chosen]);
    place.notices.push_back(fmt::format("the journal goes on in {}", place.path.filename().string()));
    return place;
  }
  for (const Diagnostic& note : journal->diagnostics) {
    place.notices.push_back(fmt::format("{}: {}", place.path.filename().string(), note.text));
  }
  place.journal = std::move(*journal);
  return place;
}

}  // namespace sonar
