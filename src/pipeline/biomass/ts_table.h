// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "io/csv_table.h"
#include "model/ts_relation.h"

namespace sonar {

/// The target-strength relations that come with the program, as the text of a TS table (docs/interfaces.md section 8).
[[nodiscard]] std::string_view ts_presets_csv();

/// errors  format, naming file and line: a column that lacks, a figure outside what it may be, a name twice, no line
[[nodiscard]] Result<std::vector<TsRelation>> ts_relations_of(const CsvTable& table);
/// path  empty = those that come with the program
/// errors  also not_found, io
[[nodiscard]] Result<std::vector<TsRelation>> read_ts_table(const std::filesystem::path& path);

/// errors  not_found, naming those that there are
[[nodiscard]] Result<TsRelation> ts_relation_named(std::span<const TsRelation> table, const std::string& name);

/// Those that could be meant for a species at these frequencies, the chosen one among them: of its species, with a band of
/// frequencies that overlaps the sonar's. Where fewer than two do, all of its species, whatever their frequency.
[[nodiscard]] std::vector<TsRelation> ts_choices(std::span<const TsRelation> table, const TsRelation& chosen,
                                                 double from_khz, double to_khz);

/// "TS = 20 log10 L - 71.2 dB, 38 kHz, dorsal; source" for people, with what was recalled marked.
[[nodiscard]] std::string ts_text(const TsRelation& relation);

}  // namespace sonar
