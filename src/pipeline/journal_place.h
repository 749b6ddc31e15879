// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "pipeline/journal.h"
#include "pipeline/journals.h"

namespace sonar {

/// Where a session's journal is kept, and what it and the others of the survey already hold.
struct JournalPlace {
  std::filesystem::path path;
  std::int64_t place = 0;                      ///< among the survey's journals, see OneJournal
  std::vector<std::filesystem::path> folders;  ///< that the survey's journals lie in; ours in the last
  Journal journal;                             ///< ours; empty for a new one
  std::vector<JournalLine> lines;              ///< of all journals that can be read, see joined()
  std::vector<std::string> notices;            ///< what a user must be told: another folder, broken lines

  /// Takes in the others' journals as they are now; ours is what it is here.
  void read_lines();
  /// False where ours belongs to somebody who keeps others from writing it.
  [[nodiscard]] bool may_write() const;
  /// Another program writes our journal: it is one of the others from now on, and ours is the next one.
  void begin_next();

 private:
  [[nodiscard]] std::int64_t first_place() const { return (std::ssize(folders) - 1) * kMostJournals; }
};

/// Takes the first folder that can be written to; one that is not there is made. The last journal in it that can be read is
/// gone on with, the others there and in the folders before it are read; one that cannot be read is left as it is.
/// head    of a journal that is begun
/// errors  io: no folder can be written to
[[nodiscard]] Result<JournalPlace> place_journal(std::span<const std::filesystem::path> folders, const Journal& head);

}  // namespace sonar
