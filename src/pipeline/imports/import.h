// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "io/lsss_work.h"
#include "pipeline/commands/command.h"
#include "pipeline/journal/journal.h"
#include "pipeline/journal/manual.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/survey/survey.h"

namespace sonar {

// What files of other programs say of a survey, as a journal of choices that a window opens and a run replays.

/// Beams of a fan, both included, from 0.
struct BeamSpan {
  int first = 0;
  int last = 0;
};

/// Where what is read belongs, and what a file does not say itself.
struct ImportPlace {
  const SurveyFiles* survey = nullptr;
  std::vector<std::size_t> observations;  ///< in survey->observations, each with a grid
  std::optional<int> fan;                 ///< of regions that do not name one
  std::optional<BeamSpan> beams;          ///< the same; empty = all of the fan
  std::optional<LsssNumbering> lsss;      ///< of masks of LSSS; empty = as their file tells, else from one
  std::size_t most_runs = 10'000'000;     ///< of a file's regions, in all pings: a short text can claim any number
};
/// observation  its name; empty = all of the sounder that comes first in the survey and has a grid
/// errors       usage: there is none of that name, or none with a grid
[[nodiscard]] Result<ImportPlace> import_place(const SurveyFiles& survey, const std::string& observation);

/// A school as a file has it.
struct ImportedSchool {
  std::size_t observation = 0;  ///< in SurveyFiles::observations
  std::string name;
  std::string species;
  std::string comment;
  std::map<std::int64_t, std::vector<RunKey>> pings;  ///< [ping_index] runs in any order, which may overlap
};

/// What files say. Times are those of the datagrams.
struct Imported {
  std::vector<ImportedSchool> schools;
  std::vector<EventCommand> events;
  std::vector<BadPingsCommand> bad;
  std::vector<std::string> left_out;  ///< a line each, with file and place

  /// The school of an observation that a file, or several, call so; a new one where the key is empty.
  [[nodiscard]] ImportedSchool& school(const std::string& key, std::size_t observation);
  std::map<std::pair<std::string, std::size_t>, std::size_t> keyed{};  ///< index in schools
};

/// A kind of file, by what its name ends in.
struct ImportFormat {
  std::string_view ending;  ///< ".evr"
  std::string_view text;    ///< what it is
  /// errors  format, unsupported, usage, cancelled
  Result<void> (*read)(const std::string& text, const std::string& file, const ImportPlace& place, Imported& imported,
                       const Work& work);
};
[[nodiscard]] std::span<const ImportFormat> import_formats();

/// Adds what a file says.
/// file    at most 256 MB
/// errors  usage: no such ending; not_found, io, format; as the format's
[[nodiscard]] Result<void> import_file(const std::filesystem::path& file, const ImportPlace& place, Imported& imported,
                                       const Work& work);

/// Who imports, and when.
struct ImportedBy {
  std::string operator_name;
  TimeNs decided = 0;
};

/// The lines of one school: a brush in each ping, then what is said of it. They are one step, undone together.
struct SchoolLines {
  std::vector<JournalLine> lines;  ///< empty: none of its cells can belong to a school
  std::size_t pings = 0;
  std::size_t voxels = 0;
  std::size_t pings_left_out = 0;  ///< without a cell that can belong to a school
};
/// n       number of the first line
/// errors  those of the pings
[[nodiscard]] Result<SchoolLines> school_lines(const ImportedSchool& school, const CommandContext& context,
                                               const ImportedBy& by, std::int64_t n);

struct ImportedJournal {
  Journal journal;
  std::size_t schools = 0;
  std::size_t voxels = 0;
  std::size_t marks = 0;
  std::size_t bad = 0;                ///< intervals of bad pings
  std::vector<std::string> left_out;  ///< a line each
};
/// A journal of everything that was imported. Pings of schools are read, as a brush takes only voxels that can belong to one.
/// Where there are schools, the journal's recipe looks for no others.
/// errors  not_found, io: of pings; cancelled
[[nodiscard]] Result<ImportedJournal> import_journal(const SurveyFiles& survey, const Recipe& recipe,
                                                     const Imported& imported, const ImportedBy& by, Work& work);
[[nodiscard]] std::string journal_text(const Journal& journal);

}  // namespace sonar
