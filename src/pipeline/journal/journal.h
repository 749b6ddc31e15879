// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "base/result.h"
#include "base/time.h"
#include "model/product.h"
#include "pipeline/journal/json_value.h"

namespace sonar {

inline constexpr int kJournalVersion = 1;

/// One human choice. Its keys are times, channels and samples, never display names.
struct JournalLine {
  std::int64_t n = 0;  ///< 1, 2, ...
  TimeNs decided = 0;
  std::string operator_name;
  std::string command;   ///< "propagate", "undo", "redo", ...
  TimeNs ping_time = 0;  ///< of the ping it was made on
  JsonValue args;        ///< an object
  /// n of the first line of the step that this one belongs to: such lines are undone and redone together. 0 = alone.
  std::int64_t step = 0;
};

/// A journal file: JSON lines, the first with the version, the survey's files and the recipe.
struct Journal {
  std::vector<InputFile> files;
  std::string recipe_hash;
  std::string recipe;  ///< JSON, as recipe_text() writes it
  std::vector<JournalLine> lines;
  Diagnostics diagnostics;  ///< broken lines, which were left out
};

/// Parses a journal. A broken line (no JSON, wrong check sum, missing member) is a diagnostic and the rest is kept; so is a
/// broken first line, without which the recipe is not known, as long as a sound one follows.
/// file    for messages
/// errors  newer_version; format: there is no line to keep
[[nodiscard]] Result<Journal> parse_journal(std::string_view text, const std::string& file);
/// errors  also not_found, io
[[nodiscard]] Result<Journal> read_journal(const std::string& path);

/// One line of the file, check sum included, without line end. The check sum is the lowest 32 bits of the XXH3-128 of
/// the line's JSON (keys sorted, no spaces) without its member crc, as 8 hexadecimal digits.
[[nodiscard]] std::string journal_text(const JournalLine& line);
[[nodiscard]] std::string journal_head_text(const Journal& journal);
/// "choice 3 (propagate): ", with which every note on a line begins.
[[nodiscard]] std::string said_of(const JournalLine& line);

/// Appends a line and flushes it to the disk; writes the head first where the file is new. What cannot be written whole is
/// not written: the file is as it was.
/// errors  no_space, io
[[nodiscard]] Result<void> append_journal(const std::string& path, const Journal& head, const JournalLine& line);

/// The commands that hold after undo and redo (args.target = the n of the line meant), in order.
[[nodiscard]] std::vector<JournalLine> effective_lines(const std::vector<JournalLine>& lines);

}  // namespace sonar
