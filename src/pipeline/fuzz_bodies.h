// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the fuzz targets of this room's parsers do; the plain tests replay the corpora through the same functions.

#include <string>
#include <string_view>

#include "base/check.h"
#include "pipeline/journal.h"
#include "pipeline/manual.h"
#include "pipeline/recipe.h"

namespace sonar::fuzz {

/// A recipe that is taken says the same when it is written and read again.
inline void recipe(std::string_view text) {
  const auto read = recipe_from_text(text);
  if (!read) return;
  const std::string written = recipe_text(*read);
  const auto again = recipe_from_text(written);
  SONAR_CHECK(again.has_value() && recipe_text(*again) == written);
}

/// A journal's sound lines survive being written again; what they ask for is refused or understood, never worse.
inline void journal(std::string_view text) {
  const auto read = parse_journal(text, "fuzz");
  if (!read) return;
  std::string written = journal_head_text(*read) + "\n";
  for (const JournalLine& line : read->lines) written += journal_text(line) + "\n";
  const auto again = parse_journal(written, "fuzz");
  SONAR_CHECK(again.has_value() && again->lines.size() == read->lines.size() && again->diagnostics.empty());
  for (const JournalLine& line : effective_lines(read->lines)) {
    if (const auto command = propagate_from_json(line.args)) SONAR_CHECK(!command->seeds.empty());
  }
}

}  // namespace sonar::fuzz
