// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "pipeline/journal/journal.h"
#include "pipeline/journal/journals.h"

namespace sonar {

/// Where a session's journal is kept, and what it and the others of the survey already hold.
struct JournalPlace {
  std::filesystem::path path;
  std::int64_t place = 0;                      ///< among the survey's journals, see OneJournal
  std::vector<std::filesystem::path> folders;  ///< that the survey's journals lie in; ours in the last
  Journal journal;                             ///< ours; empty for a new one
  std::vector<JournalLine> lines;              ///< of all journals that can be read, see joined()
  std::vector<std::string> notices;            ///< what a user must be told: another folder, broken lines

  /// Takes in the others' journals as they are now; ours is what it is here. Of one that cannot be read now the lines stay
  /// that are known; then false.
  bool read_lines();
  /// Takes in ours as it is now; false where it is as it was.
  bool read_ours();
  /// Whether somebody may go on with ours: it has no line, or the last is theirs.
  [[nodiscard]] bool is_of(const std::string& operator_name) const;
  /// False where ours belongs to somebody who keeps others from writing it.
  [[nodiscard]] bool may_write() const;
  /// Another program writes our journal: it is one of the others from now on, and ours is the next one that is not there.
  /// errors  io: a folder has no room for one more
  Result<void> begin_next();

 private:
  [[nodiscard]] std::int64_t first_place() const { return (std::ssize(folders) - 1) * kMostJournals; }
};

/// Of these folders, in which a session may lie, those up to the first that can be written to, which holds ours.
[[nodiscard]] std::span<const std::filesystem::path> session_folders(std::span<const std::filesystem::path> folders);

/// Takes the first folder that can be written to; one that is not there is made. The last journal in it that its person wrote
/// last is gone on with, else one is begun; the others there and in the folders before it are read, as far as they can be.
/// head    of a journal that is begun
/// errors  io: no folder can be written to
[[nodiscard]] Result<JournalPlace> place_journal(std::span<const std::filesystem::path> folders, const Journal& head,
                                                 const std::string& operator_name = {});

}  // namespace sonar
