// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/result.h"
#include "pipeline/journal/journal_place.h"

namespace sonar {

// What humans decided elsewhere on a survey, in the journal that a run was given say, joins the journals of its session.

struct TakenLines {
  std::size_t lines = 0;               ///< that were not in the session; 0 = nothing was written
  std::filesystem::path into;          ///< a journal of their own beside the others
  std::vector<std::string> operators;  ///< of these lines, each once
};

/// Writes the lines that hold in a session, and that the journals of a place do not have, into a journal of their own there: each
/// with its person and its time, all as one step, which its person can undo. The place has to be read anew.
/// from      a journal, or a folder of journals; nothing is taken where none of its lines is of a ping of the survey
/// has_ping  whether a ping of the survey has this datagram time
/// errors    as read_session(); io, no_space, and nothing is taken
[[nodiscard]] Result<TakenLines> take_lines(const JournalPlace& place, const std::filesystem::path& from,
                                            const std::function<bool(TimeNs)>& has_ping);

}  // namespace sonar
