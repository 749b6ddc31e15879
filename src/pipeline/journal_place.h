// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "pipeline/journal.h"

namespace sonar {

/// Where a session's journal is kept, and what it already holds.
struct JournalPlace {
  std::filesystem::path path;
  Journal journal;                   ///< empty for a new one
  std::vector<std::string> notices;  ///< what a user must be told: another folder, broken lines
};

/// Takes the first folder that can be written to; one that is not there is made. A journal that lies in a folder before
/// it is copied along; one that cannot be read is left as it is, and a new one is begun beside it.
/// head    of a journal that is begun
/// errors  io: no folder can be written to
[[nodiscard]] Result<JournalPlace> place_journal(std::span<const std::filesystem::path> folders, const Journal& head);

}  // namespace sonar
