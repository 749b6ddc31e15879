// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "base/result.h"
#include "pipeline/journal/journal.h"

namespace sonar {

// Several people may be at work on one survey, each with a journal of their own: session.jsonl, session-2.jsonl, ... What was
// chosen is what all of them say.

/// One of a survey's journals. Its place among them keeps the numbers of its lines apart from those of the others.
struct OneJournal {
  std::filesystem::path path;
  std::int64_t place = 0;  ///< 0 = session.jsonl of the first folder, whose lines keep their numbers
};

/// A journal in a folder may have numbers 1 to this.
inline constexpr std::int64_t kMostJournals = 1000;
[[nodiscard]] std::filesystem::path journal_name(const std::filesystem::path& folder, std::int64_t number);
/// A file that is there while a program writes a journal.
[[nodiscard]] std::filesystem::path journal_lock(const std::filesystem::path& journal);
/// Where such files lie, beside the journals.
inline constexpr const char* kLocks = "locks";
/// Those that are there, links among them, in the order of folders and numbers.
[[nodiscard]] std::vector<OneJournal> journals_in(std::span<const std::filesystem::path> folders);

/// The place of the journal that a number among all journals' lines belongs to.
[[nodiscard]] std::int64_t place_of(std::int64_t n);
/// Lowest number that lines of a journal can have among all journals' lines.
[[nodiscard]] std::int64_t first_number(std::int64_t place);
/// A line with the numbers (its own, those it names) that it has among all journals' lines, and back.
[[nodiscard]] JournalLine among_all(JournalLine line, std::int64_t place);
[[nodiscard]] JournalLine as_written(JournalLine line, std::int64_t place);
/// A number among all journals' lines, for people: "17", or "2:17" of the second journal.
[[nodiscard]] std::string line_title(std::int64_t n);

/// The lines of several journals as one: by the time they were decided, each journal's in its own order.
/// lines  of each, with their numbers among all
[[nodiscard]] std::vector<JournalLine> joined(std::vector<std::vector<JournalLine>> lines);

/// One of a survey's journals; an empty file has nothing that can be wrong with it.
/// errors  as read_journal(); io: a link, through which nothing of ours is written
[[nodiscard]] Result<Journal> read_one(const std::filesystem::path& path);

/// A session as a user names it: a journal, or the folder of a survey's journals.
/// errors  as read_journal(); not_found: the folder has none
[[nodiscard]] Result<Journal> read_session(const std::filesystem::path& path);

}  // namespace sonar
